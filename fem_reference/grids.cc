#include "fem_reference/grids.h"

#include <deal.II/grid/grid_tools.h>
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "meshes/strip_mesh.h"
#include "meshes/user_mesh.h"

namespace ddem::fem {
namespace {

using Triangulation = dealii::Triangulation<2>;

Grid make_grid(const meshes::QuadMesh& mesh, double unit) {
  std::vector<dealii::Point<2>> vertices;
  for (const auto& v : mesh.vertices) vertices.emplace_back(v[0] / unit, v[1] / unit);
  std::vector<dealii::CellData<2>> cells(mesh.quads.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto& q = mesh.quads[k];
    cells[k].vertices = {q[0], q[1], q[3], q[2]};  // deal.II's order is lexicographic
  }
  dealii::SubCellData edges;
  for (const auto& [ends, id] : mesh.edges) {
    edges.boundary_lines.emplace_back();
    edges.boundary_lines.back().vertices = {ends[0], ends[1]};
    edges.boundary_lines.back().boundary_id = id;
  }
  dealii::GridTools::consistently_order_cells(cells);
  Grid grid{std::make_unique<Triangulation>(), mesh.length / unit, mesh.width / unit};
  grid.triangulation->create_triangulation(vertices, cells, edges);
  return grid;
}

std::string each_line_after(const std::string& start, const std::string& lines) {
  std::istringstream stream(lines);
  std::string result;
  for (std::string line; std::getline(stream, line);) result += (result.empty() ? "" : "\n") + start + line;
  return result;
}

}  // namespace

Grid rectangle_grid(unsigned nx, unsigned ny) {
  meshes::QuadMesh mesh = meshes::strip_mesh({double(nx), double(ny), nx, ny});
  if (mesh.quads.size() != std::size_t{nx} * ny) throw std::runtime_error("gmsh made another mesh");
  // Its errors are too large for deal.II's matching of periodic faces. In units of elements vertices are whole numbers.
  for (auto& vertex : mesh.vertices) {
    for (double& coordinate : vertex) {
      const double snapped = std::round(coordinate);
      if (std::abs(snapped - coordinate) > 1e-3) throw std::runtime_error("gmsh's mesh is not transfinite");
      coordinate = snapped;
    }
  }
  return make_grid(mesh, 1.0);
}

Grid user_grid(const StripCase& strip) {
  const std::string file = strip.mesh.string();
  try {
    const meshes::QuadMesh mesh = meshes::read_user_mesh(strip.mesh, {strip.length, strip.width, strip.periodic});
    const std::string excess = excess_of(static_cast<double>(mesh.quads.size()), strip.degree);
    if (!excess.empty()) throw CaseError(fmt::format("{} elements {}", mesh.quads.size(), excess));
    return make_grid(mesh, 0.01 * strip.width);
  } catch (const std::invalid_argument& error) {  // MeshError, CaseError
    throw CaseError(each_line_after(file + ": ", error.what()));
  } catch (const dealii::ExceptionBase& error) {
    throw CaseError(fmt::format("{}: deal.II refuses this mesh ({})", file, error.get_exc_name()));
  }
}

}  // namespace ddem::fem
