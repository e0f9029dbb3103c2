#include "meshes/packings/tiling.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

namespace ddem::packings {
namespace {

constexpr std::int64_t kLargestCell = 4000, kSmallestCell = 1000;
constexpr double kSlenderest = 4.0;
constexpr std::int64_t kMostTiles = 100000000 / kSmallestCell;
constexpr int kFarthest = 2000;  // numbers of discs looked at on either side: a multiple of 1000 is among them

/// Cells of nx x ny = tiles nearest to squares; empty where they are slender.
std::optional<Tiling> squarest(std::int64_t tiles, double length, double width) {
  std::optional<Tiling> best;
  double least = kSlenderest;
  const auto consider = [&](std::int64_t nx, std::int64_t ny) {
    const double ratio = (length / static_cast<double>(nx)) / (width / static_cast<double>(ny));
    if (std::max(ratio, 1.0 / ratio) > least) return;
    least = std::max(ratio, 1.0 / ratio);
    best = Tiling{static_cast<int>(nx), static_cast<int>(ny), 0};
  };
  for (std::int64_t n = 1; n <= tiles / n; ++n) {
    if (tiles % n != 0) continue;
    consider(n, tiles / n);
    consider(tiles / n, n);
  }
  return best;
}

std::optional<Tiling> tiling_if_any(std::int64_t discs, double length, double width) {
  // From the largest cell that divides the discs downwards.
  for (std::int64_t cell = std::min(kLargestCell, discs); cell >= kSmallestCell; --cell) {
    if (discs % cell != 0) continue;
    if (auto tiling = squarest(discs / cell, length, width)) {
      tiling->discs = static_cast<int>(cell);
      return tiling;
    }
  }
  return std::nullopt;
}

}  // namespace

Tiling tiling_of(std::int64_t discs, double length, double width) {
  if (discs <= kLargestJammed) return {1, 1, static_cast<int>(discs)};
  if (discs / kLargestCell > kMostTiles)
    throw std::invalid_argument(fmt::format("{} discs are more than a sample can have", discs));
  if (const auto tiling = tiling_if_any(discs, length, width)) return *tiling;
  std::string remedy = fmt::format("take at most {} discs, or another shape", kLargestJammed);
  for (int away = 1; away <= kFarthest; ++away)
    for (const std::int64_t other : {discs - away, discs + away})
      if (const auto tiling = tiling_if_any(other, length, width))
        throw std::invalid_argument(fmt::format(
            "more than {} discs are put together from equal cells of {} to {} discs, which {} discs in {:.6g} m x {:.6g} m "
            "do not make: {} discs would do ({} x {} cells of {})",
            kLargestJammed, kSmallestCell, kLargestCell, discs, length, width, other, tiling->nx, tiling->ny,
            tiling->discs));
  throw std::invalid_argument(fmt::format("{} discs in {:.6g} m x {:.6g} m cannot be put together from equal cells: {}",
                                          discs, length, width, remedy));
}

}  // namespace ddem::packings
