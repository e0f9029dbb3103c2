#include "harness/nightly/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/nightly/baseline.h"

namespace ddem::harness::nightly {
namespace {

namespace fs = std::filesystem;
using reports::Criterion;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kSlower = 0.2;  // of a wall time: a busy machine's
// From the median step between nights to three standard deviations of a night, normally distributed.
constexpr double kDeviationsAStep = 3.0 * 1.4826 / std::numbers::sqrt2;
constexpr const char* kWallTime = "wall time";

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// Three standard deviations of a night, from the steps between nights: a slow drift hardly enters it.
double scatter_of(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k) steps.push_back(std::abs(values[k] - values[k - 1]));
  return kDeviationsAStep * median(steps);
}

Json night_json(const Night& n) {
  Json j = summary_json(n.summary);
  j["time"] = n.time;
  j["work"] = {{"units", n.work.units},
               {"simulations", n.work.simulations},
               {"steps", n.work.steps},
               {"finite_element_runs", n.work.finite_element_runs}};
  j["seeds"] = n.work.seeds;
  return j;
}

Night parse_night(const fs::path& path) {
  const Json j = read_json(path);
  Night n{"", parse_summary(j, path.string()), {}};
  try {
    n.time = j.at("time");
    const Json& w = j.at("work");
    n.work = {w.at("units"), w.at("simulations"), w.at("steps"), w.at("finite_element_runs"),
              j.at("seeds").get<std::vector<std::int64_t>>()};
  } catch (const Json::exception& e) {
    throw InputError(path.string() + ": not a night, as ddem validate --history writes it: " + e.what());
  }
  return n;
}

/// Sorted by name.
std::vector<fs::path> night_files(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".json" && !name.starts_with('.')) files.push_back(entry.path());
  }
  if (error) throw InputError(folder.string() + ": cannot read the folder: " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

/// The earliest first. InputError naming every file that is no night.
std::vector<Night> nights_of(const std::vector<fs::path>& files) {
  std::vector<Night> nights;
  std::vector<std::string> problems;
  for (const fs::path& file : files) {
    try {
      nights.push_back(parse_night(file));
    } catch (const InputError& e) {
      problems.push_back(e.what());
    }
  }
  if (!problems.empty()) throw InputError(problems);
  // Of one second those that were written later, whose names sort later, come later.
  std::stable_sort(nights.begin(), nights.end(), [](const Night& a, const Night& b) { return a.time < b.time; });
  return nights;
}

/// The finite values of each metric, night by night.
using Series = std::map<std::string, std::vector<double>>;

Series series_of(const std::vector<Night>& nights) {
  Series series;
  for (const Night& n : nights) {
    for (const reports::Verdict& v : n.summary.verdicts) {
      for (const Criterion& c : v.criteria) {
        if (std::isfinite(c.actual)) series[metric_key(v.case_id, c.metric)].push_back(c.actual);
      }
    }
    series[kWallTime].push_back(n.summary.wall_seconds);
  }
  return series;
}

Trend trend_of(const Criterion& c, const std::string& case_id, const std::vector<double>& before,
               double floor_share) {
  Trend t{case_id, c.metric, c.unit, c.actual, {}, {}, false, c.state};
  for (const int window : kWindows) {
    const std::size_t n = std::min(before.size(), static_cast<std::size_t>(window));
    if (n < 2 || !std::isfinite(c.actual)) {
      t.change.push_back(kNone);
      t.scatter.push_back(kNone);
      continue;
    }
    const std::vector<double> recent(before.end() - static_cast<std::ptrdiff_t>(n), before.end());
    const double middle = median(recent);
    const double scatter = std::max({scatter_of(recent), least_noise(c), floor_share * middle});
    t.change.push_back(c.actual - middle);
    t.scatter.push_back(scatter);
    if (badness(c, c.actual, middle) > badness(c, middle, middle) + scatter) t.regressed = true;
  }
  return t;
}

bool changed(const Trend& t) {
  for (std::size_t w = 0; w < t.change.size(); ++w) {
    if (std::abs(t.change[w]) > t.scatter[w]) return true;
  }
  return false;
}

}  // namespace

fs::path append_night(const fs::path& folder, const Night& night) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw machine_error(folder.string(), "cannot create the folder", error.value());
  std::string name = night.time;
  std::erase(name, ':');
  fs::path path = folder / (name + ".json");
  for (int k = 2; fs::exists(path, error); ++k) path = folder / fmt::format("{}_{:03}.json", name, k);
  write_json(path, night_json(night));
  return path;
}

std::vector<Night> read_history(const fs::path& folder) {
  std::vector<Night> nights = nights_of(night_files(folder));
  if (nights.empty()) throw InputError(folder.string() + ": no nights; ddem validate --history adds one a run");
  return nights;
}

std::vector<Night> nights_so_far(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return {};
  return nights_of(night_files(folder));
}

bool is_as_much_work(const WorkCounts& a, const WorkCounts& b) {
  return a.steps == b.steps && a.units == b.units;
}

std::vector<Trend> trends_of(const std::vector<Night>& nights) {
  const Series series = series_of({nights.begin(), nights.end() - 1});
  const auto before = [&](const std::string& key) {
    const auto found = series.find(key);
    return found == series.end() ? std::vector<double>{} : found->second;
  };
  std::vector<Trend> trends;
  for (const reports::Verdict& v : nights.back().summary.verdicts) {
    for (const Criterion& c : v.criteria)
      trends.push_back(trend_of(c, v.case_id, before(metric_key(v.case_id, c.metric)), 0.0));
  }
  // A bound above: less is better.
  const Criterion wall{.metric = kWallTime,
                       .actual = nights.back().summary.wall_seconds,
                       .upper = 0.0,
                       .unit = "s",
                       .state = reports::State::pass};
  std::vector<double> earlier;  // of nights with as much work
  for (auto n = nights.begin(); n + 1 != nights.end(); ++n) {
    if (is_as_much_work(n->work, nights.back().work))
      earlier.push_back(n->summary.wall_seconds);
  }
  trends.push_back(trend_of(wall, "", earlier, kSlower));
  return trends;
}

std::string trends_text(const std::vector<Night>& nights, const std::vector<Trend>& trends, bool all) {
  std::string text;
  int regressions = 0;
  for (const Trend& t : trends) {
    regressions += t.regressed;
    const bool passed = reports::is_pass(t.state) || t.state == reports::State::no_baseline;
    if (!all && !t.regressed && !changed(t) && passed) continue;
    const std::string_view what = t.regressed  ? "REGRESSED"
                                  : !passed    ? reports::to_string(t.state)
                                  : changed(t) ? "changed"
                                               : "same";
    text += fmt::format("{:<11} {}{}{}: {:.9g}{}{}", what, t.case_id, t.case_id.empty() ? "" : ": ", t.metric,
                        t.now, t.unit.empty() ? "" : " ", t.unit);
    for (std::size_t w = 0; w < t.change.size(); ++w) {
      if (std::isfinite(t.change[w]))
        text += fmt::format("; {} nights: {:+.2g} (+-{:.2g})", kWindows[w], t.change[w], t.scatter[w]);
    }
    text += '\n';
  }
  return text + fmt::format("{} nights, {} to {}; {} metrics, {} regressed\n", nights.size(),
                            nights.front().time, nights.back().time, trends.size(), regressions);
}

}  // namespace ddem::harness::nightly
