#pragma once
// The strip's rectangle as a transfinite mesh of quadrilaterals, made by gmsh.

#include <filesystem>

namespace ddem::meshes {

/// Boundary ids (physical curves) of the strip.
inline constexpr unsigned left_id = 1, right_id = 2, bottom_id = 3, top_id = 4;

struct StripGeometry {
  double length = 0.0, width = 0.0;  ///< along x and y, from the origin
  unsigned nx = 0, ny = 0;           ///< elements along them
};

/// Writes nx * ny equal rectangles and their boundary ids as a .msh file (format 4.1). Silent; not to be
/// called from two threads at once (gmsh has one global model). Throws std::runtime_error with gmsh's reason.
void write_strip_mesh(const StripGeometry& geometry, const std::filesystem::path& file);

}  // namespace ddem::meshes
