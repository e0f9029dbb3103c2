// The continuum with the static moduli of the strip's materials.
#include <fmt/format.h>

#include <algorithm>

#include "harness/campaign/pieces.h"
#include "harness/studies/finite_elements/finite_elements_run.h"
#include "harness/studies/finite_elements/finite_elements_verdicts.h"
#include "harness/studies/strip/outside_members.h"
#include "harness/studies/strip/strip.h"

namespace ddem::harness {
namespace {

bool is_same(const FemOutcome& a, const FemOutcome& b) {
  return a.key == b.key && a.wave == b.wave && a.uniaxial == b.uniaxial;
}

class FiniteElementsStudy : public Study {
 public:
  explicit FiniteElementsStudy(std::shared_ptr<Strip> strip) : strip_(std::move(strip)) {
    StripResults& r = strip_->found;
    if (!strip_->options.with_continuum) return;
    for (FemOutcome& f : fem_outcomes(strip_->spec)) {
      f.failure = kNotRun;
      r.fem.push_back(std::move(f));
    }
    pieces_.push_back(piece(
        kContinuumUnit, inputs_of(strip_->spec), kWorkOfFemCase * r.fem.size(),
        [s = strip_] { return run_strip_fem(s->spec, s->statics, s->options); },
        [&r](std::vector<FemOutcome>&& found) {
          for (const FemOutcome& f : found) require_whole(f.recording);
          require_same(std::ranges::equal(found, r.fem, is_same));
          std::ranges::move(found, r.fem.begin());
        },
        [&r](const std::string& reason) { r.fem_failure = reason; }));
    pieces_.back().unit.reports_progress = true;
  }

  std::vector<Judged> judge() const override {
    std::vector<Judged> judged;
    for (const FemOutcome& f : strip_->found.fem) judged.push_back({fem_verdict(strip_->found, f), {kContinuumUnit}});
    return judged;
  }

  void introduce(reports::Report& report) const override {
    const StripResults& r = strip_->found;
    if (std::string finding = continuum_finding(r); !finding.empty()) report.findings.push_back(std::move(finding));
    report.provenance.emplace_back("finite-element runs", r.fem_failure.empty() ? std::to_string(r.fem.size()) : r.fem_failure);
  }

  nlohmann::json data() const override {
    nlohmann::json j = nlohmann::json::object();
    for (const FemOutcome& f : strip_->found.fem) j[fem_verdict(strip_->found, f).case_id] = f;
    return j;
  }

  void count(nightly::WorkCounts& work) const override {
    for (const FemOutcome& f : strip_->found.fem) work.finite_element_runs += f.dofs > 0;
  }

 private:
  std::shared_ptr<Strip> strip_;
};

}  // namespace

std::unique_ptr<Study> make_finite_elements(const StudyContext& context) {
  return std::make_unique<FiniteElementsStudy>(strip_of(context));
}

}  // namespace ddem::harness
