#include "reports/plot.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reports/axis.h"
#include "reports/color.h"
#include "reports/decimate.h"
#include "reports/heat_map.h"
#include "reports/label_placer.h"
#include "reports/path.h"
#include "reports/plot_limits.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

constexpr double kTitleRow = 20.0, kAxisTitleRow = 20.0, kTickRow = 20.0, kRight = 14.0;
constexpr double kMarkerSize = 4.5;

double top_margin(const Plot& plot) {
  return (plot.title.empty() ? 0.0 : kTitleRow) +
         (plot.y.label.empty() && plot.y.unit.empty() ? 8.0 : kAxisTitleRow);
}

double bottom_margin() {
  return kTickRow + kAxisTitleRow;
}

std::vector<std::string> lines_of_title(const Plot& plot, double width) {
  constexpr double bold = 1.12;  // is wider
  return wrap_text(clean_utf8(plot.title), width, bold * (kTickFont + 1));
}

int vertical_tick_count(double height) {
  return std::max(2, static_cast<int>(height / 38.0));
}

Rect snapped(Rect r) {
  const double left = std::round(r.left), top = std::round(r.top);
  return {left, top, std::max(20.0, std::floor(r.right()) - left),
          std::max(20.0, std::floor(r.bottom()) - top)};
}

class PlotPainter {
 public:
  PlotPainter(Markup& out, const Plot& plot, const StyleBook& styles, const Rect& area)
      : out_(out),
        plot_(plot),
        styles_(styles),
        area_(area),
        x_(plot.x.scale, x_limits(plot), area.left, area.right()),
        y_(plot.y.scale, y_limits(plot), area.bottom(), area.top) {}

  void draw() {
    draw_axes();
    for (const Band& b : plot_.bands) draw_band(b);
    for (const ReferenceLine& r : plot_.references) draw_reference(r);
    for (const Series& s : plot_.series)
      if (s.kind != SeriesKind::markers) draw_line(s);
    for (const Series& s : plot_.series) draw_errors(s);
    for (const Series& s : plot_.series)
      if (s.kind != SeriesKind::line) draw_markers(s);
    for (const Pick& p : plot_.picks) draw_pick(p);
    label_references();
    label_picks();
  }

 private:
  using Attributes = Markup::Attributes;

  void draw_axes();
  void draw_band(const Band& band);
  void draw_reference(const ReferenceLine& reference);
  void draw_line(const Series& series);
  void draw_errors(const Series& series);
  void draw_markers(const Series& series);
  void draw_pick(const Pick& pick);
  void label_references();
  void label_picks();

  bool visible(const ReferenceLine& r) const {
    const AxisScale& axis = r.direction == Direction::horizontal ? y_ : x_;
    return axis.drawable(r.value) && r.value >= axis.limits().lower && r.value <= axis.limits().upper;
  }
  bool visible(const Pick& p) const {
    return x_.drawable(p.x) && p.x >= x_.limits().lower && p.x <= x_.limits().upper;
  }
  /// Runs of consecutive drawable points; what is between them is a gap.
  std::vector<Polyline> runs(const std::vector<double>& x, const std::vector<double>& y) const;
  void stroke(Point a, Point b, Attributes attributes);

  Markup& out_;
  const Plot& plot_;
  const StyleBook& styles_;
  Rect area_;
  AxisScale x_, y_;
  LabelPlacer labels_;
};

std::vector<Polyline> PlotPainter::runs(const std::vector<double>& x, const std::vector<double>& y) const {
  std::vector<Polyline> result;
  bool connected = false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool drawn = x_.drawable(x[i]) && y_.drawable(y[i]);
    if (drawn && !connected) result.emplace_back();
    if (drawn) result.back().push_back({x_.pixel(x[i]), y_.pixel(y[i])});
    connected = drawn;
  }
  return result;
}

void PlotPainter::stroke(Point a, Point b, Attributes attributes) {
  if (const auto inside = clip_segment({a, b}, area_)) {
    out_.open("g", attributes);
    out_.empty("path", {{"d", path_data({inside->first, inside->second})}});
    out_.close();
  }
}

void PlotPainter::draw_axes() {
  const AxisMarks x = axis_marks_along(plot_.x, x_.limits(), area_.width);
  const AxisMarks y = axis_marks(plot_.y, y_.limits(), vertical_tick_count(area_.height));
  out_.empty("rect", {{"class", "area"},
                      {"x", area_.left},
                      {"y", area_.top},
                      {"width", area_.width},
                      {"height", area_.height},
                      {"fill", "#fafbfc"}});
  if (plot_.map) draw_cells(out_, *plot_.map, plot_, x_, y_, area_);
  out_.open("g", {{"class", "grid"}, {"stroke", plot_.map ? "none" : "#e3e6ea"}});
  for (const Tick& t : x.ticks) {
    const double px = x_.pixel(t.value);
    out_.empty("line", {{"x1", px}, {"x2", px}, {"y1", area_.top}, {"y2", area_.bottom()}});
  }
  for (const Tick& t : y.ticks) {
    const double py = y_.pixel(t.value);
    out_.empty("line", {{"x1", area_.left}, {"x2", area_.right()}, {"y1", py}, {"y2", py}});
  }
  out_.close();
  out_.empty(
      "path",
      {{"d",
        path_data({{area_.left, area_.top}, {area_.left, area_.bottom()}, {area_.right(), area_.bottom()}})},
       {"fill", "none"},
       {"stroke", "#7a828c"}});
  out_.open("g", {{"class", "xticks"}, {"text-anchor", "middle"}, {"fill", "#444"}});
  for (const Tick& t : x.ticks)
    out_.element("text", {{"x", x_.pixel(t.value)}, {"y", area_.bottom() + 17}}, t.label);
  out_.close().open("g", {{"class", "yticks"}, {"text-anchor", "end"}, {"fill", "#444"}});
  for (const Tick& t : y.ticks)
    out_.element("text", {{"x", area_.left - 7}, {"y", y_.pixel(t.value) + 4.2}}, t.label);
  out_.close();
  out_.element("text",
               {{"class", "xtitle"},
                {"x", area_.left + area_.width / 2.0},
                {"y", area_.bottom() + 36},
                {"text-anchor", "middle"},
                {"font-size", kTickFont + 1}},
               x.title);
  out_.element("text",
               {{"class", "ytitle"}, {"x", area_.left}, {"y", area_.top - 8}, {"font-size", kTickFont + 1}},
               y.title);
  out_.newline();
}

void PlotPainter::draw_band(const Band& band) {
  // Lower and upper edge, thinned separately; a point that lacks either ends the band, and a new one begins.
  const std::string_view color = color_hex(styles_.of(band).color);
  std::size_t i = 0;
  const auto drawn = [&](std::size_t k) {
    return x_.drawable(band.x[k]) && y_.drawable(band.lower[k]) && y_.drawable(band.upper[k]);
  };
  while (i < band.x.size()) {
    Polyline lower, upper;
    for (; i < band.x.size() && drawn(i); ++i) {
      lower.push_back({x_.pixel(band.x[i]), y_.pixel(band.lower[i])});
      upper.push_back({x_.pixel(band.x[i]), y_.pixel(band.upper[i])});
    }
    for (; i < band.x.size() && !drawn(i); ++i) {
    }
    Polyline outline = decimate(lower, 1.0);
    const Polyline back = decimate(upper, 1.0);
    outline.insert(outline.end(), back.rbegin(), back.rend());
    outline = clip_polygon(std::move(outline), area_);
    if (outline.empty()) continue;
    out_.empty(
        "path",
        {{"class", "band"}, {"d", path_data(outline, true)}, {"fill", color}, {"fill-opacity", "0.2"}});
    out_.newline();
  }
}

void PlotPainter::draw_reference(const ReferenceLine& reference) {
  if (!visible(reference)) return;
  const bool horizontal = reference.direction == Direction::horizontal;
  const double at = (horizontal ? y_ : x_).pixel(reference.value);
  const Point a = horizontal ? Point{area_.left, at} : Point{at, area_.bottom()};
  const Point b = horizontal ? Point{area_.right(), at} : Point{at, area_.top};
  stroke(a, b,
         {{"class", "reference"},
          {"stroke", "#555"},
          {"stroke-width", "1.3"},
          {"stroke-dasharray", dash_array(reference.dash)}});
  labels_.add_obstacle({a, b});
}

void PlotPainter::draw_line(const Series& series) {
  const std::string_view color = color_hex(styles_.of(series).color);
  std::string data;
  Polyline isolated;
  for (const Polyline& run : runs(series.x, series.y))
    for (const Polyline& piece : clip_polyline(decimate(run, 1.0), area_)) {
      labels_.add_obstacle(piece);
      if (run.size() == 1)
        isolated.push_back(piece.front());
      else
        data += path_data(piece);
    }
  if (!data.empty())
    out_.empty("path", {{"class", "line"},
                        {"d", data},
                        {"fill", "none"},
                        {"stroke", color},
                        {"stroke-width", "1.8"},
                        {"stroke-linejoin", "round"},
                        {"stroke-dasharray", dash_array(series.dash)}});
  // A point between two gaps has no line to show it.
  if (series.kind == SeriesKind::line)
    for (const Point& p : isolated)
      out_.empty("circle", {{"class", "isolated"}, {"cx", p.x}, {"cy", p.y}, {"r", 2.0}, {"fill", color}});
  out_.newline();
}

void PlotPainter::draw_errors(const Series& series) {
  std::string data;
  for (std::size_t i = 0; i < series.error.size(); ++i) {
    const double y = series.y[i], e = series.error[i];
    if (!x_.drawable(series.x[i]) || !y_.drawable(y) || !std::isfinite(e) || !(e > 0.0)) continue;
    const double px = x_.pixel(series.x[i]);
    // On a logarithmic axis a bar that reaches zero goes down to the edge.
    const double low = y_.drawable(y - e) ? y_.pixel(y - e) : area_.bottom();
    const double high = y_.drawable(y + e) ? y_.pixel(y + e) : area_.top;
    constexpr double cap = 3.5;
    for (const Segment& s : {Segment{{px, low}, {px, high}}, Segment{{px - cap, low}, {px + cap, low}},
                             Segment{{px - cap, high}, {px + cap, high}}})
      if (const auto inside = clip_segment(s, area_)) {
        data += path_data({inside->first, inside->second});
        labels_.add_obstacle({inside->first, inside->second});
      }
  }
  if (data.empty()) return;
  out_.empty("path", {{"class", "error"},
                      {"d", data},
                      {"fill", "none"},
                      {"stroke-width", "1.3"},
                      {"stroke", color_hex(styles_.of(series).color)}});
  out_.newline();
}

void PlotPainter::draw_markers(const Series& series) {
  // Of very many markers those that hide behind another one are left out.
  const bool many = series.x.size() > 1000;
  std::set<std::pair<long, long>> occupied;
  const Style& style = styles_.of(series);
  out_.open(
      "g",
      {{"class", "markers"}, {"fill", color_hex(style.color)}, {"stroke", "#fff"}, {"stroke-width", "0.8"}});
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!x_.drawable(series.x[i]) || !y_.drawable(series.y[i])) continue;
    const Point p{x_.pixel(series.x[i]), y_.pixel(series.y[i])};
    if (!area_.contains(p)) continue;
    if (many && !occupied.emplace(std::lround(p.x / 4.0), std::lround(p.y / 4.0)).second) continue;
    draw_marker(out_, style.marker, p, kMarkerSize);
    labels_.add_obstacle({{p.x - kMarkerSize, p.y}, {p.x + kMarkerSize, p.y}});
  }
  out_.close().newline();
}

void PlotPainter::draw_pick(const Pick& pick) {
  if (!visible(pick)) return;
  const std::string_view color = styles_.color_of(pick);
  const double px = x_.pixel(pick.x);
  stroke({px, area_.top}, {px, area_.bottom()},
         {{"class", "pick"}, {"stroke", color}, {"stroke-width", "1.1"}, {"stroke-dasharray", "2 3"}});
  labels_.add_obstacle({{px, area_.top}, {px, area_.bottom()}});
  if (!pick.y || !y_.drawable(*pick.y)) return;
  const Point ring{px, y_.pixel(*pick.y)};
  if (!area_.contains(ring)) return;
  out_.empty("circle", {{"class", "ring"},
                        {"cx", ring.x},
                        {"cy", ring.y},
                        {"r", 4.5},
                        {"fill", "#fff"},
                        {"fill-opacity", "0.6"},
                        {"stroke", color},
                        {"stroke-width", "1.8"}});
  labels_.reserve({ring.x - 5, ring.y - 5, 10, 10});
}

// Candidates are boxes beside the line, from near one end of it to the other.
void PlotPainter::label_references() {
  constexpr double h = 15.0, pad = 5.0;
  for (const ReferenceLine& r : plot_.references) {
    const std::string text = clean_utf8(r.label);
    if (!visible(r) || text.empty()) continue;
    const double w = std::min(text_width(text, kTickFont), area_.width - 2 * pad);
    const bool horizontal = r.direction == Direction::horizontal;
    const double at = (horizontal ? y_ : x_).pixel(r.value);
    std::vector<Rect> candidates;
    for (const double along : {1.0, 0.75, 0.5, 0.25, 0.0})
      for (const double side : {-1.0, 0.0}) {
        const double free_x = area_.width - w - 2 * pad, free_y = area_.height - h - 2 * pad;
        const Rect box = horizontal ? Rect{area_.left + pad + along * free_x, at + side * (h + 4) + 2, w, h}
                                    : Rect{at + pad + (side < 0 ? -(w + 2 * pad) : 0.0),
                                           area_.top + pad + (1 - along) * free_y, w, h};
        if (area_.contains({box.left, box.top}) && area_.contains({box.right(), box.bottom()}))
          candidates.push_back(box);
      }
    if (candidates.empty()) continue;
    const Rect box = labels_.place(candidates);
    draw_halo_text(out_, {box.left, box.bottom() - 4}, "start", text);
  }
}

void PlotPainter::label_picks() {
  constexpr double h = 15.0, pad = 9.0;  // clear of the ring
  for (const Pick& p : plot_.picks) {
    const std::string text = clean_utf8(p.label);
    if (!visible(p) || text.empty()) continue;
    const double w = text_width(text, kTickFont), px = x_.pixel(p.x);
    std::vector<Rect> candidates;
    for (double top = area_.top + 2; top + h <= area_.bottom(); top += h)
      for (const double left : {px + pad, px - pad - w})
        if (left >= area_.left && left + w <= area_.right()) candidates.push_back({left, top, w, h});
    if (candidates.empty()) continue;
    const Rect box = labels_.place(candidates);
    draw_halo_text(out_, {box.left, box.bottom() - 4}, "start", text);
  }
}

}  // namespace

double left_margin(const Plot& plot, double height) {
  const double area_height = std::max(20.0, height - top_margin(plot) - bottom_margin());
  return axis_marks(plot.y, y_limits(plot), vertical_tick_count(area_height)).label_width + 12.0;
}

std::size_t title_lines(const Plot& plot, double width) {
  return lines_of_title(plot, width).size();
}

void draw_plot(Markup& out, const Plot& plot, const StyleBook& styles, const Rect& frame, double margin, std::size_t lines) {
  const double top = top_margin(plot) + kTitleLine * static_cast<double>(std::max<std::size_t>(lines, 1) - 1);
  const double right = plot.map ? kColorBarRoom : kRight;
  const Rect area = snapped({frame.left + margin, frame.top + top, frame.width - margin - right,
                             frame.height - top - bottom_margin()});
  out.open("g", {{"class", "plot"}}).newline();
  double y = frame.top + 13;
  for (const std::string& line : lines_of_title(plot, frame.width - margin)) {
    out.element("text",
                {{"class", "ptitle"}, {"x", frame.left + margin}, {"y", y}, {"font-weight", "600"}, {"font-size", kTickFont + 1}}, line);
    y += kTitleLine;
  }
  PlotPainter(out, plot, styles, area).draw();
  if (plot.map) draw_color_bar(out, *plot.map, area);
  out.close().newline();
}

void draw_halo_text(Markup& out, Point at, std::string_view anchor, std::string_view text) {
  out.element("text",
              {{"class", "label"},
               {"x", at.x},
               {"y", at.y},
               {"text-anchor", anchor},
               {"stroke", "#fff"},
               {"stroke-width", "3.5"},
               {"stroke-linejoin", "round"},
               {"paint-order", "stroke"}},
              text);
}

}  // namespace ddem::reports
