#pragma once
// A user's mesh of the strip: a .msh file of any version that gmsh reads, with its edges as physical groups.

#include <array>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

namespace ddem::meshes {

/// What is wrong with the file, and what would be right.
class MeshError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

struct QuadMesh {
  std::vector<std::array<double, 2>> vertices;                     ///< m
  std::vector<std::array<unsigned, 4>> quads;                      ///< vertices counterclockwise
  std::vector<std::pair<std::array<unsigned, 2>, unsigned>> edges;  ///< vertices, and left_id .. top_id (strip_mesh.h)
};

/// Quadrilaterals and the physical curves "left", "right", "bottom", "top" of a plane mesh in metres. Curved elements
/// are taken by their corners. Throws MeshError if there are no such curves, or elements that are no quadrilaterals.
QuadMesh read_user_mesh(const std::filesystem::path& file);

}  // namespace ddem::meshes
