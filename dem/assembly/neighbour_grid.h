#pragma once
// Who may be near whom, in O(n log n) and for any spread of the centres: discs sorted by the grid cell
// that they lie in. Cells are at least as wide as the reach, so that all discs within reach of a disc lie in
// the 3 x 3 cells around its own. Empty cells take no memory: an outlier a kilometre away costs nothing.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/core/packing.h"

namespace ddem {

class NeighbourGrid {
 public:
  /// `reach`: largest distance (m, > 0) between the centres of neighbours. Every period must be longer than
  /// twice the reach, positions and radii finite: see check_packing_for_search in contacts.cc.
  NeighbourGrid(const Packing& packing, double reach)
      : x_axis_(packing.x, packing.period.x, reach), y_axis_(packing.y, packing.period.y, reach) {
    entries_.reserve(packing.size());
    for (std::size_t i = 0; i < packing.size(); ++i)
      entries_.push_back({key(x_axis_.cell(packing.x[i]), y_axis_.cell(packing.y[i])), static_cast<int>(i)});
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.key != b.key ? a.key < b.key : a.disc < b.disc;
    });
  }

  /// Calls visit(j) once for every disc j in the cells around the point, the disc at the point included.
  template <class Visit>
  void for_each_candidate(double x, double y, Visit&& visit) const {
    const Axis::Cells columns = x_axis_.around(x), rows = y_axis_.around(y);
    for (const std::int64_t row : std::span(rows.index).first(rows.count))
      for (const std::int64_t column : std::span(columns.index).first(columns.count)) {
        const std::uint64_t wanted = key(column, row);
        auto entry = std::lower_bound(entries_.begin(), entries_.end(), wanted,
                                      [](const Entry& e, std::uint64_t k) { return e.key < k; });
        for (; entry != entries_.end() && entry->key == wanted; ++entry) visit(entry->disc);
      }
  }

 private:
  struct Entry {
    std::uint64_t key;
    int disc;
  };

  class Axis {
   public:
    /// Up to three different cells: fewer at an open end, and where a period holds fewer than three.
    struct Cells {
      std::array<std::int64_t, 3> index;
      std::size_t count;
    };

    Axis(const std::vector<double>& centres, double period, double reach);
    std::int64_t cell(double centre) const;
    Cells around(double centre) const;

   private:
    double period_, origin_ = 0.0, cell_size_;
    std::int64_t cells_;
  };

  static std::uint64_t key(std::int64_t column, std::int64_t row) {
    return (static_cast<std::uint64_t>(row) << 32) | static_cast<std::uint64_t>(column);
  }

  Axis x_axis_, y_axis_;
  std::vector<Entry> entries_;
};

}  // namespace ddem
