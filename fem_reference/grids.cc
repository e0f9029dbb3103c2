#include "fem_reference/grids.h"

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "fem_reference/file_limit.h"
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
  std::string name = std::filesystem::temp_directory_path() / "ddem-fem-XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a directory like " + name);
  const std::filesystem::path folder = name;
  auto triangulation = std::make_unique<Triangulation>();
  try {
    meshes::write_strip_mesh({double(nx), double(ny), nx, ny}, folder / "strip.msh");
    std::ifstream stream(folder / "strip.msh");
    dealii::GridIn<2> reader(*triangulation);
    reader.read_msh(stream);
  } catch (const dealii::ExceptionBase&) {  // of a file that is not whole; gmsh does not tell why
    std::error_code missing;
    const auto bytes = std::filesystem::file_size(folder / "strip.msh", missing);
    std::filesystem::remove_all(folder);
    const std::string why = !missing && bytes >= file_size_limit() ? ": " + file_error_text(EFBIG) : "";
    throw std::runtime_error("cannot write a mesh to " + (folder / "strip.msh").string() + ", and read it back" + why);
  } catch (...) {
    std::filesystem::remove_all(folder);
    throw;
  }
  std::filesystem::remove_all(folder);
  if (triangulation->n_active_cells() != std::size_t{nx} * ny) throw std::runtime_error("gmsh made another mesh");
  snap_vertices(*triangulation);
  return {std::move(triangulation), double(nx), double(ny)};
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
