#pragma once
// The strip's rectangle as a transfinite mesh of quadrilaterals, made by gmsh.

#include "meshes/quad_mesh.h"

namespace ddem::meshes {

struct StripGeometry {
  double length = 0.0, width = 0.0;  ///< along x and y, from the origin
  unsigned nx = 0, ny = 0;           ///< elements along them
};

/// nx * ny equal rectangles, as gmsh numbers them; gmsh places vertices with an error of 1e-9 of the length. Silent, without a file; not to
/// be called from two threads at once (gmsh has one global model). Throws std::runtime_error with gmsh's reason.
QuadMesh strip_mesh(const StripGeometry& geometry);

}  // namespace ddem::meshes
