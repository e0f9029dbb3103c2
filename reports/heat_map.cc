#include "reports/heat_map.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/color.h"
#include "reports/number.h"

namespace ddem::reports {
namespace {

constexpr int kColors = 41;  // odd: signed maps have a white of their own

/// Edges of the cells: halfway between the centres, on the axis's scale.
std::vector<double> edges_of(std::vector<double> centres, Scale scale) {
  const bool log = scale == Scale::log;
  if (log)
    for (double& c : centres) c = std::log(c);
  std::vector<double> edges = {centres[0] - 0.5 * (centres[1] - centres[0])};
  for (std::size_t i = 1; i < centres.size(); ++i) edges.push_back(0.5 * (centres[i - 1] + centres[i]));
  const std::size_t last = centres.size() - 1;
  edges.push_back(centres[last] + 0.5 * (centres[last] - centres[last - 1]));
  if (log)
    for (double& e : edges) e = std::exp(e);
  return edges;
}

/// 0 .. 1 from one end of the colour bar to the other; NaN: no colour.
double fraction_of(const HeatMap& map, double value) {
  const auto [lower, upper] = *map.value_axis.limits;
  const auto decades = [lower = lower, upper = upper](double v) { return std::log(v / lower) / std::log(upper / lower); };
  if (!std::isfinite(value)) return std::nan("");
  switch (map.scale) {
    case ColorScale::linear: return std::clamp((value - lower) / (upper - lower), 0.0, 1.0);
    case ColorScale::log: return value > 0.0 ? std::clamp(decades(value), 0.0, 1.0) : std::nan("");
    case ColorScale::signed_log: break;
  }
  if (std::abs(value) <= lower) return 0.5;
  return 0.5 + 0.5 * std::copysign(std::min(decades(std::abs(value)), 1.0), value);
}

std::string color_of(const HeatMap& map, double fraction) {
  // From white, so that lines of any colour stand out.
  return hex(map.scale == ColorScale::signed_log ? diverging(2.0 * fraction - 1.0) : diverging(-fraction));
}

int color_index(double fraction) {
  return std::isfinite(fraction) ? static_cast<int>(std::lround(fraction * (kColors - 1))) : -1;
}

std::vector<Tick> ticks_of(const HeatMap& map, double height) {
  const Axis axis{.scale = map.scale == ColorScale::linear ? Scale::linear : Scale::log};
  const double part = map.scale == ColorScale::signed_log ? 0.5 * height : height;
  const AxisMarks marks = axis_marks(axis, *map.value_axis.limits, std::max(2, static_cast<int>(part / 30.0)));
  std::vector<Tick> ticks = marks.ticks;
  if (map.scale != ColorScale::signed_log) return ticks;
  for (const Tick& t : marks.ticks) ticks.push_back({-t.value, "−" + t.label});
  const double smallest = map.value_axis.limits->lower;
  std::erase_if(ticks, [&](const Tick& t) { return std::abs(t.value) <= 1.001 * smallest; });
  ticks.push_back({0.0, "0"});
  return ticks;
}

}  // namespace

Limits map_extent(const std::vector<double>& centres, Scale scale) {
  const std::vector<double> edges = edges_of(centres, scale);
  return {edges.front(), edges.back()};
}

void draw_cells(Markup& out, const HeatMap& map, const Plot& plot, const AxisScale& x, const AxisScale& y, const Rect& area) {
  const std::vector<double> columns = edges_of(map.x, plot.x.scale), rows = edges_of(map.y, plot.y.scale);
  const auto across = [&](double v) { return std::clamp(std::round(x.pixel(v)), area.left, area.right()); };
  const auto up = [&](double v) { return std::clamp(std::round(y.pixel(v)), area.top, area.bottom()); };
  std::map<int, std::string> paths;
  for (std::size_t row = 0; row < map.y.size(); ++row) {
    const double top = up(rows[row + 1]), height = up(rows[row]) - top;
    for (std::size_t begin = 0; begin < map.x.size();) {
      const auto color = [&](std::size_t column) { return color_index(fraction_of(map, map.value[row * map.x.size() + column])); };
      const int mine = color(begin);
      std::size_t end = begin + 1;
      while (end < map.x.size() && color(end) == mine) ++end;
      const double left = across(columns[begin]), width = across(columns[end]) - left;
      begin = end;
      if (!(width > 0.0 && height > 0.0)) continue;
      paths[mine] += "M" + coordinate(left) + " " + coordinate(top) + "h" + coordinate(width) + "v" + coordinate(height) + "h" + coordinate(-width) + "z";
    }
  }
  out.open("g", {{"class", "map"}, {"shape-rendering", "crispEdges"}});
  for (const auto& [index, path] : paths) {
    const std::string fill = index < 0 ? "#c4c4c4" : color_of(map, static_cast<double>(index) / (kColors - 1));
    out.empty("path", {{"d", path}, {"fill", fill}});
  }
  out.close().newline();
}

std::vector<ColorTick> color_ticks(const HeatMap& map, double height) {
  std::vector<ColorTick> ticks;
  for (const Tick& t : ticks_of(map, height)) ticks.push_back({fraction_of(map, t.value), t.label});
  return ticks;
}

std::string color_title(const HeatMap& map) {
  return map.value_axis.label + (map.value_axis.unit.empty() ? "" : " (" + map.value_axis.unit + ")");
}

void draw_color_bar(Markup& out, const HeatMap& map, const Rect& area) {
  constexpr double gap = 8.0, width = 11.0;
  const double left = area.right() + gap, cell = area.height / kColors;
  out.open("g", {{"class", "colorbar"}});
  for (int i = 0; i < kColors; ++i) {
    // Half a pixel of overlap hides the seams of anti-aliasing.
    out.empty("rect", {{"x", left},
                       {"y", area.bottom() - (i + 1) * cell},
                       {"width", width},
                       {"height", i > 0 ? cell + 0.5 : cell},
                       {"fill", color_of(map, static_cast<double>(i) / (kColors - 1))}});
  }
  out.open("g", {{"fill", "#444"}});
  for (const ColorTick& t : color_ticks(map, area.height)) {
    const double py = area.bottom() - t.fraction * area.height;
    out.empty("line", {{"x1", left + width}, {"x2", left + width + 3}, {"y1", py}, {"y2", py}, {"stroke", "#7a828c"}});
    out.element("text", {{"x", left + width + 5}, {"y", py + 4.2}, {"font-size", kTickFont - 1}}, t.label);
  }
  out.element("text", {{"x", area.right() + kColorBarRoom - 4}, {"y", area.top - 8}, {"text-anchor", "end"}, {"font-size", kTickFont + 1}}, color_title(map));
  out.close().close().newline();
}

}  // namespace ddem::reports
