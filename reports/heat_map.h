#pragma once
// Draws a heat map behind a plot's series, and its colour bar right of the plot.

#include <string>
#include <vector>

#include "reports/axis.h"
#include "reports/figure.h"
#include "reports/geometry.h"
#include "reports/markup.h"

namespace ddem::reports {

/// Room for the colour bar right of the plot area, px.
inline constexpr double kColorBarRoom = 62.0;

/// From the outer edge of the first to that of the last cell.
Limits map_extent(const std::vector<double>& centres, Scale scale);

/// Cells of one of 41 colours share a path, in rows of equal neighbours, which keeps spectra small.
void draw_cells(Markup& out, const HeatMap& map, const Plot& plot, const AxisScale& x, const AxisScale& y, const Rect& area);

struct ColorTick {
  double fraction = 0.0;  ///< 0 at the lower, 1 at the upper end of the colour bar
  std::string label = {};
};
/// Of a colour bar `height` pixels high: decades where the scale has them.
std::vector<ColorTick> color_ticks(const HeatMap& map, double height);
std::string color_title(const HeatMap& map);

void draw_color_bar(Markup& out, const HeatMap& map, const Rect& area);

}  // namespace ddem::reports
