#include "reports/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/number.h"

namespace ddem::reports {
namespace {

std::string with_unit(std::string number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

}  // namespace

std::string_view to_string(State state) {
  switch (state) {
    case State::error:
      return "ERROR";
    case State::fail:
      return "FAIL";
    case State::unstable:
      return "UNSTABLE";
    case State::regressed:
      return "REGRESSED";
    case State::missing:
      return "MISSING";
    case State::no_baseline:
      return "NO_BASELINE";
    case State::skipped:
      return "SKIPPED";
    case State::unstable_as_expected:
      return "UNSTABLE (expected)";
    case State::pass:
      return "PASS";
  }
  return "ERROR";
}

bool is_failure(State state) {
  return state == State::error || state == State::fail || state == State::unstable ||
         state == State::regressed || state == State::missing;
}

bool is_pass(State state) {
  return state == State::pass || state == State::unstable_as_expected;
}

std::string accepted_text(const Criterion& c) {
  const bool lower = std::isfinite(c.lower), upper = std::isfinite(c.upper);
  if (lower && upper)
    return with_unit(fmt::format("[{}, {}]", number_text(c.lower), number_text(c.upper)), c.unit);
  if (lower) return fmt::format("at least {}", with_unit(number_text(c.lower), c.unit));
  if (upper) return fmt::format("at most {}", with_unit(number_text(c.upper), c.unit));
  return "anything";
}

std::string outcome_text(const Criterion& c) {
  const std::string actual =
      std::isfinite(c.actual) ? with_unit(number_text(c.actual), c.unit) : std::string("not measured");
  const std::string target =
      std::isfinite(c.target) ? fmt::format("target {}, ", with_unit(number_text(c.target), c.unit)) : "";
  return fmt::format("{}: {} ({}accepted {}): {}", c.metric, actual, target, accepted_text(c),
                     to_string(c.state));
}

std::vector<const Verdict*> worst_first(const std::vector<Verdict>& verdicts) {
  std::vector<const Verdict*> sorted;
  for (const Verdict& v : verdicts) sorted.push_back(&v);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Verdict* a, const Verdict* b) { return a->state < b->state; });
  return sorted;
}

std::string headcount(const std::vector<Verdict>& verdicts) {
  const auto count = [&](auto predicate) {
    return std::count_if(verdicts.begin(), verdicts.end(),
                         [&](const Verdict& v) { return predicate(v.state); });
  };
  std::string text = fmt::format("{} of {} passed", count(is_pass), verdicts.size());
  for (const State state : kStatesWorstFirst) {
    const auto n = count([&](State s) { return s == state; });
    if (n > 0 && !is_pass(state)) text += fmt::format(", {} {}", n, to_string(state));
  }
  return text;
}

}  // namespace ddem::reports
