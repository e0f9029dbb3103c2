#include "harness/studies/solvers/solvers_verdicts.h"

#include <fmt/format.h>

#include "harness/studies/strip/criteria.h"

namespace ddem::harness {
namespace {

constexpr double kMotion = 1e-4, kSpeed = 1e-4, kStaticLimit = 0.02;

std::optional<double> ratio(double actual, double to) { return actual > 0.0 && to > 0.0 ? std::optional(actual / to) : std::nullopt; }

}  // namespace

reports::Verdict solver_verdict(const ComparedSolver& c) {
  const SolverResult& r = c.found;
  reports::Verdict v{.case_id = c.task.id(),
                     .title = fmt::format("{}, {} discs, {}, k_t/k_n = {:g}, against the built-in solver", c.task.label, c.task.packing, c.task.law, c.task.stiffness_ratio),
                     .reason = r.failure};
  if (r.failure.empty()) {
    v.reason = r.speed_reason;
    const char* same = "the same scene to the last bit at 1e-6 mean radii: what is left is geometry of the moment (of that order) and round-off; 1 % of any "
                       "parameter changes a motion by 1e-3 or more";
    v.criteria.push_back(judge("displacements", r.displacement_error, {0.0, 0.0, kMotion}, "", same));
    if (c.task.stiffness_ratio > 0.0) v.criteria.push_back(judge("rotations", r.rotation_error, {0.0, 0.0, kMotion}, "", same));
    v.criteria.push_back(judge("speed / built-in", ratio(r.speed, r.builtin_speed), absolute(1.0, kSpeed), "", "picks of the same pulse at the same sections"));
    v.criteria.push_back(judge("speed / static", ratio(r.speed, r.static_speed), absolute(1.0, kStaticLimit + (r.builtin_speed > 0.0 && r.static_speed > 0.0 ? std::abs(r.builtin_speed / r.static_speed - 1.0) : 0.0)), "",
                               "2 %, and what the built-in solver's pulse disperses by"));
    const bool lagged = c.task.law.starts_with("lagged");
    if (const auto order = r.order())
      v.criteria.push_back(judge("order in the step", order, absolute(lagged ? 1.0 : 2.0, 0.3), "", lagged ? "the lag is a part of the law, of first order" : "leapfrog"));
  }
  conclude_study(v);
  return v;
}

}  // namespace ddem::harness
