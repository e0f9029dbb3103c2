#pragma once
// Draws a heat map behind a plot's series, and its colour bar right of the plot.

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

void draw_color_bar(Markup& out, const HeatMap& map, const Rect& area);

}  // namespace ddem::reports
