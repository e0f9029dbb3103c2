#pragma once
// deal.II's triangulation of a strip: equal rectangles from gmsh, or a user's mesh. Edges carry the boundary ids of
// meshes/strip_mesh.h.

#include <deal.II/grid/tria.h>

#include <filesystem>
#include <memory>

namespace ddem::fem {

/// Coordinates are in units that suit the absolute tolerances of gmsh and deal.II, from the lower left corner: the
/// elements of rectangles, a hundredth of the width of a user's mesh.
struct Grid {
  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  double length = 0.0, width = 0.0;  ///< in units
};

/// [0, nx] x [0, ny]. Throws std::runtime_error if gmsh fails.
Grid rectangle_grid(unsigned nx, unsigned ny);

/// Throws CaseError for a file that is no such mesh, or one that is not `length` long and `width` wide to 1e-6.
Grid user_grid(const std::filesystem::path& file, double length, double width);

}  // namespace ddem::fem
