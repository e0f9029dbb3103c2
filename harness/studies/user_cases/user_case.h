#pragma once
// A case of a campaign file: a scene of the user's own, and what its numbers must be.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness/io/members.h"
#include "harness/scene/read_scene.h"
#include "harness/solvers/solver.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// A metric is a number of `ddem run --json` ("wave_speed"), or, with a prefix, of `ddem moduli`, `fem` and
/// `stability`
/// ("static.shear_velocity", "fem.wave_speed", "stability.critical_time_step").
struct CaseCriterion {
  std::string metric;
  std::optional<double> target;
  std::string reference;  ///< a metric as the target instead; empty: none
  std::optional<double> lower,
      upper;  ///< of a target: shares of it, -0.01 is 1 % below; without one: the bounds themselves
  std::string unit, derivation;
};

struct UserCase {
  std::string id;  ///< "soft/stiffness_ratio=0.5"
  std::string title;
  std::string scene;                     ///< path of its file
  std::string text;                      ///< and what it held when the campaign was planned
  std::vector<SceneOverride> overrides;  ///< this case's point of the matrix
  std::vector<CaseCriterion> criteria;
};

struct UserCaseOutcome {
  std::string failure;  ///< empty: ok
  std::optional<long> diverged_step;
  std::map<std::string, double> metrics;
  std::map<std::string, std::string> missing;  ///< by metric: why there is none
  std::vector<std::string> warnings;           ///< of the run of the discs
};

DDEM_MEMBERS(SceneOverride, key, value)
DDEM_MEMBERS(CaseCriterion, metric, target, reference, lower, upper, unit, derivation)
DDEM_MEMBERS(UserCase, id, title, scene, text, overrides, criteria)
DDEM_MEMBERS(UserCaseOutcome, failure, diverged_step, metrics, missing, warnings)

struct CaseResult {
  UserCase c;
  UserCaseOutcome found;
};

/// Those of a case's criteria and references: see group_of().
std::set<std::string> groups_of(const UserCase& c);

/// Which numbers a metric is one of: "", "static", "fem", "stability"; nothing for a prefix that is not
/// known.
std::optional<std::string> group_of(const std::string& metric);

/// The scene of a case, or everything that is wrong with it.
SceneResult scene_of_case(const UserCase& c);

/// A text of all that the outcome follows from, the files that the scene names included.
std::string inputs_of_case(const UserCase& c);

/// Bytes of memory that it takes at most, for its discs; 0 where their number is not known.
double memory_of_case(const UserCase& c);

/// Only what the criteria ask for is computed. Throws what keeps it from an outcome.
UserCaseOutcome run_user_case(const UserCase& c, const Solver& solver);

/// "case/ID". UNSTABLE where the run diverged. Its reason ends with what the run warned of, whatever the state.
reports::Verdict case_verdict(const CaseResult& result);

}  // namespace ddem::harness
