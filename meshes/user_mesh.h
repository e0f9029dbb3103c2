#pragma once
// A user's mesh of the strip: a .msh file of quadrilaterals with its edges as physical curves.

#include <filesystem>
#include <string_view>

#include "meshes/mesh_error.h"
#include "meshes/quad_mesh.h"

namespace ddem::meshes {

/// Places are compared with the sides to this part of the width, nodes of periodic edges with each other to this part of
/// the shortest edge beside them: gmsh's own differ by up to 1e-9 of the length.
inline constexpr double side_tolerance = 1e-6, partner_tolerance = 1e-4;

/// What the mesh is to be.
struct StripSpec {
  double length = 0.0, width = 0.0;  ///< m
  bool periodic = false;             ///< top and bottom
};

/// Reads and checks it: the elements cover the rectangle once, sharing whole edges; each edge of the outline is in that one
/// of the physical curves "left", "right", "bottom", "top" on whose side it lies. Nodes on the sides are then moved onto
/// them, those of a periodic top over their partners. Elements of higher order are taken by their corners. Throws MeshError.
QuadMesh read_user_mesh(const std::filesystem::path& file, const StripSpec& strip);

/// The same from the bytes of a file.
QuadMesh parse_user_mesh(std::string_view bytes, const StripSpec& strip);

}  // namespace ddem::meshes
