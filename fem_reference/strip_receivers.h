#pragma once
// Receivers anywhere in a strip of nx * ny equal rectangles, from nodal values.
//
// Nodes of spectral elements are more accurate than the polynomial of one element is between them: the error of the
// nodes falls as h^(2p), that of the interpolation as h^(p+1). A receiver therefore interpolates over its element and
// the next nodes of its neighbours. An element at an end of the strip has only one neighbour, and keeps to itself.

#include <cstdint>
#include <utility>
#include <vector>

namespace ddem::fem {

/// A linear functional of nodal values: sum of weight * value(node).
using NodeWeights = std::vector<std::pair<std::uint32_t, double>>;

/// Nodes are numbered up the columns, from the left; between periodic edges the top row is the bottom row.
struct StripGrid {
  unsigned nx = 0, ny = 0;
  int degree = 1;
  bool periodic = false;
};

/// The value at (x, y) in units of elements, 0 <= x <= nx, 0 <= y <= ny.
NodeWeights at_point(const StripGrid& grid, double x, double y);

/// The average over the height at x, exact for the elements' polynomials.
NodeWeights at_section(const StripGrid& grid, double x);

}  // namespace ddem::fem
