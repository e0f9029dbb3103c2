#include "fem_reference/strip_model.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "fem_reference/grids.h"
#include "fem_reference/kernel/gauss_lobatto.h"
#include "fem_reference/mesh_receivers.h"
#include "meshes/strip_mesh.h"

namespace ddem::fem {
namespace {

using Cell = dealii::DoFHandler<2>::active_cell_iterator;
using dealii::types::global_dof_index;

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

// Of every group of `count`.
void keep_first_of(std::size_t count, std::vector<std::array<double, 4>>& values) {
  for (std::size_t k = 0; k * count < values.size(); ++k) values[k] = values[k * count];
  values.resize(values.size() / count);
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
  const GaussLobatto rule = gauss_lobatto(static_cast<int>(fe.degree));
  bool affine = true;
  ElementMesh mesh;
  mesh.degree = static_cast<int>(fe.degree);
  mesh.node_count = nodes.place.size();
  std::vector<global_dof_index> indices(fe.n_dofs_per_cell());
  for (const Cell& cell : cells) {
    cell->get_dof_indices(indices);
    for (const unsigned k : lexicographic) mesh.nodes.push_back(nodes.node_of_dof[indices[k]]);
    const auto corner = [&](unsigned k) { return cell->vertex(k); };
    const auto twist = corner(3) - corner(2) - (corner(1) - corner(0));
    affine = affine && twist.norm() < 1e-9;
    for (const double eta : rule.points) {
      for (const double xi : rule.points) {
        const auto along = corner(1) - corner(0) + eta * twist, across = corner(2) - corner(0) + xi * twist;
        mesh.jacobians.push_back({along[0] * hx, across[0] * hx, along[1] * hy, across[1] * hy});
      }
    }
  }
  if (affine) keep_first_of(mesh.points_per_element(), mesh.jacobians);
  return mesh;
}

std::vector<std::uint32_t> nodes_of_edge(const Nodes& nodes, unsigned id) {
  const dealii::IndexSet dofs = dealii::DoFTools::extract_boundary_dofs(nodes.dofs, dealii::ComponentMask(), {id});
  std::vector<std::uint32_t> result;
  for (const auto dof : dofs) result.push_back(nodes.node_of_dof[dof]);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());  // corners of periodic edges
  return result;
}

}  // namespace

struct StripModeller::Meshes {
  std::map<std::pair<unsigned, unsigned>, Grid> rectangles;
  std::map<std::filesystem::path, Grid> users;
};

StripModeller::StripModeller() : meshes_(std::make_unique<Meshes>()) {}
StripModeller::~StripModeller() = default;

StripModel StripModeller::model(const StripCase& strip) {
  const auto [nx, ny] = strip.elements;
  auto& grid = strip.mesh.empty() ? meshes_->rectangles[{nx, ny}] : meshes_->users[strip.mesh];
  if (grid.triangulation == nullptr) {
    grid = strip.mesh.empty() ? rectangle_grid(nx, ny) : user_grid(strip.mesh, strip.length, strip.width);
  }
  dealii::DoFHandler<2> dofs(*grid.triangulation);
  dofs.distribute_dofs(dealii::FE_Q<2>(strip.degree));  // on Gauss-Lobatto points
  const Nodes nodes = number_nodes(dofs, strip.periodic);

  const double hx = strip.length / grid.length, hy = strip.width / grid.width;
  StripModel model;
  model.mesh = make_elements(nodes, hx, hy);
  model.left_nodes = nodes_of_edge(nodes, meshes::left_id);
  model.right_nodes = nodes_of_edge(nodes, meshes::right_id);
  for (const auto& place : nodes.place) {
    model.x.push_back(place[0] * hx);
    model.y.push_back(place[1] * hy);
  }
  const StripGrid layout{nx, ny, strip.degree, strip.periodic};
  const MeshNodes mesh_nodes{dofs, nodes.node_of_dof};
  for (const auto& point : strip.receivers.points) {
    const double x = std::min(point[0] / hx, grid.length), y = std::min(point[1] / hy, grid.width);
    model.points.push_back(strip.mesh.empty() ? at_point(layout, x, y) : at_point(mesh_nodes, {x, y}));
  }
  for (const double place : strip.receivers.sections) {
    const double x = std::min(place / hx, grid.length);
    model.sections.push_back(strip.mesh.empty() ? at_section(layout, x) : at_section(mesh_nodes, x));
  }
  return model;
}

}  // namespace ddem::fem
