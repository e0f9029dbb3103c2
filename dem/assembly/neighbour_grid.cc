#include "dem/assembly/neighbour_grid.h"

#include <cmath>

namespace ddem {

NeighbourGrid::Axis::Axis(const std::vector<double>& centres, double period, double reach) : period_(period) {
  // A little wider than the reach: rounding of a cell index must not push a pair two cells apart.
  const double smallest_cell = reach * (1.0 + 1e-9);
  constexpr double most_cells = 1 << 30;  // indices fit half a 64-bit key
  double extent = period;
  if (period <= 0.0) {
    const auto [low, high] = std::minmax_element(centres.begin(), centres.end());
    if (low != centres.end()) {
      origin_ = *low;
      extent = *high - *low;
    }
  }
  cells_ = static_cast<std::int64_t>(std::clamp(std::floor(extent / smallest_cell), 1.0, most_cells));
  cell_size_ = std::max(smallest_cell, extent / static_cast<double>(cells_));
}

std::int64_t NeighbourGrid::Axis::cell(double centre) const {
  double from_origin = centre - origin_;
  if (period_ > 0.0) from_origin -= period_ * std::floor(from_origin / period_);
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(from_origin / cell_size_), 0, cells_ - 1);
}

NeighbourGrid::Axis::Cells NeighbourGrid::Axis::around(double centre) const {
  const std::int64_t own = cell(centre);
  Cells result{{own, own, own}, 1};
  const auto add = [&](std::int64_t neighbour) { result.index[result.count++] = neighbour; };
  if (period_ > 0.0) {
    if (cells_ >= 2) add((own + 1) % cells_);
    if (cells_ >= 3) add((own + cells_ - 1) % cells_);
  } else {
    if (own > 0) add(own - 1);
    if (own + 1 < cells_) add(own + 1);
  }
  return result;
}

}  // namespace ddem
