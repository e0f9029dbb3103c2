#pragma once
// What the page's script draws a figure from: the figure as JSON, with the axes, styles and colours that the
// SVG has.

#include <string>

#include "reports/figure.h"

namespace ddem::reports {

/// {"figure": ..., "arrays": [...]}, neither < nor & in it. Series and bands of more than max_points points
/// are thinned, extremes kept. An array is numbers of six digits or null, or evenly spaced {from, step, count}, or, of many
/// numbers, {packed: text} as packed_numbers() makes it. A strip's fields over time are base64 of one byte a disc and frame: 0 to 254 from the
/// lower to the upper limit, 255 without value.
std::string live_figure(const Figure& figure, std::size_t max_points);

/// The colour maps, as lists of colours.
std::string live_palette();

}  // namespace ddem::reports
