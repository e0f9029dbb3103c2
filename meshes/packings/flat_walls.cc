#include "meshes/packings/flat_walls.h"

#include <algorithm>
#include <limits>

namespace ddem::packings {

double gap_to_walls(const Packing& packing, FlatWalls walls, std::size_t disc) {
  const double x = packing.x[disc], y = packing.y[disc];
  double nearest = std::numeric_limits<double>::infinity();
  if (walls.x) nearest = std::min({nearest, x, packing.length - x});
  if (walls.y) nearest = std::min({nearest, y, packing.width - y});
  return nearest - packing.radius[disc];
}

std::vector<char> inner_discs(const Packing& packing, FlatWalls walls) {
  const double mean = mean_radius(packing);
  std::vector<char> inner(packing.size(), 0);
  for (std::size_t i = 0; i < packing.size(); ++i) inner[i] = gap_to_walls(packing, walls, i) > mean ? 1 : 0;
  return inner;
}

}  // namespace ddem::packings
