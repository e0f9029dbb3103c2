// Targets that ddem calibrate is given: met where they are within reach, refused where not.
#include "harness/campaign/pieces.h"
#include "harness/studies/calibration/calibration_data.h"
#include "harness/studies/calibration/design.h"
#include "harness/studies/calibration/calibration_figures.h"
#include "harness/studies/strip/strip.h"

namespace ddem::harness {
namespace {

class CalibrationStudy : public Study {
 public:
  explicit CalibrationStudy(std::shared_ptr<Strip> strip) : strip_(std::move(strip)) {
    const std::vector<CalibrationCase> cases = calibration_cases();
    outcomes_.resize(cases.size());
    for (std::size_t k = 0; k < cases.size(); ++k) {
      outcomes_[k].id = id_of(cases[k]);
      outcomes_[k].failure = kNotRun;
      pieces_.push_back(piece_at(
          outcomes_[k], id_of(cases[k]), inputs_of(strip_->spec), 4,
          [s = strip_, one = cases[k]] { return study_calibration(s->spec, one, s->options); },
          [](const CalibrationOutcome& planned, const CalibrationOutcome& found) { return planned.id == found.id; }));
    }
    pieces_.push_back(piece_at(design_, "design-curves", inputs_of(strip_->spec), 4, [s = strip_] { return study_design(s->spec); }));
  }

  std::vector<Judged> judge() const override {
    std::vector<Judged> judged;
    for (const CalibrationOutcome& o : outcomes_) judged.push_back({calibration_verdict(o), {o.id}});
    return judged;
  }

  std::vector<reports::Section> sections() const override {
    return {{.heading = "Contacts for a material that you want",
          .paragraphs = {"Targets were calibrated as ddem calibrate does: kₙ by scale, kₜ/kₙ (and the discs' softness and νₚ) by "
                         "Newton's method on static moduli. "
                         "In the lattice what was found must be the closed form. In random packings the contacts found are put into scenes, and the "
                         "moduli of these are measured anew: of the packings that were fitted, and of others, which scatter. A target "
                         "out of reach must be refused."},
          .figures = {design_figure(design_, outcomes_, strip_->found)},
          .tables = {calibration_table(outcomes_)}}};
  }

  nlohmann::json data() const override {
    nlohmann::json j{{"design_curves", design_}};
    for (const CalibrationOutcome& o : outcomes_) j[o.id] = o;
    return j;
  }

 private:
  std::shared_ptr<Strip> strip_;
  std::vector<CalibrationOutcome> outcomes_;
  std::optional<DesignStudy> design_;
};

}  // namespace

std::unique_ptr<Study> make_calibration(const StudyContext& context) {
  return std::make_unique<CalibrationStudy>(strip_of(context));
}

}  // namespace ddem::harness
