#include "harness/studies/user_cases/user_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "harness/io/errors.h"
#include "harness/model/load.h"
#include "harness/run/load_limits.h"
#include "harness/run/run_json.h"

namespace ddem::harness {
namespace {

using reports::Criterion;
using reports::State;

constexpr std::array kTimes = {"wall_seconds", "nanoseconds_per_bond_step", "solve_seconds"};

/// The numbers of a command's JSON but times, and why others are none.
void take_numbers(const Json& j, const std::string& prefix, UserCaseOutcome& out) {
  for (const auto& [key, value] : j.items()) {
    if (std::find(kTimes.begin(), kTimes.end(), key) != kTimes.end()) continue;
    if (value.is_number())
      out.metrics[prefix + key] = value;
    else if (value.is_object() && value.contains("status"))
      out.missing[prefix + key] = value["status"];
    else if (value.is_null() && j.contains(key + "_status"))
      out.missing[prefix + key] = j[key + "_status"];
  }
}

void run_discs(const Scene& scene, const Solver& solver, UserCaseOutcome& out) {
  RunOptions options;
  options.solver = &solver;
  const DemRun run = run_scene(scene, options);
  if (run.result.breakdown) {
    out.diverged_step = run.result.breakdown->step;
    out.failure = fmt::format("{} at step {}, disc {}", describe(*run.result.breakdown, scene).what,
                              run.result.breakdown->step, run.result.breakdown->disc);
  }
  take_numbers(run_json(run), "", out);
  out.warnings = run.warnings;
}

void run_continuum(const Scene& scene, UserCaseOutcome& out) {
  std::optional<SceneModuli> moduli;
  if (needs_moduli(scene)) moduli = scene_moduli(scene);
  const FemPlan plan = plan_fem(scene, moduli);
  const FemResult result = run_fem(std::array{plan.fem}).front();
  if (plan.fem.integrator == Integrator::verlet) drive_warning(scene, result.time_step);  // refuses one that is not sampled
  std::optional<WaveMeasurement> measurement;
  const auto wave = wave_of(scene);
  if (result.status == "ok" && wave && !plan.layout.pairs.empty()) measurement = measure_fem(plan, result, *wave);
  take_numbers(fem_json(plan, result, measurement), "fem.", out);
}

std::string why_missing(const UserCaseOutcome& found, const std::string& metric) {
  if (const auto known = found.missing.find(metric); known != found.missing.end())
    return metric + ": " + known->second;
  std::vector<std::string> names;
  for (const auto& [name, value] : found.metrics) names.push_back(name);
  return fmt::format("{}: no such number; there are {}", metric, fmt::join(names, ", "));
}

/// Empty, with a reason, where there is none.
std::optional<double> value_of(const UserCaseOutcome& found, const std::string& metric, std::string& reason) {
  const auto value = found.metrics.find(metric);
  if (value != found.metrics.end()) return value->second;
  if (found.failure.empty()) reason += why_missing(found, metric) + ". ";
  return std::nullopt;
}

Criterion judged(const CaseCriterion& wanted, const UserCaseOutcome& found, std::string& reason) {
  Criterion c{.metric = wanted.metric, .unit = wanted.unit, .derivation = wanted.derivation};
  const auto actual = value_of(found, wanted.metric, reason);
  std::optional<double> target = wanted.target;
  if (!wanted.reference.empty()) {
    target = value_of(found, wanted.reference, reason);
    c.derivation += fmt::format(" (target: {})", wanted.reference);
    if (!target) return c;
  }
  const auto bound = [&](double share) { return target ? *target + share * std::abs(*target) : share; };
  if (target) c.target = *target;
  if (wanted.lower) c.lower = bound(*wanted.lower);
  if (wanted.upper) c.upper = bound(*wanted.upper);
  if (actual && std::isfinite(*actual)) {
    c.actual = *actual;
    c.state = *actual >= c.lower && *actual <= c.upper ? State::pass : State::fail;
  }
  return c;
}

}  // namespace

UserCaseOutcome run_user_case(const UserCase& c, const Solver& solver) {
  const SceneResult scene = scene_of_case(c);
  if (!scene) throw InputError(to_string(scene.violations));
  UserCaseOutcome out;
  const std::set<std::string> groups = groups_of(c);
  if (groups.contains("")) run_discs(*scene, solver, out);
  if (groups.contains("static")) take_numbers(moduli_json(scene_moduli(*scene)), "static.", out);
  if (groups.contains("fem")) run_continuum(*scene, out);
  if (groups.contains("stability"))
    take_numbers(stability_json(scene_stability(*scene, {})), "stability.", out);
  return out;
}

reports::Verdict case_verdict(const CaseResult& r) {
  reports::Verdict v{
      .case_id = "case/" + r.c.id, .title = r.c.title, .state = State::pass, .reason = r.found.failure};
  for (const CaseCriterion& wanted : r.c.criteria) v.criteria.push_back(judged(wanted, r.found, v.reason));
  for (const Criterion& c : v.criteria) v.state = std::min(v.state, c.state);
  if (!r.found.failure.empty()) v.state = r.found.diverged_step ? State::unstable : State::error;
  for (const std::string& warning : r.found.warnings) {
    if (!v.reason.empty() && !v.reason.ends_with(' ')) v.reason += ". ";
    v.reason += fmt::format("Warning: {}", warning);
  }
  return v;
}

}  // namespace ddem::harness
