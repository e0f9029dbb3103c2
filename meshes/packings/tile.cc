#include "meshes/packings/tile.h"

#include <fmt/format.h>

#include <stdexcept>

namespace ddem::packings {

Packing tile(const Packing& packing, int nx, int ny) {
  if (nx < 1 || ny < 1)
    throw std::invalid_argument(fmt::format("a packing cannot be repeated {} x {} times", nx, ny));
  if ((nx > 1 && packing.period.x <= 0.0) || (ny > 1 && packing.period.y <= 0.0))
    throw std::invalid_argument("a packing can be repeated only in a direction in which it is periodic");
  if (static_cast<double>(packing.size()) * nx * ny > 1e8)
    throw std::invalid_argument(
        fmt::format("{} discs repeated {} x {} times are more than 1e8", packing.size(), nx, ny));

  Packing tiled;
  for (int a = 0; a < nx; ++a)
    for (int b = 0; b < ny; ++b) {
      for (const double x : packing.x) tiled.x.push_back(x + a * packing.period.x);
      for (const double y : packing.y) tiled.y.push_back(y + b * packing.period.y);
      tiled.radius.insert(tiled.radius.end(), packing.radius.begin(), packing.radius.end());
    }
  tiled.period = {nx * packing.period.x, ny * packing.period.y};
  tiled.length = nx * packing.length;
  tiled.width = ny * packing.width;
  return tiled;
}

}  // namespace ddem::packings
