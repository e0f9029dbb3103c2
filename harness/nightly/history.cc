#include "harness/nightly/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include "harness/io/errors.h"
#include "harness/io/folder_lock.h"
#include "harness/measure/median.h"
#include "harness/nightly/baseline.h"
#include "reports/number.h"

namespace ddem::harness::nightly {
namespace {

namespace fs = std::filesystem;
using reports::Criterion;

constexpr double kSlower = 0.2;  // of a wall time: a busy machine's
constexpr double kWaits = 0.3;  // s: three slices of Linux' scheduler, at the start, at that of the workers, at the end
// From the median step between nights to three standard deviations of a night, normally distributed.
constexpr double kDeviationsAStep = 3.0 * 1.4826 / std::numbers::sqrt2;
constexpr const char* kWallTime = "wall time";

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
    throw InputError(path.string() + ": not a night, as ddem validate --history writes it: " + in_words(e));
  }
  return n;
}

constexpr std::string_view kPrefix = "night-";

/// Of a file's name; 0: a night of a version that did not count them.
long number_of(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with(kPrefix)) return 0;
  long number = 0;
  const auto [end, error] = std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), number);
  return error == std::errc{} && *end == '_' ? number : 0;
}

/// As append_night() calls files, or, those of versions that did not count them, "2026-11-22T020000Z".
bool is_called_as_a_night(const fs::path& file) {
  if (number_of(file) > 0) return true;
  constexpr std::string_view kTime = "dddd-dd-ddTddddddZ";
  const std::string start = file.filename().string().substr(0, kTime.size());
  return std::equal(kTime.begin(), kTime.end(), start.begin(), start.end(),
                    [](char pattern, char c) { return pattern == 'd' ? c >= '0' && c <= '9' : pattern == c; });
}

struct JsonFiles {
  std::vector<fs::path> nights, others;  ///< by number, then by name; by name
};

JsonFiles json_files(const fs::path& folder) {
  std::error_code error;
  JsonFiles files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& file = entry.path();
    if (file.extension() == ".json" && !file.filename().string().starts_with('.'))
      (is_called_as_a_night(file) ? files.nights : files.others).push_back(file);
  }
  if (error) throw InputError(folder.string() + ": cannot read the folder: " + error.message());
  std::sort(files.nights.begin(), files.nights.end(),
            [](const fs::path& a, const fs::path& b) { return std::pair(number_of(a), a) < std::pair(number_of(b), b); });
  std::sort(files.others.begin(), files.others.end());
  return files;
}

/// In the order of the files, those that are not counted by time. InputError naming every file that is no night.
std::vector<Night> nights_of(const std::vector<fs::path>& files) {
  std::vector<Night> nights;
  std::vector<std::string> problems;
  std::ptrdiff_t uncounted = 0;
  for (const fs::path& file : files) {
    try {
      nights.push_back(parse_night(file));
      uncounted += number_of(file) == 0;
    } catch (const InputError& e) {
      problems.push_back(e.what());
    }
  }
  if (!problems.empty()) throw InputError(problems);
  // Of one second those that were written later, whose names sort later, come later.
  std::stable_sort(nights.begin(), nights.begin() + uncounted, [](const Night& a, const Night& b) { return a.time < b.time; });
  return nights;
}

/// Others hold it for moments only, and a night that was run must not be lost for them.
std::unique_ptr<FolderLock> lock_history(const fs::path& folder) {
  constexpr int kTries = 60;  // of a second each
  for (int k = 1; k < kTries; ++k) {
    try {
      return std::make_unique<FolderLock>(folder);
    } catch (const InputError&) {  // held
    }
  }
  return std::make_unique<FolderLock>(folder);
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
               const std::function<double(double)>& floor) {
  Trend t{case_id, c.metric, c.unit, c.actual, {}, {}, false, c.state};
  for (const int window : kWindows) {
    const std::size_t n = std::min(before.size(), static_cast<std::size_t>(window));
    if (n < 2 || !std::isfinite(c.actual)) {
      t.change.push_back(reports::kNone);
      t.scatter.push_back(reports::kNone);
      continue;
    }
    const std::vector<double> recent(before.end() - static_cast<std::ptrdiff_t>(n), before.end());
    const double middle = median(recent);
    const double scatter = std::max({scatter_of(recent), least_noise(c), floor(middle)});
    t.change.push_back(c.actual - middle);
    t.scatter.push_back(scatter);
    if (badness(c, c.actual, middle) > badness(c, middle, middle) + scatter) t.regressed = true;
  }
  return t;
}

/// Of the night before, that has a value there.
void add_missing(const std::vector<Night>& nights, std::vector<Trend>& trends) {
  if (nights.size() < 2) return;
  std::set<std::string> measured;
  for (const Trend& t : trends) measured.insert(metric_key(t.case_id, t.metric));
  const std::vector<double> none(std::size(kWindows), reports::kNone);
  for (const reports::Verdict& v : nights[nights.size() - 2].summary.verdicts) {
    for (const Criterion& c : v.criteria) {
      if (std::isfinite(c.actual) && !measured.contains(metric_key(v.case_id, c.metric)))
        trends.push_back({v.case_id, c.metric, c.unit, reports::kNone, none, none, false, reports::State::missing});
    }
  }
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
  std::string time = night.time;
  std::erase(time, ':');
  const std::unique_ptr<FolderLock> lock = lock_history(folder);
  const std::vector<fs::path> files = json_files(folder).nights;
  const long last = files.empty() ? 0 : number_of(files.back());
  const fs::path path = folder / fmt::format("{}{:06}_{}.json", kPrefix, last + 1, time);
  write_json(path, sealed(night_json(night)));
  return path;
}

std::vector<std::string> clock_complaints(const std::vector<Night>& nights, const std::string& now) {
  std::vector<std::string> complaints;
  const std::string* latest = nullptr;
  for (const Night& n : nights) {
    if (latest != nullptr && n.time < *latest)
      complaints.push_back(fmt::format("clocks disagree: the night of {} was added after that of {}", n.time, *latest));
    if (latest == nullptr || n.time > *latest) latest = &n.time;
  }
  if (latest != nullptr && !now.empty() && *latest > now)
    complaints.push_back(fmt::format("clocks disagree: a night is dated {}, and it is {}", *latest, now));
  if (!complaints.empty()) complaints.push_back("nights stand in the order in which they were added");
  return complaints;
}

std::vector<Night> read_history(const fs::path& folder) {
  std::vector<Night> nights = nights_of(json_files(folder).nights);
  if (nights.empty()) throw InputError(folder.string() + ": no nights; ddem validate --history adds one a run");
  return nights;
}

std::vector<Night> nights_so_far(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return {};
  return nights_of(json_files(folder).nights);
}

std::vector<fs::path> files_beside_nights(const fs::path& folder) {
  return json_files(folder).others;
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
      trends.push_back(trend_of(c, v.case_id, before(metric_key(v.case_id, c.metric)), [](double) { return 0.0; }));
  }
  add_missing(nights, trends);
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
  trends.push_back(trend_of(wall, "", earlier, [](double middle) { return std::max(kSlower * middle, kWaits); }));
  return trends;
}

std::string trends_text(const std::vector<Night>& nights, const std::vector<Trend>& trends, bool all) {
  std::string text;
  int regressions = 0, missing = 0;
  for (const Trend& t : trends) {
    regressions += t.regressed;
    missing += t.state == reports::State::missing;
    const bool passed = reports::is_pass(t.state) || t.state == reports::State::no_baseline;
    if (!all && !t.regressed && !changed(t) && passed) continue;
    const std::string_view what = t.regressed  ? "REGRESSED"
                                  : !passed    ? reports::to_string(t.state)
                                  : changed(t) ? "changed"
                                               : "same";
    text += fmt::format("{:<11} {}{}{}: {}{}{}", what, t.case_id, t.case_id.empty() ? "" : ": ", t.metric,
                        std::isfinite(t.now) ? fmt::format("{:.9g}", t.now) : "none", t.unit.empty() ? "" : " ", t.unit);
    for (std::size_t w = 0; w < t.change.size(); ++w) {
      if (std::isfinite(t.change[w]))
        text += fmt::format("; {} nights: {:+.2g} (+-{:.2g})", kWindows[w], t.change[w], t.scatter[w]);
    }
    text += '\n';
  }
  return text + fmt::format("{} nights, {} to {}; {} metrics, {} regressed{}\n", nights.size(), nights.front().time,
                            nights.back().time, trends.size(), regressions,
                            missing == 0 ? "" : fmt::format(", {} MISSING: the night before had them", missing));
}

}  // namespace ddem::harness::nightly
