#pragma once
// Draws one plot: axes, bands, reference lines, series and picks.

#include <cstddef>

#include "reports/figure.h"
#include "reports/geometry.h"
#include "reports/legend.h"
#include "reports/markup.h"

namespace ddem::reports {

/// Room that the tick labels of the y axis need left of a plot of this height.
double left_margin(const Plot& plot, double height);

/// Lines that a plot's title takes in that width; 0 without one.
std::size_t title_lines(const Plot& plot, double width);
constexpr double kTitleLine = 16.0;  ///< px; the first one has more

/// `frame` is the room for everything, titles of `lines` lines included; the plot area is inside it, right of `margin`. The
/// drawing is well inside the plot area: nothing of the data is ever drawn outside it.
void draw_plot(Markup& out, const Plot& plot, const StyleBook& styles, const Rect& frame, double margin, std::size_t lines);

/// Text in the drawing's dark grey with a white halo, to be legible on top of lines.
void draw_halo_text(Markup& out, Point at, std::string_view anchor, std::string_view text);

}  // namespace ddem::reports
