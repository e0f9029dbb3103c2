#pragma once
// Flat frictionless walls around a packing.

#include <vector>

#include "dem/core/packing.h"

namespace ddem::packings {

/// Walls at the ends in x (at 0 and length) and in y (at 0 and width); periodic where there are none.
struct FlatWalls {
  bool x = false, y = false;

  bool operator==(const FlatWalls&) const = default;
};

/// Free distance between a disc's surface and the nearest wall (negative where it overlaps), m; infinite without walls.
double gap_to_walls(const Packing& packing, FlatWalls walls, std::size_t disc);

/// Marks (1) the discs whose surfaces are more than a mean radius away from every wall. The others have neighbours on one
/// side only: where a property of the material inside is counted, such as its coordination, they are left out.
std::vector<char> inner_discs(const Packing& packing, FlatWalls walls);

}  // namespace ddem::packings
