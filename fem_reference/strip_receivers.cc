#include "fem_reference/strip_receivers.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem {
namespace {

// Nodes of one direction: `elements` of the degree of `rule`, the last node being the first if periodic.
struct Line {
  int elements;
  bool periodic;
  const GaussLobatto& rule;

  int degree() const { return static_cast<int>(rule.points.size()) - 1; }
  std::uint32_t node(int k) const {
    const int count = elements * degree();
    return static_cast<std::uint32_t>(periodic ? ((k % count) + count) % count : k);
  }
  double place(int k) const {
    const int element = k >= 0 ? k / degree() : -((degree() - 1 - k) / degree());
    return element + rule.points[static_cast<std::size_t>(k - element * degree())];
  }
};

// Lagrange weights at x of the element's nodes and, inside, of half as many on either side of it. (All of the
// neighbours' nodes are no more accurate, and amplify noise of the nodes more: 10 times instead of 7 at p = 8.)
NodeWeights interpolation(const Line& line, double x) {
  const double nearest = std::round(x);  // a receiver on a node sees this node alone
  if (std::abs(x - nearest) < 1e-9) x = nearest;
  const int p = line.degree(), element = std::min(static_cast<int>(std::floor(x)), line.elements - 1);
  const bool inside = line.periodic ? line.elements > 2 : element > 0 && element + 1 < line.elements;
  const int beyond = inside ? (p+1)/2 : 0;
  std::vector<double> places;
  const int first = element * p - beyond, last = (element + 1) * p + beyond;
  for (int k = first; k <= last; ++k) places.push_back(line.place(k));
  const std::vector<double> values = lagrange_values(places, x);
  NodeWeights weights;
  for (int k = first; k <= last; ++k) {
    const double value = values[static_cast<std::size_t>(k - first)];
    if (value != 0.0) weights.emplace_back(line.node(k), value);
  }
  return weights;
}

NodeWeights product(const NodeWeights& columns, const NodeWeights& rows, std::uint32_t rows_in_column) {
  std::map<std::uint32_t, double> sum;
  for (const auto& [column, column_weight] : columns) {
    for (const auto& [row, row_weight] : rows) sum[column * rows_in_column + row] += column_weight * row_weight;
  }
  return {sum.begin(), sum.end()};
}

std::uint32_t rows_of(const StripGrid& grid) {
  return grid.ny * static_cast<unsigned>(grid.degree) + (grid.periodic ? 0 : 1);
}

}  // namespace

NodeWeights at_point(const StripGrid& grid, double x, double y) {
  const GaussLobatto rule = gauss_lobatto(grid.degree);
  const Line along{static_cast<int>(grid.nx), false, rule}, across{static_cast<int>(grid.ny), grid.periodic, rule};
  return product(interpolation(along, x), interpolation(across, y), rows_of(grid));
}

NodeWeights at_section(const StripGrid& grid, double x) {
  const GaussLobatto rule = gauss_lobatto(grid.degree);
  const Line along{static_cast<int>(grid.nx), false, rule}, across{static_cast<int>(grid.ny), grid.periodic, rule};
  NodeWeights rows;
  for (int element = 0; element < across.elements; ++element) {
    for (int k = 0; k <= grid.degree; ++k) {
      rows.emplace_back(across.node(element * grid.degree + k), rule.weights[static_cast<std::size_t>(k)] / grid.ny);
    }
  }
  return product(interpolation(along, x), rows, rows_of(grid));
}

}  // namespace ddem::fem
