#include "harness/nightly/history_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/nightly/baseline.h"
#include "harness/nightly/broken_since.h"
#include "harness/nightly/history_figures.h"
#include "reports/margin.h"
#include "reports/number.h"

namespace ddem::harness::nightly {
namespace {

constexpr std::size_t kInSight = 15;

reports::State worst_of(const Night& night) {
  const auto sorted = reports::worst_first(night.summary.verdicts);
  return sorted.empty() ? reports::State::skipped : sorted.front()->state;
}

/// A metric's way to its limit (reports::share_of_limit), a value a night; NaN where it has none.
struct Course {
  std::string case_id, metric;
  std::vector<double> share;

  /// Of the way to the limit, since the median of the nights before; NaN where there are none.
  double lost() const {
    std::vector<double> before;
    for (std::size_t k = 0; k + 1 < share.size(); ++k) {
      if (std::isfinite(share[k])) before.push_back(share[k]);
    }
    if (before.empty()) return reports::kNone;
    std::sort(before.begin(), before.end());
    return share.back() - 0.5 * (before[(before.size() - 1) / 2] + before[before.size() / 2]);
  }
};

/// Of the metrics of the last night; those that lost most first.
std::vector<Course> courses_of(const std::vector<Night>& nights) {
  std::vector<Course> courses;
  std::map<std::string, std::size_t> places;
  for (const reports::Verdict& v : nights.back().summary.verdicts) {
    for (const reports::Criterion& c : v.criteria) {
      if (places.try_emplace(metric_key(v.case_id, c.metric), courses.size()).second)
        courses.push_back({v.case_id, c.metric, std::vector<double>(nights.size(), reports::kNone)});
    }
  }
  for (std::size_t n = 0; n < nights.size(); ++n) {
    for (const reports::Verdict& v : nights[n].summary.verdicts) {
      for (const reports::Criterion& c : v.criteria) {
        const auto place = places.find(metric_key(v.case_id, c.metric));
        if (place != places.end()) courses[place->second].share[n] = std::fmax(courses[place->second].share[n], reports::share_of_limit(c).value_or(reports::kNone));
      }
    }
  }
  std::erase_if(courses, [](const Course& c) { return std::none_of(c.share.begin(), c.share.end(), [](double v) { return std::isfinite(v); }); });
  // What is not measured any more comes first, what is new last.
  const auto rank = [](const Course& c) { return !std::isfinite(c.share.back()) ? HUGE_VAL : std::isfinite(c.lost()) ? c.lost() : -HUGE_VAL; };
  std::stable_sort(courses.begin(), courses.end(), [&](const Course& a, const Course& b) { return rank(a) > rank(b); });
  return courses;
}

/// In tenths of a per cent.
double rounded(double share) { return std::round(1000.0 * share) / 10.0; }

reports::Table table_of(const std::string& caption, std::span<const Course> courses) {
  reports::Table table{.caption = caption, .columns = {{"case"}, {"metric"}, {"over the nights"}, {"way to its limit", "%", 3}, {"lost since", "%", 2}}, .rows = {}};
  for (const Course& c : courses) table.rows.push_back({c.case_id, c.metric, reports::Spark{c.share}, rounded(c.share.back()), rounded(c.lost())});
  return table;
}

}  // namespace

reports::Report history_page(const std::vector<Night>& nights) {
  const Night& last = nights.back();
  reports::Report page{.title = last.summary.title + ": its nights"};
  page.findings = broken_since(nights);
  const auto failed = std::count_if(nights.begin(), nights.end(), [](const Night& n) { return reports::is_failure(worst_of(n)); });
  page.findings.push_back(fmt::format("The last night, {}: {}. Nights: {}, of which {} failed.", last.time, reports::headcount(last.summary.verdicts), nights.size(), failed));
  for (const Night& night : nights) page.nights.push_back({fmt::format("{}: {}", night.time, reports::headcount(night.summary.verdicts)), worst_of(night)});
  const std::vector<Course> courses = courses_of(nights);
  const std::size_t shown = std::min(courses.size(), kInSight);
  reports::Section metrics{.heading = "Metrics by the margin that they lost",
                           .paragraphs = {"How far each is on the way from right to its limit (100 %), this night and over all nights, and how much of that way it lost since the "
                                          "median of the nights before."}};
  const std::span<const Course> all(courses);
  metrics.tables.push_back(table_of("", all.first(shown)));
  if (courses.size() > shown) metrics.tables.push_back(table_of("All others", all.subspan(shown)));
  page.sections = {std::move(metrics), history_section(nights)};
  page.provenance = last.summary.provenance;
  return page;
}

}  // namespace ddem::harness::nightly
