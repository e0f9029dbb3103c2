#include "fem_reference/strip_model.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>

#include "meshes/strip_mesh.h"

namespace ddem::fem {
namespace {

using Triangulation = dealii::Triangulation<2>;
using Cell = dealii::DoFHandler<2>::active_cell_iterator;
using dealii::types::global_dof_index;

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

// The grid is in units of elements, [0, nx] x [0, ny]: gmsh's and deal.II's absolute tolerances then suit a
// strip of any size, and all strips with the same counts share one mesh.
std::unique_ptr<Triangulation> read_grid(unsigned nx, unsigned ny) {
  std::string name = std::filesystem::temp_directory_path() / "ddem-fem-XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a directory like " + name);
  const std::filesystem::path folder = name;
  auto grid = std::make_unique<Triangulation>();
  try {
    meshes::write_strip_mesh({double(nx), double(ny), nx, ny}, folder / "strip.msh");
    std::ifstream stream(folder / "strip.msh");
    dealii::GridIn<2> reader(*grid);
    reader.read_msh(stream);
  } catch (...) {
    std::filesystem::remove_all(folder);
    throw;
  }
  std::filesystem::remove_all(folder);
  if (grid->n_active_cells() != std::size_t{nx} * ny) throw std::runtime_error("gmsh made another mesh");
  snap_vertices(*grid);
  return grid;
}

// Degrees of freedom of deal.II's scalar element, one a node, and where they went in the model.
struct Nodes {
  const dealii::DoFHandler<2>& dofs;
  dealii::MappingQ1<2> mapping;
  std::vector<std::uint32_t> node_of_dof;
  std::vector<dealii::Point<2>> place;  ///< of each node, in units of elements
};

// Of the dofs that a periodic boundary identifies, the one that stands for all.
std::vector<global_dof_index> masters(const dealii::DoFHandler<2>& dofs, bool periodic) {
  std::vector<global_dof_index> master(dofs.n_dofs());
  std::iota(master.begin(), master.end(), global_dof_index{0});
  if (!periodic) return master;
  dealii::AffineConstraints<double> constraints;
  dealii::DoFTools::make_periodicity_constraints(dofs, meshes::bottom_id, meshes::top_id, 1, constraints);
  constraints.close();
  for (global_dof_index dof = 0; dof < dofs.n_dofs(); ++dof) {
    const auto* entries = constraints.get_constraint_entries(dof);
    if (entries == nullptr) continue;
    if (entries->size() != 1) throw std::runtime_error("the periodic edges do not match node by node");
    master[dof] = entries->front().first;
  }
  return master;
}

// Numbers the nodes along x first: an element's nodes are then close in memory, as the strip is narrow.
Nodes number_nodes(const dealii::DoFHandler<2>& dofs, bool periodic) {
  Nodes nodes{dofs, {}, {}, {}};
  std::vector<dealii::Point<2>> support(dofs.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(nodes.mapping, dofs, support);
  const auto master = masters(dofs, periodic);
  std::vector<global_dof_index> kept;
  for (global_dof_index dof = 0; dof < dofs.n_dofs(); ++dof) {
    if (master[dof] == dof) kept.push_back(dof);
  }
  const auto rank = [&](global_dof_index dof) {  // rounded: the nodes of a column differ by round-off
    return std::pair(std::llround(support[dof][0] * 1e6), std::llround(support[dof][1] * 1e6));
  };
  std::sort(kept.begin(), kept.end(), [&](auto a, auto b) { return rank(a) < rank(b); });
  nodes.node_of_dof.resize(dofs.n_dofs());
  for (std::size_t node = 0; node < kept.size(); ++node) {
    nodes.node_of_dof[kept[node]] = static_cast<std::uint32_t>(node);
    nodes.place.push_back(support[kept[node]]);
  }
  for (global_dof_index dof = 0; dof < dofs.n_dofs(); ++dof) {
    nodes.node_of_dof[dof] = nodes.node_of_dof[master[dof]];
  }
  return nodes;
}

ElementMesh make_elements(const Nodes& nodes, double hx, double hy) {
  const auto& fe = dynamic_cast<const dealii::FE_Q<2>&>(nodes.dofs.get_fe());
  const std::vector<unsigned> lexicographic = fe.get_poly_space_numbering_inverse();
  std::vector<Cell> cells;
  for (const Cell& cell : nodes.dofs.active_cell_iterators()) cells.push_back(cell);
  const auto rank = [](const Cell& cell) {
    return std::pair(std::llround(cell->center()[0] * 2.0), std::llround(cell->center()[1] * 2.0));
  };
  std::sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) { return rank(a) < rank(b); });
  ElementMesh mesh;
  mesh.degree = static_cast<int>(fe.degree);
  mesh.node_count = nodes.place.size();
  std::vector<global_dof_index> indices(fe.n_dofs_per_cell());
  for (const Cell& cell : cells) {
    cell->get_dof_indices(indices);
    for (const unsigned k : lexicographic) mesh.nodes.push_back(nodes.node_of_dof[indices[k]]);
    const auto xi = cell->vertex(1) - cell->vertex(0), eta = cell->vertex(2) - cell->vertex(0);
    if ((cell->vertex(3) - cell->vertex(0) - xi - eta).norm() > 1e-9) {
      throw std::runtime_error("an element of the mesh is no parallelogram");
    }
    mesh.jacobians.push_back({xi[0] * hx, eta[0] * hx, xi[1] * hy, eta[1] * hy});
  }
  return mesh;
}

}  // namespace

struct StripModeller::Meshes {
  std::map<std::pair<unsigned, unsigned>, std::unique_ptr<Triangulation>> grids;
};

StripModeller::StripModeller() : meshes_(std::make_unique<Meshes>()) {}
StripModeller::~StripModeller() = default;

StripModel StripModeller::model(const StripCase& strip) {
  const auto [nx, ny] = strip.elements;
  auto& grid = meshes_->grids[{nx, ny}];
  if (grid == nullptr) grid = read_grid(nx, ny);
  dealii::DoFHandler<2> dofs(*grid);
  dofs.distribute_dofs(dealii::FE_Q<2>(strip.degree));  // on Gauss-Lobatto points
  const Nodes nodes = number_nodes(dofs, strip.periodic);

  const double hx = strip.length / nx, hy = strip.width / ny;
  StripModel model;
  model.mesh = make_elements(nodes, hx, hy);
  for (std::uint32_t node = 0; node < nodes.place.size(); ++node) {
    const double x = nodes.place[node][0];
    if (x < 1e-6) model.left_nodes.push_back(node);
    if (x > nx - 1e-6) model.right_nodes.push_back(node);
    model.x.push_back(x * hx);
    model.y.push_back(nodes.place[node][1] * hy);
  }
  const StripGrid layout{nx, ny, strip.degree, strip.periodic};
  for (const auto& [x, y] : strip.receivers.points) {
    model.points.push_back(at_point(layout, std::min(x / hx, double(nx)), std::min(y / hy, double(ny))));
  }
  for (const double x : strip.receivers.sections) {
    model.sections.push_back(at_section(layout, std::min(x / hx, double(nx))));
  }
  return model;
}

}  // namespace ddem::fem
