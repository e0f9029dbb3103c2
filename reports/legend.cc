#include "reports/legend.h"

#include <fmt/format.h>

#include <stdexcept>

#include "reports/axis.h"
#include "reports/color.h"
#include "reports/number.h"
#include "reports/text.h"

namespace ddem::reports {

StyleBook::StyleBook(const Figure& figure) {
  for (const Panel& panel : figure.panels) {
    const Plot* plot = std::get_if<Plot>(&panel);
    if (plot == nullptr) continue;
    for (const Series& s : plot->series) {
      Style& style = entry(s.name, s.color);
      if (s.kind != SeriesKind::markers) {
        style.dash = s.dash;
        style.has_line = true;
      }
      if (s.kind != SeriesKind::line) style.has_marker = true;
    }
    for (const Band& b : plot->bands) entry(b.name, b.color).has_band = true;
  }
}

Style& StyleBook::entry(const std::string& name, Color color) {
  for (std::size_t i = 0; i < keys_.size(); ++i)
    if (keys_[i].name == name && keys_[i].asked == color) return styles_[i];
  keys_.push_back({name, color});
  const auto shape = static_cast<MarkerShape>(styles_.size() % 4);
  const Color chosen = color == Color::automatic ? automatic_color(automatic_++) : color;
  return styles_.emplace_back(Style{.name = name, .color = chosen, .marker = shape});
}

const Style& StyleBook::find(const std::string& name, Color color) const {
  for (std::size_t i = 0; i < keys_.size(); ++i)
    if (keys_[i].name == name && keys_[i].asked == color) return styles_[i];
  throw std::logic_error("series '" + name + "' is not of this figure");
}

std::string_view StyleBook::color_of(const Pick& pick) const {
  for (const Style& s : styles_)
    if (!pick.series.empty() && s.name == pick.series) return color_hex(s.color);
  return color_hex(Color::automatic);
}

std::string_view dash_array(Dash dash) {
  switch (dash) {
    case Dash::dashed:
      return "6 4";
    case Dash::dotted:
      return "1.5 3.5";
    case Dash::solid:
      break;
  }
  return "none";
}

void draw_marker(Markup& out, MarkerShape shape, Point at, double size) {
  const auto c = [](double v) { return coordinate(v); };
  // Shapes of about equal area.
  switch (shape) {
    case MarkerShape::circle:
      out.empty("circle", {{"cx", at.x}, {"cy", at.y}, {"r", size}});
      return;
    case MarkerShape::square: {
      const double a = 0.89 * size;
      out.empty("rect", {{"x", at.x - a}, {"y", at.y - a}, {"width", 2 * a}, {"height", 2 * a}});
      return;
    }
    case MarkerShape::triangle: {
      const double a = 1.3 * size;
      out.empty("path",
                {{"d", fmt::format("M{} {}l{} {}h{}z", c(at.x), c(at.y - a), c(a), c(1.75 * a), c(-2 * a))}});
      return;
    }
    case MarkerShape::diamond: {
      const double a = 1.25 * size;
      out.empty("path", {{"d", fmt::format("M{} {}l{} {} {} {} {} {}z", c(at.x), c(at.y - a), c(a), c(a),
                                           c(-a), c(a), c(-a), c(-a))}});
      return;
    }
  }
}

namespace {

constexpr double kSwatch = 30.0, kRow = 20.0;

void draw_entry(Markup& out, const Style& style, Point at, std::string_view text) {
  const std::string_view color = color_hex(style.color);
  const double middle = at.y + kRow / 2.0;
  if (style.has_band)
    out.empty("rect", {{"x", at.x},
                       {"y", middle - 6},
                       {"width", kSwatch - 6},
                       {"height", 12.0},
                       {"fill", color},
                       {"fill-opacity", "0.2"}});
  if (style.has_line)
    out.empty("line", {{"x1", at.x},
                       {"y1", middle},
                       {"x2", at.x + kSwatch - 6},
                       {"y2", middle},
                       {"stroke", color},
                       {"stroke-width", "2"},
                       {"stroke-dasharray", dash_array(style.dash)}});
  if (style.has_marker) {
    out.open("g", {{"fill", color}, {"stroke", "#fff"}});
    draw_marker(out, style.marker, {at.x + (kSwatch - 6) / 2.0, middle}, 4.5);
    out.close();
  }
  out.element("text", {{"x", at.x + kSwatch}, {"y", middle + 4.5}}, text);
}

}  // namespace

double draw_legend(Markup* out, const StyleBook& styles, Point corner, double width) {
  Point at = corner;
  bool any = false;
  if (out != nullptr) out->open("g", {{"class", "legend"}, {"font-size", kTickFont + 1}});
  for (const Style& style : styles.styles()) {
    if (style.name.empty()) continue;
    const std::string name = clean_utf8(style.name);
    const double needed = kSwatch + text_width(name, kTickFont + 1) + 18.0;
    if (any && at.x + needed - 18.0 > corner.x + width) at = {corner.x, at.y + kRow};
    if (out != nullptr) draw_entry(*out, style, at, name);
    at.x += needed;
    any = true;
  }
  if (out != nullptr) out->close().newline();
  return any ? at.y + kRow - corner.y + 10.0 : 0.0;
}

}  // namespace ddem::reports
