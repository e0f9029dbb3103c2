#include "harness/nightly/history_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "harness/nightly/baseline.h"
#include "reports/margin.h"
#include "reports/number.h"

namespace ddem::harness::nightly {
namespace {

using reports::Color;
using reports::Criterion;
using reports::Margin;

constexpr std::size_t kDrawnNights = 101, kPanels = 8, kRows = 60;
constexpr const char* kNightAxis = "night (0: this one)";

using Criteria = std::map<std::string, Criterion>;

/// By metric_key().
Criteria criteria_of(const Night& night) {
  Criteria criteria;
  for (const reports::Verdict& v : night.summary.verdicts) {
    for (const Criterion& c : v.criteria) criteria[metric_key(v.case_id, c.metric)] = c;
  }
  return criteria;
}

/// The nights that are drawn, by metric.
struct Drawn {
  std::vector<Criteria> nights;
  std::vector<double> x;

  explicit Drawn(const std::vector<Night>& all) {
    const std::size_t count = std::min(all.size(), kDrawnNights);
    for (std::size_t k = 0; k < count; ++k) {
      nights.push_back(criteria_of(all[all.size() - count + k]));
      x.push_back(static_cast<double>(k) - static_cast<double>(count - 1));
    }
  }
  /// Night by night, NaN where a night has it not.
  std::vector<double> values(const std::string& key) const {
    std::vector<double> all;
    for (const Criteria& night : nights) {
      const auto found = night.find(key);
      all.push_back(found == night.end() ? reports::kNone : found->second.actual);
    }
    return all;
  }
};

/// How far beyond its scatter the value is, over the window that shows it best; 0 where no window has one.
double surprise(const Trend& t) {
  double largest = 0.0;
  for (std::size_t w = 0; w < t.change.size(); ++w) {
    if (t.scatter[w] > 0.0) largest = std::max(largest, std::abs(t.change[w]) / t.scatter[w]);
  }
  return largest;
}

bool passed(const Trend& t) {
  return reports::is_pass(t.state) || t.state == reports::State::no_baseline;
}

int urgency(const Trend& t) {
  return t.regressed ? 0 : !passed(t) ? 1 : surprise(t) > 1.0 ? 2 : 3;
}

/// What a night's value is no change within: median -+ scatter of up to 4, 20, 100 nights before it, the longest first. `before`:
/// x of the nights that count.
template <class ToAxis>
std::vector<reports::Band> bands_of(const Trend& t, const std::vector<double>& before, const ToAxis& to_axis) {
  constexpr Color colors[] = {Color::orange, Color::sky, Color::grey};
  const auto nights = [&](std::size_t w) { return std::min(before.size(), static_cast<std::size_t>(kWindows[w])); };
  std::vector<reports::Band> bands;
  for (std::size_t w = std::size(kWindows); w-- > 0;) {
    const bool same_as_shorter = w > 0 && nights(w) == nights(w - 1);
    if (same_as_shorter || !std::isfinite(t.change[w])) continue;
    const double middle = t.now - t.change[w], begin = before[before.size() - nights(w)];
    const double lower = to_axis(middle - t.scatter[w]), upper = to_axis(middle + t.scatter[w]);
    bands.push_back({.name = fmt::format("no change from {} nights", kWindows[w]),
                     .x = {begin, 0.0},
                     .lower = {lower, lower},
                     .upper = {upper, upper},
                     .color = colors[w]});
  }
  return bands;
}

/// The nights before the last that have a value.
std::vector<double> places_before(const std::vector<double>& x, const std::vector<double>& values) {
  std::vector<double> places;
  for (std::size_t k = 0; k + 1 < values.size(); ++k) {
    if (std::isfinite(values[k])) places.push_back(x[k]);
  }
  return places;
}

/// A limit far from the nights would flatten what they do.
void add_near_limits(reports::Plot& plot, const Criterion& c, const Margin& margin) {
  double lowest = 0.0, highest = 0.0;
  for (const double y : plot.series.front().y) {
    if (std::isfinite(y)) lowest = std::min(lowest, y), highest = std::max(highest, y);
  }
  const double room = 0.5 * (highest - lowest);
  for (const auto& [bound, label] : {std::pair(c.lower, "lower limit"), std::pair(c.upper, "upper limit")}) {
    const double place = margin.of(bound);
    if (std::isfinite(bound) && place > lowest - room && place < highest + room)
      plot.references.push_back({.value = place, .label = label});
  }
}

reports::Plot metric_panel(const Drawn& drawn, const Trend& t) {
  const std::string key = metric_key(t.case_id, t.metric);
  const Criterion& c = drawn.nights.back().at(key);
  const Margin margin(c);
  const std::vector<double> values = drawn.values(key);
  const std::string state = t.regressed ? "REGRESSED: " : passed(t) ? "" : std::string(reports::to_string(t.state)) + ": ";
  reports::Plot plot{.title = fmt::format("{}{}: {}", state, t.case_id, t.metric),
                     .x = {.label = kNightAxis},
                     .y = {.label = "distance from right / half band"}};
  reports::Series series{.name = "night", .kind = reports::SeriesKind::line_markers, .x = drawn.x, .color = Color::black};
  for (const double v : values) series.y.push_back(margin.of(v));
  plot.series.push_back(std::move(series));
  plot.bands = bands_of(t, places_before(drawn.x, values), [&](double v) { return margin.of(v); });
  add_near_limits(plot, c, margin);
  return plot;
}

reports::Figure metrics_figure(const Drawn& drawn, const std::vector<Trend>& trends) {
  const std::size_t panels = std::min(kPanels, trends.size());
  reports::Figure figure{.id = "history-metrics", .title = "The metrics that need attention, over nights"};
  for (std::size_t k = 0; k < panels; ++k) figure.panels.emplace_back(metric_panel(drawn, trends[k]));
  const auto regressed = std::count_if(trends.begin(), trends.end(), [](const Trend& t) { return t.regressed; });
  figure.caption = fmt::format(
      "{} of {} metrics: those that regressed ({}) first, the furthest beyond their scatter leading; then those that did not pass, "
      "changed, "
      "or are nearest to their limits. 0 is right (the target, else the middle of the band), and ±1 ends the accuracy band; limits "
      "are drawn where the nights come near them. A last point outside a shaded band has changed: bands are the median "
      "of up to 4, 20 and 100 nights before, ± three standard deviations by the median step between nights, at least 1 % of the half band.",
      panels, trends.size(), regressed);
  return figure;
}

/// Each check's worst metric: how much of its accuracy band it takes.
reports::Figure margins_figure(const Drawn& drawn) {
  reports::Plot plot{.x = {.label = kNightAxis}, .y = {.label = "largest distance from right / half band"}};
  std::map<std::string, std::vector<double>> worst;
  for (std::size_t k = 0; k < drawn.nights.size(); ++k) {
    for (const auto& [key, c] : drawn.nights[k]) {
      const std::optional<double> share = reports::share_of_limit(c);
      if (!share) continue;
      std::vector<double>& check = worst.try_emplace(key.substr(0, key.find_first_of("/ ")), drawn.nights.size(), reports::kNone).first->second;
      if (!(*share <= check[k])) check[k] = *share;
    }
  }
  for (const auto& [check, shares] : worst)
    plot.series.push_back({.name = check, .kind = reports::SeriesKind::line_markers, .x = drawn.x, .y = shares});
  plot.references = {{.value = 1.0, .label = "accepted up to here"}};
  return {.id = "history-margins",
          .title = "How much of the accuracy bands is used, over nights",
          .caption =
              "Of every check the metric that is furthest from right, as a share of half its accuracy band on that night. A line that "
              "climbs towards 1 is a result that gets worse, long before it fails.",
          .panels = {plot}};
}

reports::Plot counts_panel(const std::vector<Night>& nights, const std::vector<double>& x) {
  reports::Plot plot{.title = "work", .x = {.label = kNightAxis}, .y = {.label = "count / that of this night"}};
  const auto add = [&](const char* name, std::int64_t WorkCounts::*count) {
    const std::int64_t now = nights.back().work.*count;
    if (now <= 0) return;
    reports::Series series{.name = name, .kind = reports::SeriesKind::line_markers, .x = x};
    for (std::size_t k = nights.size() - x.size(); k < nights.size(); ++k)
      series.y.push_back(static_cast<double>(nights[k].work.*count) / static_cast<double>(now));
    plot.series.push_back(std::move(series));
  };
  add("pieces of work", &WorkCounts::units);
  add("simulations", &WorkCounts::simulations);
  add("time steps", &WorkCounts::steps);
  add("finite-element runs", &WorkCounts::finite_element_runs);
  return plot;
}

reports::Figure work_figure(const std::vector<Night>& nights, const std::vector<double>& x, const Trend& wall) {
  reports::Plot time{.title = "wall time", .x = {.label = kNightAxis}, .y = {.label = "wall time", .unit = "s"}};
  reports::Series seconds{.name = "night", .kind = reports::SeriesKind::line_markers, .x = x, .color = Color::black};
  std::vector<double> as_much;  // where as much was computed
  for (std::size_t k = nights.size() - x.size(); k < nights.size(); ++k) {
    const double place = x[k + x.size() - nights.size()];
    seconds.y.push_back(nights[k].summary.wall_seconds);
    if (k + 1 < nights.size() && is_as_much_work(nights[k].work, nights.back().work)) as_much.push_back(place);
  }
  time.series = {seconds};
  time.bands = bands_of(wall, as_much, [](double v) { return v; });
  return {.id = "history-work",
          .title = "Wall time and work over nights",
          .caption =
              fmt::format("Left: seconds, and what is no change of them: the median of nights with as much work, ± its scatter, at least "
                          "20 %. {} Right: counts that no machine changes; a night that is slow at the same counts was slowed down, not "
                          "larger.",
                          wall.regressed ? "This night was slower." : "This night was not slower."),
          .panels = {time, counts_panel(nights, x)}};
}

reports::Table changes_table(const std::vector<Trend>& trends) {
  reports::Table table{.columns = {{"case"}, {"metric"}, {"trend"}, {"now", "", 6}, {"unit"}}};
  for (const int window : kWindows) {
    table.columns.push_back({fmt::format("from {} nights", window), "", 3});
    table.columns.push_back({"no change", "", 3});
  }
  std::size_t noteworthy = 0;
  for (const Trend& t : trends) {
    if (urgency(t) == 3 || ++noteworthy > kRows) continue;
    const std::string what = t.regressed ? "REGRESSED" : !passed(t) ? std::string(reports::to_string(t.state)) : "changed";
    std::vector<reports::Cell> row = {t.case_id, t.metric, what, t.now, t.unit};
    for (std::size_t w = 0; w < t.change.size(); ++w) row.insert(row.end(), {t.change[w], t.scatter[w]});
    table.rows.push_back(std::move(row));
  }
  table.caption = noteworthy == 0 ? "No metric regressed, failed or changed beyond its scatter."
                  : noteworthy <= kRows
                      ? "What regressed, did not pass or changed beyond its scatter: difference from the median of the nights before."
                      : fmt::format(
                            "The first {} of {} that regressed, did not pass or changed beyond their scatter: difference from the "
                            "median of the nights before; ddem history lists all.",
                            kRows, noteworthy);
  return table;
}

}  // namespace

std::vector<Trend> most_urgent(const std::vector<Night>& nights) {
  const Criteria last = criteria_of(nights.back());
  std::vector<std::pair<double, Trend>> ranked;  // with the distance from right
  for (Trend& t : trends_of(nights)) {
    const auto found = last.find(metric_key(t.case_id, t.metric));
    if (found == last.end()) continue;
    const Margin margin(found->second);
    if (!margin.has_scale()) continue;
    const double distance = std::abs(margin.of(t.now));
    ranked.emplace_back(std::isfinite(distance) ? distance : 0.0, std::move(t));
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    const int first = urgency(a.second), second = urgency(b.second);
    if (first != second) return first < second;
    return first == 3 ? a.first > b.first : surprise(a.second) > surprise(b.second);
  });
  std::vector<Trend> trends;
  for (auto& [distance, t] : ranked) trends.push_back(std::move(t));
  return trends;
}

reports::Section history_section(const std::vector<Night>& nights) {
  reports::Section section{.heading = "History"};
  if (nights.size() < 2) {
    section.paragraphs = {"This is the first night of its history: trends are drawn from the second on, and judged from the third on."};
    return section;
  }
  const std::vector<Trend> urgent = most_urgent(nights);
  const Trend wall = trends_of(nights).back();
  const auto regressed = std::count_if(urgent.begin(), urgent.end(), [](const Trend& t) { return t.regressed; });
  section.paragraphs = {
      fmt::format("{} nights, {} to {}; {} metrics with an accuracy band, {} of them regressed: worse than the median of the 4, 20 or 100 "
                  "nights before "
                  "by more than those nights scatter.",
                  nights.size(), nights.front().time, nights.back().time, urgent.size(), regressed)};
  for (std::string& complaint : clock_complaints(nights)) section.paragraphs.push_back(std::move(complaint) + ".");
  const Drawn drawn(nights);
  if (!urgent.empty()) section.figures = {metrics_figure(drawn, urgent), margins_figure(drawn)};
  section.figures.push_back(work_figure(nights, drawn.x, wall));
  section.tables = {changes_table(urgent)};
  return section;
}

}  // namespace ddem::harness::nightly
