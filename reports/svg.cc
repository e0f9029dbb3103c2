#include "reports/svg.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/figure_data.h"
#include "reports/legend.h"
#include "reports/number.h"
#include "reports/plot.h"
#include "reports/strip.h"
#include "reports/text.h"

namespace ddem::reports {
namespace {

constexpr double kPadding = 8.0, kGap = 18.0;
constexpr std::string_view kFonts =
    "system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', Arial, sans-serif";

struct Grid {
  double width = 0.0;
  std::size_t columns = 1;
  double cell_width() const {
    return (width - kGap * static_cast<double>(columns - 1)) / static_cast<double>(columns);
  }
  // A single plot is wide; small multiples are nearer to square.
  double plot_height() const {
    return std::round(columns == 1 ? std::clamp(0.52 * width, 270.0, 420.0)
                                   : std::max(210.0, 0.72 * cell_width()));
  }
};

std::size_t column_count(const Figure& figure, bool side_by_side) {
  std::size_t plots = 0;
  for (const Panel& p : figure.panels) plots += std::holds_alternative<Plot>(p) ? 1 : 0;
  if (!side_by_side || plots < 2) return 1;
  return std::clamp<std::size_t>(figure.columns == 0 ? 2 : figure.columns, 1,
                                 std::min<std::size_t>(plots, 4));
}

// Plots fill rows from the left; a strip has a row of its own. Returns the height used.
double draw_panels(Markup& out, const Figure& figure, const StyleBook& styles, Point corner,
                   const Grid& grid) {
  double margin = 0.0;
  for (const Panel& p : figure.panels)
    if (const Plot* plot = std::get_if<Plot>(&p))
      margin = std::max(margin, left_margin(*plot, grid.plot_height()));
  margin = std::min(margin, 0.4 * grid.cell_width());
  std::size_t lines = 1;  // of titles: as many for all, so that axes are level
  for (const Panel& p : figure.panels)
    if (const Plot* plot = std::get_if<Plot>(&p)) lines = std::max(lines, title_lines(*plot, grid.cell_width() - margin));
  const double plot_height = grid.plot_height() + kTitleLine * static_cast<double>(lines - 1);

  double y = corner.y;
  std::size_t column = 0;
  const auto end_row = [&] {
    if (column != 0) y += plot_height + kGap;
    column = 0;
  };
  for (const Panel& p : figure.panels) {
    if (const Plot* plot = std::get_if<Plot>(&p)) {
      const double x = corner.x + static_cast<double>(column) * (grid.cell_width() + kGap);
      draw_plot(out, *plot, styles, {x, y, grid.cell_width(), plot_height}, margin, lines);
      if (++column == grid.columns) end_row();
    } else {
      end_row();
      const Strip& strip = std::get<Strip>(p);
      draw_strip(out, strip, {corner.x, y}, grid.width);
      y += strip_height(strip, grid.width) + kGap;
    }
  }
  end_row();
  return std::max(0.0, y - corner.y - kGap);
}

std::string description(const Figure& figure) {
  std::string text = figure.caption;
  for (const std::string& note : notes_of(figure)) text += (text.empty() ? "" : " ") + note;
  return text;
}

struct Frame {
  double width = 860.0;
  bool side_by_side = true;
  bool standalone = true;
  std::string id_prefix = {};
};

double draw_title(Markup& out, const Figure& figure, double width) {
  constexpr double font = 16.0;
  double y = kPadding;
  for (const std::string& line : wrap_text(clean_utf8(figure.title), width - 2 * kPadding, font)) {
    out.element("text", {{"x", kPadding}, {"y", y + font}, {"font-size", font}, {"font-weight", "600"}},
                line);
    y += font + 6.0;
  }
  return y > kPadding ? y + 6.0 : y;
}

std::string render(const Figure& figure, const Frame& frame) {
  require_valid(figure);
  const StyleBook styles(figure);
  const double inner = frame.width - 2 * kPadding;
  Markup body;
  double y = frame.standalone ? draw_title(body, figure, frame.width) : kPadding;
  y += draw_legend(&body, styles, {kPadding, y}, inner);
  const Grid grid{inner, column_count(figure, frame.side_by_side)};
  y += draw_panels(body, figure, styles, {kPadding, y}, grid) + kPadding;

  Markup out;
  const std::string title_id = frame.id_prefix + "-title", desc_id = frame.id_prefix + "-desc";
  const std::string size = coordinate(frame.width) + " " + coordinate(y);
  out.open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                   {"viewBox", "0 0 " + size},
                   {"width", frame.width},
                   {"height", y},
                   {"role", "img"},
                   {"aria-labelledby", title_id + " " + desc_id},
                   {"font-family", kFonts},
                   {"font-size", "12"},
                   {"fill", "#222"}});
  out.newline();
  out.element("title", {{"id", title_id}}, figure.title.empty() ? "Figure" : figure.title);
  out.element("desc", {{"id", desc_id}}, description(figure)).newline();
  if (frame.standalone)
    out.empty("rect", {{"width", frame.width}, {"height", y}, {"fill", "#fff"}}).newline();
  out.raw(body.take()).close().newline();
  return out.take();
}

}  // namespace

std::string render_svg(const Figure& figure) {
  const std::string declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  return declaration + render(figure, {.id_prefix = slug(figure.id)});
}

std::string render_embedded_svg(const Figure& figure, const EmbeddedSvg& options) {
  return render(figure, {.width = options.width,
                         .side_by_side = options.side_by_side,
                         .standalone = false,
                         .id_prefix = options.id_prefix});
}

}  // namespace ddem::reports
