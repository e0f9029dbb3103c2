#include "harness/nightly/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "harness/scene/nearest_name.h"
#include "reports/number.h"

namespace ddem::harness::nightly {
namespace {

using reports::Criterion;
using reports::State;
using reports::Verdict;


State worst_of(const Verdict& v) {
  State worst = State::pass;
  for (const Criterion& c : v.criteria) worst = std::min(worst, c.state);
  return worst;
}

std::string in_unit(const std::string& unit) {
  return unit.empty() ? "without a unit" : "in " + unit;
}

Comparison compared(const Verdict& v, Criterion& c, const Baseline& baseline) {
  const auto known = baseline.find(metric_key(v.case_id, c.metric));
  if (known == baseline.end()) {
    if (c.state == State::pass) c.state = State::no_baseline;
    return {v.case_id, c.metric, c.unit, c.state, reports::kNone, c.actual, 0.0};
  }
  const BaselineEntry& b = known->second;
  Comparison out{v.case_id, c.metric, c.unit, c.state, b.value, c.actual, b.noise};
  // Written so that a value that is not finite cannot pass.
  const bool as_good = badness(c, c.actual, b.value) <= badness(c, b.value, b.value) + b.noise;
  if (b.unit != c.unit) {
    out.note = fmt::format("{} here, {} in the baseline", in_unit(c.unit), in_unit(b.unit));
    out.before = reports::kNone;
    if (c.state == State::pass) c.state = State::missing;
  } else if (c.state == State::pass && !as_good) {
    c.state = State::regressed;
  }
  out.state = c.state;
  return out;
}

/// The new metric of that case that may be the one that is missing.
std::string renamed(const std::string& case_id, const std::string& metric, const std::vector<Comparison>& comparisons) {
  const Comparison* nearest = nullptr;
  for (const Comparison& c : comparisons) {
    if (c.case_id != case_id || c.state != State::no_baseline) continue;
    if (nearest == nullptr || edit_distance(metric, c.metric) < edit_distance(metric, nearest->metric)) nearest = &c;
  }
  return nearest == nullptr ? "" : fmt::format("did you mean {}, which the baseline has not?", nearest->metric);
}

Verdict& case_of(const std::string& id, std::vector<Verdict>& verdicts) {
  const auto found = std::find_if(verdicts.begin(), verdicts.end(), [&](const Verdict& v) { return v.case_id == id; });
  if (found != verdicts.end()) return *found;
  return verdicts.emplace_back(Verdict{.case_id = id, .title = "In the baseline only", .state = State::missing, .reason = "not in this run. "});
}

Comparison absent(const std::string& key, const BaselineEntry& b) {
  const std::size_t bar = key.find(" | ");
  return {key.substr(0, bar), bar == std::string::npos ? "" : key.substr(bar + 3), b.unit, State::missing, b.value, reports::kNone, b.noise};
}

void add_to_case(const Comparison& c, std::vector<Verdict>& verdicts) {
  Verdict& v = case_of(c.case_id, verdicts);
  v.criteria.push_back({.metric = c.metric, .unit = c.unit, .derivation = fmt::format("{:.9g} in the baseline", c.before), .state = c.state});
  if (!c.note.empty()) v.reason += fmt::format("{}: {} ", c.metric, c.note);
}

std::string number(double x) {
  return std::isfinite(x) ? fmt::format("{:.9g}", x) : std::string("none");
}

bool is_changed(const Comparison& c) {
  return std::isfinite(c.before) && std::isfinite(c.now) && std::abs(c.now - c.before) > c.noise;
}

}  // namespace

std::vector<Comparison> compare(std::vector<Verdict>& verdicts, const Baseline& baseline, const Selected& selected) {
  std::vector<Comparison> comparisons;
  std::set<std::string> seen;
  for (Verdict& v : verdicts) {
    for (Criterion& c : v.criteria) {
      comparisons.push_back(compared(v, c, baseline));
      seen.insert(metric_key(v.case_id, c.metric));
      if (const std::string& note = comparisons.back().note; !note.empty()) v.reason += fmt::format("{}: {}. ", c.metric, note);
    }
  }
  for (const auto& [key, b] : baseline) {
    if (seen.contains(key)) continue;
    Comparison c = absent(key, b);
    if (selected && !selected(c.case_id)) {
      c.state = State::skipped;
    } else {
      c.note = renamed(c.case_id, c.metric, comparisons);
      add_to_case(c, verdicts);
    }
    comparisons.push_back(c);
  }
  for (Verdict& v : verdicts) {
    if (v.state == State::pass) v.state = worst_of(v);
  }
  return comparisons;
}

bool measured_nothing(const std::vector<Comparison>& comparisons) {
  return std::none_of(comparisons.begin(), comparisons.end(), [](const Comparison& c) { return std::isfinite(c.now); });
}

std::size_t count_of(State state, const std::vector<Comparison>& comparisons) {
  const auto is = [state](const Comparison& c) { return c.state == state; };
  return static_cast<std::size_t>(std::count_if(comparisons.begin(), comparisons.end(), is));
}

std::string comparison_text(const std::vector<Comparison>& comparisons) {
  std::string text;
  for (const Comparison& c : comparisons) {
    const bool changed = c.state == State::pass && is_changed(c);
    if ((c.state == State::pass && !changed) || c.state == State::skipped) continue;
    text += fmt::format("{:<11} {}: {}: {} -> {}{}{} (noise {:.2g}){}{}\n", changed ? "changed" : reports::to_string(c.state), c.case_id,
                        c.metric, number(c.before), number(c.now), c.unit.empty() ? "" : " ", c.unit, c.noise,
                        c.note.empty() ? "" : "; ", c.note);
  }
  text += fmt::format("{} metrics", comparisons.size());
  for (const State state : reports::kStatesWorstFirst) {
    if (const std::size_t count = count_of(state, comparisons); count > 0) text += fmt::format(", {} {}", count, reports::to_string(state));
  }
  return text + "\n";
}

Json comparison_json(const std::vector<Comparison>& comparisons) {
  Json states = Json::object(), all = Json::array();
  for (const State state : reports::kStatesWorstFirst) states[std::string(reports::to_string(state))] = count_of(state, comparisons);
  for (const Comparison& c : comparisons) {
    Json j{{"case", c.case_id},
           {"metric", c.metric},
           {"unit", c.unit},
           {"state", reports::to_string(c.state)},
           {"before", number_or_status(c.before, "not in the baseline")},
           {"now", number_or_status(c.now, "not measured")},
           {"noise", c.noise}};
    if (!c.note.empty()) j["note"] = c.note;
    all.push_back(std::move(j));
  }
  return {{"metrics", comparisons.size()}, {"states", states}, {"comparisons", all}};
}

}  // namespace ddem::harness::nightly
