// Spectra of discs and of the continuum, against exact branches.
#include <algorithm>

#include "harness/campaign/pieces.h"
#include "harness/studies/dispersion/dispersion_figures.h"
#include "harness/studies/dispersion/dispersion_data.h"
#include "harness/studies/strip/strip.h"

namespace ddem::harness {
namespace {

constexpr const char* kDispersionUnit = "dispersion";

class SpectraStudy : public Study {
 public:
  explicit SpectraStudy(const std::shared_ptr<Strip>& strip) : study_(plan_dispersion(strip->options.with_continuum)) {
    pieces_.push_back(piece(
        kDispersionUnit, inputs_of(strip->spec) + (strip->options.with_continuum ? " with the continuum" : ""), 270,
        [strip] { return study_dispersion(strip->spec, strip->options.with_continuum, *strip->options.solver); },
        [this](DispersionStudy&& found) {
          require_same(std::ranges::equal(found.panels, study_.panels, {}, &DispersionPanel::slug, &DispersionPanel::slug));
          study_ = std::move(found);
        },
        [this](const std::string& reason) {
          for (DispersionPanel& panel : study_.panels) panel.failure = reason;
        }));
  }

  std::vector<Judged> judge() const override {
    std::vector<Judged> judged;
    for (const DispersionPanel& panel : study_.panels) judged.push_back({dispersion_verdict(panel), {kDispersionUnit}});
    return judged;
  }

  std::vector<reports::Section> sections() const override { return {{.heading = kWaves, .figures = {dispersion_figure(study_)}}}; }

  nlohmann::json data() const override { return study_; }

 private:
  DispersionStudy study_;
};

}  // namespace

std::unique_ptr<Study> make_dispersion(const StudyContext& context) {
  return std::make_unique<SpectraStudy>(strip_of(context));
}

}  // namespace ddem::harness
