#include "harness/bench/scaling_figure.h"

#include <algorithm>
#include <map>

#include "reports/number.h"

namespace ddem::harness::bench {
namespace {

constexpr double kMegabyte = 1e6;

bool of_one_line(const ScalingPoint& a, const ScalingPoint& b) { return a.task == b.task && a.arrangement == b.arrangement; }

reports::Series series_of(const ScalingPoint& p) {
  using enum reports::Color;
  static const std::map<std::string, reports::Color> colors{{"pack", orange}, {"moduli", vermilion}, {"stability", sky}, {"run DEM", blue}, {"run lagged", green}, {"run implicit", purple}};
  const auto color = colors.find(p.task);
  return {.name = p.task + ", " + name_of(p.arrangement),
          .kind = reports::SeriesKind::line_markers,
          .color = color == colors.end() ? automatic : color->second,
          .dash = p.arrangement == Arrangement::lattice ? reports::Dash::dashed : reports::Dash::solid};
}

reports::Plot panel(const std::vector<ScalingPoint>& points, const char* label, double unit, double ScalingPoint::* value) {
  reports::Plot plot{.x = {.label = "discs", .scale = reports::Scale::log}, .y = {.label = label, .scale = reports::Scale::log}};
  for (const ScalingPoint& p : points) {
    if (p.status != "ok") continue;
    const reports::Series fresh = series_of(p);
    auto series = std::ranges::find(plot.series, fresh.name, &reports::Series::name);
    if (series == plot.series.end()) series = plot.series.insert(series, fresh);
    series->x.push_back(static_cast<double>(p.discs));
    series->y.push_back(p.*value / unit);
  }
  return plot;
}

}  // namespace

reports::Figure scaling_figure(const std::vector<ScalingPoint>& points) {
  return {.id = "scaling",
          .title = "Time and memory against the number of discs",
          .caption = "Whole commands, from their start to their end: what a program needs by itself stands at the left, what a disc needs is the slope. "
                     "pack: jammed from nothing; above 20000 discs copies of one cell. moduli: of a periodic cell of rigid discs. stability: of a strip with lagged strains. run: 300 steps.",
          .panels = {panel(points, "wall time (s)", 1.0, &ScalingPoint::seconds), panel(points, "memory (MB)", kMegabyte, &ScalingPoint::bytes)}};
}

reports::Table scaling_table(const std::vector<ScalingPoint>& points) {
  reports::Table t;
  t.caption = "Growth: the power of the number of discs with which time and memory have grown since the size before.";
  t.columns = {{"command"}, {"packing"}, {"discs", "", 8}, {"time", "s", 3}, {"growth of time", "", 2}, {"memory", "MB", 3}, {"growth of memory", "", 2}, {"status"}};
  for (auto p = points.begin(); p != points.end(); ++p) {
    const auto before = std::find_if(std::make_reverse_iterator(p), points.rend(), [&](const ScalingPoint& q) { return of_one_line(*p, q); });
    const auto grown = [&](double ScalingPoint::* value) { return before == points.rend() ? reports::kNone : growth(*before, *p, value).value_or(reports::kNone); };
    const bool ok = p->status == "ok";
    t.rows.push_back({p->task, name_of(p->arrangement), p->discs, ok ? p->seconds : reports::kNone, grown(&ScalingPoint::seconds), ok ? p->bytes / kMegabyte : reports::kNone,
                      grown(&ScalingPoint::bytes), p->status});
  }
  return t;
}

}  // namespace ddem::harness::bench
