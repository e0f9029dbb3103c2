#include "harness/nightly/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/json.h"
#include "harness/nightly/summary.h"

namespace ddem::harness::nightly {
namespace {

using reports::Criterion;
using reports::State;
using reports::Verdict;

constexpr double kRoundOff = 1e-9, kShareOfBand = 0.01;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// What the nights have of one metric.
struct Samples {
  std::vector<double> values;
  double noise = 0.0;
  std::string unit;
  bool passed = true;
};

State worst_of(const Verdict& v) {
  State worst = State::pass;
  for (const Criterion& c : v.criteria) worst = std::min(worst, c.state);
  return worst;
}

Comparison compared(const Verdict& v, Criterion& c, const Baseline& baseline) {
  const auto known = baseline.find(metric_key(v.case_id, c.metric));
  if (known == baseline.end()) {
    if (c.state == State::pass) c.state = State::no_baseline;
    return {v.case_id, c.metric, c.unit, c.state, kNone, c.actual, 0.0};
  }
  const BaselineEntry& b = known->second;
  // Written so that a value that is not finite cannot pass.
  const bool as_good = badness(c, c.actual, b.value) <= badness(c, b.value, b.value) + b.noise;
  if (c.state == State::pass && !as_good) c.state = State::regressed;
  return {v.case_id, c.metric, c.unit, c.state, b.value, c.actual, b.noise};
}

}  // namespace

std::string metric_key(const std::string& case_id, const std::string& metric) {
  return case_id + " | " + metric;
}

double badness(const Criterion& c, double value, double usual) {
  if (std::isfinite(c.target)) return std::abs(value - c.target);
  const bool lower = std::isfinite(c.lower), upper = std::isfinite(c.upper);
  if (lower && upper) return std::abs(value - 0.5 * (c.lower + c.upper));
  if (upper) return value;
  if (lower) return -value;
  return std::abs(value - usual);
}

double half_width(const Criterion& c) {
  const bool lower = std::isfinite(c.lower), upper = std::isfinite(c.upper);
  const double middle = std::isfinite(c.target) ? c.target : 0.0;
  if (lower && upper) return 0.5 * (c.upper - c.lower);
  if (lower) return std::abs(middle - c.lower);
  if (upper) return std::abs(c.upper - middle);
  return 0.0;
}

double least_noise(const Criterion& c) {
  return std::max(kRoundOff * std::abs(c.actual), kShareOfBand * half_width(c));
}

Baseline baseline_of(const std::vector<std::vector<Verdict>>& nights, std::vector<std::string>& left_out) {
  std::map<std::string, Samples> all;
  for (const auto& night : nights) {
    for (const Verdict& v : night) {
      for (const Criterion& c : v.criteria) {
        Samples& s = all[metric_key(v.case_id, c.metric)];
        const bool judged_right =
            c.state == State::pass || c.state == State::no_baseline || c.state == State::regressed;
        s.passed = s.passed && judged_right && std::isfinite(c.actual);
        s.values.push_back(c.actual);
        s.noise = std::max(s.noise, least_noise(c));
        s.unit = c.unit;
      }
    }
  }
  Baseline baseline;
  for (const auto& [key, s] : all) {
    if (!s.passed) {
      left_out.push_back(key);
      continue;
    }
    BaselineEntry entry{median(s.values), s.noise, s.unit};
    for (const double v : s.values) entry.noise = std::max(entry.noise, std::abs(v - entry.value));
    baseline[key] = entry;
  }
  return baseline;
}

std::string baseline_text(const Baseline& baseline) {
  std::string text = "{\n\"schema_version\": 1,\n\"metrics\": {\n";
  std::size_t left = baseline.size();
  for (const auto& [key, b] : baseline) {
    const Json line{{"value", b.value}, {"noise", b.noise}, {"unit", b.unit}};
    text += Json(key).dump() + ": " + line.dump() + (--left > 0 ? ",\n" : "\n");
  }
  return text + "}\n}\n";
}

Baseline parse_baseline(const std::string& text, const std::string& place) {
  try {
    const Json j = parse_json(text, place);
    if (j.at("schema_version") != 1) throw InputError(place + ": not a baseline: schema_version is not 1");
    Baseline baseline;
    std::vector<std::string> problems;
    for (const auto& [key, line] : j.at("metrics").items()) {
      const BaselineEntry b{line.at("value"), line.at("noise"), line.at("unit")};
      if (!std::isfinite(b.value) || !(b.noise >= 0.0) || !std::isfinite(b.noise)) {
        problems.push_back(
            fmt::format("{}: {}: value and noise must be finite, noise at least 0", place, key));
      }
      baseline[key] = b;
    }
    if (!problems.empty()) throw InputError(problems);
    return baseline;
  } catch (const Json::exception& e) {
    throw InputError(place + ": not a baseline, as ddem baseline update writes it: " + e.what());
  }
}

Baseline read_baseline(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw InputError(path.string() + ": there is no such baseline; ddem baseline update makes one");
  if (!std::filesystem::is_directory(path, ignored)) return parse_baseline(read_file(path), path.string());
  std::vector<std::string> left_out;
  return baseline_of({read_summary(path).verdicts}, left_out);
}

std::vector<Comparison> compare(std::vector<Verdict>& verdicts, const Baseline& baseline) {
  std::vector<Comparison> comparisons;
  std::set<std::string> seen;
  for (Verdict& v : verdicts) {
    for (Criterion& c : v.criteria) {
      comparisons.push_back(compared(v, c, baseline));
      seen.insert(metric_key(v.case_id, c.metric));
    }
    if (v.state == State::pass) v.state = worst_of(v);
  }
  std::map<std::string, Verdict> absent;
  for (const auto& [key, b] : baseline) {
    if (seen.contains(key)) continue;
    const std::size_t bar = key.find(" | ");
    const std::string id = key.substr(0, bar), metric = bar == std::string::npos ? "" : key.substr(bar + 3);
    Verdict& v = absent[id];
    v.case_id = id;
    v.title = "In the baseline only";
    v.state = State::skipped;
    v.reason =
        fmt::format("{}{}{}", v.reason.empty() ? "in the baseline, and not measured in this run: " : v.reason,
                    v.reason.empty() ? "" : ", ", metric);
    comparisons.push_back({id, metric, b.unit, State::skipped, b.value, kNone, b.noise});
  }
  for (auto& entry : absent) {
    Verdict& v = entry.second;
    // A case that was run has lost a metric: it keeps its own verdict.
    const auto same = [&](const Verdict& w) { return w.case_id == v.case_id; };
    if (std::any_of(verdicts.begin(), verdicts.end(), same)) v.case_id += " (baseline)";
    verdicts.push_back(std::move(v));
  }
  return comparisons;
}

std::string comparison_text(const std::vector<Comparison>& comparisons) {
  std::string text;
  std::map<State, int> counts;
  for (const Comparison& c : comparisons) {
    ++counts[c.state];
    const bool changed =
        std::isfinite(c.before) && std::isfinite(c.now) && std::abs(c.now - c.before) > c.noise;
    if (c.state == State::pass && !changed) continue;
    const auto number = [](double x) {
      return std::isfinite(x) ? fmt::format("{:.9g}", x) : std::string("none");
    };
    const char* what = c.state == State::pass ? "changed" : "";
    text += fmt::format("{:<11} {}: {}: {} -> {}{}{} (noise {:.2g})\n",
                        what[0] != '\0' ? what : reports::to_string(c.state), c.case_id, c.metric,
                        number(c.before), number(c.now), c.unit.empty() ? "" : " ", c.unit, c.noise);
  }
  text += fmt::format("{} metrics", comparisons.size());
  for (const State state : reports::kStatesWorstFirst) {
    if (counts[state] > 0) text += fmt::format(", {} {}", counts[state], reports::to_string(state));
  }
  return text + "\n";
}

}  // namespace ddem::harness::nightly
