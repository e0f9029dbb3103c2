#pragma once
// deal.II's triangulation of a strip: equal rectangles from gmsh, or a user's mesh. Edges carry the boundary ids of
// meshes/quad_mesh.h.

#include <deal.II/grid/tria.h>

#include <memory>

#include "fem_reference/cases.h"

namespace ddem::fem {

/// Coordinates are in units that suit the absolute tolerances of gmsh and deal.II, from the lower left corner: the
/// elements of rectangles, a hundredth of the width of a user's mesh.
struct Grid {
  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  double length = 0.0, width = 0.0;  ///< in units
};

/// [0, nx] x [0, ny]. Throws std::runtime_error if gmsh fails.
Grid rectangle_grid(unsigned nx, unsigned ny);

/// Of a case with a mesh. Throws CaseError with all that is wrong with its file (meshes/user_mesh.h).
Grid user_grid(const StripCase& strip);

}  // namespace ddem::fem
