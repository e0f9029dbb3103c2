#include "dem/simulation/front.h"

#include <algorithm>
#include <cstdint>

namespace ddem {
namespace {

int slice_of(int place) { return place / kLanes; }

}  // namespace

std::vector<int> motion_fronts(const SlicedBonds& bonds, const std::vector<char>& moving) {
  std::vector<int> reached;
  for (int p = 0; p < static_cast<int>(moving.size()); ++p) {
    if (moving[p]) reached.push_back(p);
  }
  int front = reached.empty() ? 0 : slice_of(reached.back()) + 1;
  if (front == bonds.slices) return {front};

  std::vector<int> fronts, next;
  std::vector<char> known = moving;
  while (front < bonds.slices) {
    next.clear();
    for (const int p : reached) {
      for (int row = bonds.row_begin[slice_of(p)]; row < bonds.row_begin[slice_of(p) + 1]; ++row) {
        const std::int32_t other = bonds.neighbour[static_cast<std::size_t>(row) * kLanes + static_cast<std::size_t>(p % kLanes)];
        if (known[other]) continue;
        known[other] = 1;
        next.push_back(other);
        front = std::max(front, slice_of(other) + 1);
      }
    }
    fronts.push_back(front);
    if (next.empty()) break;  // the rest hangs on nothing that moves
    std::swap(reached, next);
  }
  return fronts;
}

}  // namespace ddem
