#include "fem_reference/grids.h"

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "fem_reference/cases.h"
#include "meshes/strip_mesh.h"
#include "meshes/user_mesh.h"

namespace ddem::fem {
namespace {

using Triangulation = dealii::Triangulation<2>;

// gmsh places the vertices of a transfinite curve with an error of 1e-9 of its length: too much for deal.II's
// matching of periodic faces. In units of elements they are whole numbers.
void snap_vertices(Triangulation& grid) {
  dealii::GridTools::transform(
      [](const dealii::Point<2>& vertex) {
        const dealii::Point<2> snapped(std::round(vertex[0]), std::round(vertex[1]));
        if (snapped.distance(vertex) > 1e-3) throw std::runtime_error("gmsh's mesh is not transfinite");
        return snapped;
      },
      grid);
}

struct Box {
  std::array<double, 2> low, high;
};

Box box_of(const meshes::QuadMesh& mesh) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity}, {-infinity, -infinity}};
  for (const auto& vertex : mesh.vertices) {
    for (int c = 0; c < 2; ++c) {
      box.low[c] = std::min(box.low[c], vertex[c]);
      box.high[c] = std::max(box.high[c], vertex[c]);
    }
  }
  return box;
}

Grid make_grid(const meshes::QuadMesh& mesh, const Box& box, double unit) {
  std::vector<dealii::Point<2>> vertices;
  for (const auto& v : mesh.vertices) vertices.emplace_back((v[0] - box.low[0]) / unit, (v[1] - box.low[1]) / unit);
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
  Grid grid{std::make_unique<Triangulation>(), (box.high[0] - box.low[0]) / unit, (box.high[1] - box.low[1]) / unit};
  grid.triangulation->create_triangulation(vertices, cells, edges);
  return grid;
}

}  // namespace

Grid rectangle_grid(unsigned nx, unsigned ny) {
  std::string name = std::filesystem::temp_directory_path() / "ddem-fem-XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a directory like " + name);
  const std::filesystem::path folder = name;
  auto triangulation = std::make_unique<Triangulation>();
  try {
    meshes::write_strip_mesh({double(nx), double(ny), nx, ny}, folder / "strip.msh");
    std::ifstream stream(folder / "strip.msh");
    dealii::GridIn<2> reader(*triangulation);
    reader.read_msh(stream);
  } catch (...) {
    std::filesystem::remove_all(folder);
    throw;
  }
  std::filesystem::remove_all(folder);
  if (triangulation->n_active_cells() != std::size_t{nx} * ny) throw std::runtime_error("gmsh made another mesh");
  snap_vertices(*triangulation);
  return {std::move(triangulation), double(nx), double(ny)};
}

Grid user_grid(const std::filesystem::path& file, double length, double width) {
  try {
    const meshes::QuadMesh mesh = meshes::read_user_mesh(file);
    const Box box = box_of(mesh);
    const double own_length = box.high[0] - box.low[0], own_width = box.high[1] - box.low[1];
    if (std::abs(own_length - length) > 1e-6 * length || std::abs(own_width - width) > 1e-6 * width) {
      throw meshes::MeshError(fmt::format("is {:.9g} m long and {:.9g} m wide, the strip {:.9g} m and {:.9g} m", own_length,
                                          own_width, length, width));
    }
    return make_grid(mesh, box, 0.01 * width);
  } catch (const meshes::MeshError& error) {
    throw CaseError(file.string() + ": " + error.what());
  } catch (const dealii::ExceptionBase& error) {
    throw CaseError(file.string() + ": deal.II refuses this mesh: " + error.what());
  }
}

}  // namespace ddem::fem
