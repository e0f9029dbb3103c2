#include "reports/strip.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "reports/axis.h"
#include "reports/color.h"
#include "reports/number.h"
#include "reports/plot.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

constexpr double kTallest = 460.0;  // pixels; a narrow, high assembly is centred instead of filling the width
constexpr double kProbeRow = 26.0;  // labels and leaders above and below the discs
constexpr double kColorBar = 58.0;  // bar, ticks and title
constexpr double kLengthAxis = 40.0;  // ticks and title of the length axis
constexpr std::size_t kColorBins = 128;

struct Bounds {
  double left = 0.0, right = 1.0, bottom = 0.0, top = 1.0;  // m
};

Bounds bounds_of(const Strip& strip) {
  if (strip.x.empty()) return {};
  Bounds b{strip.x[0], strip.x[0], strip.y[0], strip.y[0]};
  for (std::size_t i = 0; i < strip.x.size(); ++i) {
    b.left = std::min(b.left, strip.x[i] - strip.radius[i]);
    b.right = std::max(b.right, strip.x[i] + strip.radius[i]);
    b.bottom = std::min(b.bottom, strip.y[i] - strip.radius[i]);
    b.top = std::max(b.top, strip.y[i] + strip.radius[i]);
  }
  return b;
}

Limits value_limits(const Strip& strip) {
  if (strip.value_axis.limits) return *strip.value_axis.limits;
  Extent extent(Scale::linear);
  for (const double v : strip.value) extent.add(v);
  return extent.padded(0.0);
}

/// Where things go, in pixels; `scale` is pixels a metre, the same in x and y.
struct Layout {
  Bounds bounds;
  double scale = 1.0;
  Rect discs;
  double total_height = 0.0;
  Point pixel(double x, double y) const {
    return {discs.left + (x - bounds.left) * scale, discs.bottom() - (y - bounds.bottom) * scale};
  }
};

Layout layout_of(const Strip& strip, Point corner, double width) {
  Layout l;
  l.bounds = bounds_of(strip);
  constexpr double side = 10.0;
  const double inner = width - 2 * side;
  const double span_x = l.bounds.right - l.bounds.left, span_y = l.bounds.top - l.bounds.bottom;
  l.scale = std::min(inner / span_x, kTallest / span_y);
  const double top = (strip.title.empty() ? 4.0 : 22.0) + (strip.probes.empty() ? 0.0 : kProbeRow);
  l.discs = {corner.x + side + (inner - span_x * l.scale) / 2.0, corner.y + top, span_x * l.scale,
             span_y * l.scale};
  l.total_height = top + l.discs.height + (strip.probes.empty() ? 0.0 : kProbeRow) + kLengthAxis +
                   (strip.value.empty() ? 0.0 : kColorBar);
  return l;
}

/// Values of both signs, to symmetric limits, from blue through white to red; others in viridis.
std::string color_at(Limits limits, double fraction) {
  return hex(is_signed(limits) ? diverging(2.0 * fraction - 1.0) : viridis(fraction));
}

double fraction_of(double value, Limits limits) {
  // Halves, so that the span of the largest limits does not overflow.
  return (value / 2 - limits.lower / 2) / (limits.upper / 2 - limits.lower / 2);
}

// Discs of one colour share a group, which halves the size of the file.
void draw_discs(Markup& out, const Strip& strip, const Layout& l) {
  const std::size_t count = strip.x.size();
  const std::size_t stride = (count + kMaxDiscs - 1) / std::max<std::size_t>(kMaxDiscs, 1);
  const double enlarge = std::sqrt(static_cast<double>(std::max<std::size_t>(stride, 1)));
  const Limits limits = value_limits(strip);
  std::vector<std::vector<std::size_t>> bins(kColorBins + 1);  // the last one: no value
  for (std::size_t i = 0; i < count; i += stride) {
    std::size_t bin = kColorBins;
    if (!strip.value.empty() && drawable(strip.value[i], Scale::linear)) {
      const double t = std::clamp(fraction_of(strip.value[i], limits), 0.0, 1.0);
      bin = static_cast<std::size_t>(std::lround(t * (kColorBins - 1)));
    }
    bins[bin].push_back(i);
  }
  out.open("g",
           {{"class", "discs"},
            {"stroke", is_signed(limits) ? "#9aa3ad" : "#fff"},
            {"stroke-width", l.discs.width > 600 ? "0.5" : "0.25"}});
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    if (bins[bin].empty()) continue;
    const std::string color = bin == kColorBins ? std::string(strip.value.empty() ? "#a9bdd0" : "#c4c4c4")
                                                : color_at(limits, static_cast<double>(bin) / (kColorBins - 1));
    out.open("g", {{"fill", color}});
    for (const std::size_t i : bins[bin]) {
      const Point c = l.pixel(strip.x[i], strip.y[i]);
      out.empty("circle", {{"cx", c.x}, {"cy", c.y}, {"r", strip.radius[i] * l.scale * enlarge}});
    }
    out.close().newline();
  }
  out.close().newline();
}

void draw_length_axis(Markup& out, const Strip& strip, const Layout& l) {
  const double y = l.discs.bottom() + (strip.probes.empty() ? 0.0 : kProbeRow) + 6.0;
  const Axis axis{.label = "x", .unit = "m"};
  const Limits limits{l.bounds.left, l.bounds.right};
  const AxisMarks marks = axis_marks_along(axis, limits, l.discs.width);
  const AxisScale scale(Scale::linear, limits, l.discs.left, l.discs.right());
  out.open("g", {{"class", "length"}, {"text-anchor", "middle"}, {"fill", "#444"}});
  out.empty("line",
            {{"x1", l.discs.left}, {"x2", l.discs.right()}, {"y1", y}, {"y2", y}, {"stroke", "#7a828c"}});
  for (const Tick& t : marks.ticks) {
    const double px = scale.pixel(t.value);
    out.empty("line", {{"x1", px}, {"x2", px}, {"y1", y}, {"y2", y + 4}, {"stroke", "#7a828c"}});
    out.element("text", {{"x", px}, {"y", y + 17}}, t.label);
  }
  out.element("text",
              {{"x", l.discs.left + l.discs.width / 2.0}, {"y", y + 33}, {"font-size", kTickFont + 1}},
              marks.title);
  out.close().newline();
}

void draw_color_bar(Markup& out, const Strip& strip, const Layout& l, double top) {
  const double width = std::min(320.0, std::max(160.0, l.discs.width * 0.6));
  const double left = l.discs.left + (l.discs.width - width) / 2.0;
  const Limits limits = value_limits(strip);
  const AxisMarks marks = axis_marks_along(strip.value_axis, limits, width);
  const AxisScale scale(Scale::linear, limits, left, left + width);
  out.open("g", {{"class", "colorbar"}});
  constexpr int cells = 64;
  for (int i = 0; i < cells; ++i) {
    const double cell = width / cells;
    // Half a pixel of overlap hides the seams of anti-aliasing.
    out.empty("rect", {{"x", left + i * cell},
                       {"y", top},
                       {"width", i + 1 < cells ? cell + 0.5 : cell},
                       {"height", 10.0},
                       {"fill", color_at(limits, (i + 0.5) / cells)}});
  }
  out.open("g", {{"text-anchor", "middle"}, {"fill", "#444"}});
  for (const Tick& t : marks.ticks) {
    const double px = scale.pixel(t.value);
    out.empty("line", {{"x1", px}, {"x2", px}, {"y1", top + 10}, {"y2", top + 14}, {"stroke", "#7a828c"}});
    out.element("text", {{"x", px}, {"y", top + 27}}, t.label);
  }
  out.element("text", {{"x", left + width / 2.0}, {"y", top + 43}, {"font-size", kTickFont + 1}},
              marks.title);
  out.close().close().newline();
}

// Labels of one row, in order of x, moved apart as little as keeps them from touching and inside the strip.
std::vector<double> spread(const std::vector<double>& wanted, const std::vector<double>& widths, double left,
                           double right) {
  constexpr double gap = 6.0;
  std::vector<double> at = wanted;
  double next = left;
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] = std::max(at[i], next + widths[i] / 2.0);
    next = at[i] + widths[i] / 2.0 + gap;
  }
  double limit = right;
  for (std::size_t i = at.size(); i-- > 0;) {
    at[i] = std::min(at[i], limit - widths[i] / 2.0);
    limit = at[i] - widths[i] / 2.0 - gap;
  }
  return at;
}

void draw_probe_row(Markup& out, const Strip& strip, const Layout& l, std::vector<std::size_t> row,
                    bool above) {
  std::stable_sort(row.begin(), row.end(),
                   [&](std::size_t a, std::size_t b) { return strip.probes[a].x < strip.probes[b].x; });
  std::vector<double> wanted, widths;
  for (const std::size_t i : row) {
    wanted.push_back(l.pixel(strip.probes[i].x, 0.0).x);
    widths.push_back(text_width(clean_utf8(strip.probes[i].label), kTickFont));
  }
  const std::vector<double> at = spread(wanted, widths, l.discs.left, l.discs.right());
  const double edge = above ? l.discs.top : l.discs.bottom();
  const double away = above ? -1.0 : 1.0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const Probe& probe = strip.probes[row[k]];
    const Point p = l.pixel(probe.x, probe.y);
    const auto leader = [&](std::string_view color, std::string_view stroke_width) {
      const std::string points = coordinate(p.x) + "," + coordinate(p.y) + " " + coordinate(p.x) + "," +
                                 coordinate(edge) + " " + coordinate(at[k]) + "," +
                                 coordinate(edge + away * 9.0);
      out.empty("polyline",
                {{"points", points}, {"fill", "none"}, {"stroke", color}, {"stroke-width", stroke_width}});
    };
    leader("#fff", "2.6");
    leader("#222", "1");
    out.empty("circle", {{"class", "probe"},
                         {"cx", p.x},
                         {"cy", p.y},
                         {"r", l.discs.width > 600 ? 4.2 : 3.2},
                         {"fill", "#fff"},
                         {"stroke", "#111"},
                         {"stroke-width", "1.8"}});
    out.element("text",
                {{"x", at[k]},
                 {"y", edge + (above ? -13.0 : 21.0)},
                 {"text-anchor", "middle"},
                 {"font-weight", "600"}},
                probe.label);
  }
  out.newline();
}

}  // namespace

std::size_t discs_drawn(const Strip& strip) {
  const std::size_t n = strip.x.size(), stride = std::max<std::size_t>(1, (n + kMaxDiscs - 1) / kMaxDiscs);
  return (n + stride - 1) / stride;
}

double strip_height(const Strip& strip, double width) {
  return layout_of(strip, {}, width).total_height;
}

void draw_strip(Markup& out, const Strip& strip, Point corner, double width) {
  const Layout l = layout_of(strip, corner, width);
  out.open("g", {{"class", "strip"}}).newline();
  if (!strip.title.empty())
    out.element("text",
                {{"class", "ptitle"},
                 {"x", corner.x + 10.0},
                 {"y", corner.y + 13.0},
                 {"font-weight", "600"},
                 {"font-size", kTickFont + 1}},
                strip.title);
  draw_discs(out, strip, l);
  std::vector<std::size_t> above, below;
  const double middle = (l.bounds.top + l.bounds.bottom) / 2.0;
  for (std::size_t i = 0; i < strip.probes.size(); ++i)
    (strip.probes[i].y >= middle ? above : below).push_back(i);
  draw_probe_row(out, strip, l, above, true);
  draw_probe_row(out, strip, l, below, false);
  draw_length_axis(out, strip, l);
  if (!strip.value.empty()) draw_color_bar(out, strip, l, corner.y + l.total_height - kColorBar + 6.0);
  out.close().newline();
}

}  // namespace ddem::reports
