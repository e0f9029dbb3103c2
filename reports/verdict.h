#pragma once
// The outcome of one validation case, as the report and JUnit show it.

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ddem::reports {

enum class State {
  error,                 ///< the case crashed, or gave no result
  fail,                  ///< outside its tolerance
  unstable,              ///< diverged, and theory did not say so
  regressed,             ///< inside its tolerance, but worse than the baseline beyond its noise
  missing,               ///< the baseline has it, and it was not measured, or in another unit
  no_baseline,           ///< nothing to compare with
  skipped,               ///< not run, for a reason
  unstable_as_expected,  ///< diverged, as theory says it must: counts as passed
  pass,
};
constexpr State kStatesWorstFirst[] = {State::error,
                                       State::fail,
                                       State::unstable,
                                       State::regressed,
                                       State::missing,
                                       State::no_baseline,
                                       State::skipped,
                                       State::unstable_as_expected,
                                       State::pass};

/// "PASS", "FAIL", "UNSTABLE (expected)", ...
std::string_view to_string(State state);
bool is_failure(State state);  ///< error, fail, unstable, regressed, missing
bool is_pass(State state);     ///< pass, unstable_as_expected

struct Criterion {
  std::string metric = {};
  double actual = std::numeric_limits<double>::quiet_NaN();  ///< not finite: was not measured
  double target = std::numeric_limits<double>::quiet_NaN();  ///< not finite: bounds only
  double lower = -std::numeric_limits<double>::infinity();   ///< not finite: no lower bound
  double upper = std::numeric_limits<double>::infinity();    ///< not finite: no upper bound
  std::string unit = {};
  std::string derivation = {};  ///< where target and tolerance come from
  State state = State::error;
};

struct Verdict {
  std::string case_id = {};
  std::string title = {};
  State state = State::error;
  std::string reason = {};
  std::vector<Criterion> criteria = {};
  std::string reproduce = {};  ///< the command that runs this case alone
  double seconds = 0.0;        ///< wall time that was spent on it; not drawn
  std::vector<std::pair<std::string, std::string>> facets = {};  ///< what to filter by: {"packing", "random"}; names of letters and hyphens
};

/// "[0.32, 0.34] m/s", "at most 0.01", "anything": what a criterion accepts.
std::string accepted_text(const Criterion& criterion);

/// "nu: 0.31 (target 0.33, accepted [0.32, 0.34]): FAIL", with units.
std::string outcome_text(const Criterion& criterion);

/// The verdicts, worst first; within a state in their own order.
std::vector<const Verdict*> worst_first(const std::vector<Verdict>& verdicts);

/// "44 of 44 passed", "40 of 44 passed, 1 ERROR, 2 FAIL, 1 SKIPPED".
std::string headcount(const std::vector<Verdict>& verdicts);

}  // namespace ddem::reports
