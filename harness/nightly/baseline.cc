#include "harness/nightly/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/json.h"
#include "harness/measure/median.h"
#include "harness/nightly/summary.h"
#include "reports/margin.h"

namespace ddem::harness::nightly {
namespace {

using reports::Criterion;
using reports::State;
using reports::Verdict;

constexpr double kRoundOff = 1e-9, kShareOfBand = 0.01;

/// What the nights have of one metric.
struct Samples {
  std::vector<double> values;
  double noise = 0.0;
  std::string unit;
  bool passed = true;
};

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

double least_noise(const Criterion& c) {
  return std::max(kRoundOff * std::abs(c.actual), kShareOfBand * reports::half_width(c));
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
  Json metrics = Json::object();
  std::size_t left = baseline.size();
  for (const auto& [key, b] : baseline) {
    const Json line{{"value", b.value}, {"noise", b.noise}, {"unit", b.unit}};
    text += Json(key).dump() + ": " + line.dump() + (--left > 0 ? ",\n" : "\n");
    metrics[key] = line;
  }
  const Json document = sealed({{"schema_version", 1}, {"metrics", metrics}});
  return text + "},\n\"digest\": " + document.at("digest").dump() + "\n}\n";
}

Baseline parse_baseline(const std::string& text, const std::string& place) {
  try {
    const Json j = unsealed(parse_json(text, place), place);
    require_schema_version(j, place);
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
    throw InputError(place + ": not a baseline, as ddem baseline update writes it: " + in_words(e));
  }
}

Baseline read_baseline(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw InputError(path.string() + ": there is no such baseline; ddem baseline update makes one");
  const bool is_run = std::filesystem::is_directory(path, ignored);
  std::vector<std::string> left_out;
  Baseline baseline = is_run ? baseline_of({read_summary(path).verdicts}, left_out) : parse_baseline(read_file(path), path.string());
  if (baseline.empty()) {
    throw InputError(fmt::format("{}: {}: nothing can be compared with it; give a baseline, or the folder of a run, that has metrics",
                                 path.string(), is_run ? "not one metric of this run passed" : "holds not one metric"));
  }
  return baseline;
}

}  // namespace ddem::harness::nightly
