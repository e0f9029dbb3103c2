// Which scheme to choose: energy, order, reach; and how far deformable discs reach.
#include "harness/campaign/pieces.h"
#include "harness/studies/schemes/schemes_figures.h"
#include "harness/studies/schemes/schemes_verdicts.h"
#include "harness/studies/strip/strip.h"

namespace ddem::harness {
namespace {

constexpr const char *kSchemes = "schemes", *kRange = "poisson-range";
constexpr std::size_t kWork = 210;

class SchemesStudy : public Study {
 public:
  explicit SchemesStudy(const std::shared_ptr<Strip>& strip) {
    schemes_.failure = range_.failure = kNotRun;
    const auto always = [](const auto&, const auto&) { return true; };
    const auto done = [strip] {
      if (strip->options.on_progress) strip->options.on_progress(kWork / kSchemeStudySteps);
    };
    pieces_.push_back(piece_at(schemes_, kSchemes, inputs_of(strip->spec), kWork, [strip, done] { return study_schemes(strip->spec, done, *strip->options.solver); }, always));
    pieces_.back().unit.reports_progress = true;
    pieces_.push_back(piece_at(range_, kRange, inputs_of(strip->spec), 20, [strip] { return study_range(strip->spec); }, always));
  }

  std::vector<Judged> judge() const override {
    return {{energy_verdict(schemes_), {kSchemes}}, {order_verdict(schemes_), {kSchemes}}, {reach_verdict(schemes_), {kSchemes}}, {range_verdict(range_), {kRange}}};
  }

  void introduce(reports::Report& report) const override {
    if (std::string finding = reach_finding(schemes_); !finding.empty()) report.findings.push_back(std::move(finding));
  }

  std::vector<reports::Section> sections() const override {
    return {{.heading = kOverview, .figures = {range_figure(range_)}},
            {.heading = "Which scheme to choose",
      .paragraphs =
          {"The published scheme takes the strains of the discs from the forces of the step before. The lag is a viscosity of first order "
           "in the step, and it limits how soft the discs may be. Implicit strains belong to the forces of the same step: second order, no "
           "limit, and with the full (or normal-only-stress) correction an energy that is kept to round-off, for some more time a step. "
           "They cost the more the softer the discs. Conjugate gradients from the strains of the step before find the same strains "
           "more slowly than the fixed polynomial, and keep the energy to their tolerance only."},
      .figures = {scheme_figure(schemes_)},
      .tables = {scheme_table(schemes_)}}};
  }

  nlohmann::json data() const override { return {{"schemes", schemes_}, {"poisson_range", range_}}; }

 private:
  SchemeStudy schemes_;
  RangeStudy range_;
};

}  // namespace

std::unique_ptr<Study> make_schemes(const StudyContext& context) {
  return std::make_unique<SchemesStudy>(strip_of(context));
}

}  // namespace ddem::harness
