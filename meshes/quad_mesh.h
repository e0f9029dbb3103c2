#pragma once
// A mesh of quadrilaterals of the strip, in memory.

#include <array>
#include <utility>
#include <vector>

namespace ddem::meshes {

/// Ids of the strip's edges.
inline constexpr unsigned left_id = 1, right_id = 2, bottom_id = 3, top_id = 4;

struct QuadMesh {
  double length = 0.0, width = 0.0;                                ///< m, of the mesh itself
  std::vector<std::array<double, 2>> vertices;                     ///< m, from the lower left corner
  std::vector<std::array<unsigned, 4>> quads;                      ///< vertices counterclockwise
  std::vector<std::pair<std::array<unsigned, 2>, unsigned>> edges;  ///< of the outline: vertices, and left_id .. top_id
};

}  // namespace ddem::meshes
