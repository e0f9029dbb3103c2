#include "fem_reference/strip_model.h"

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>

#include "fem_reference/distributed.h"
#include "fem_reference/grids.h"
#include "fem_reference/kernel/gauss_lobatto.h"
#include "fem_reference/mesh_receivers.h"
#include "meshes/strip_mesh.h"

namespace ddem::fem {
namespace {

using Cell = dealii::DoFHandler<2>::active_cell_iterator;
using dealii::types::global_dof_index;

constexpr std::uint32_t no_node = std::numeric_limits<std::uint32_t>::max();

// Degrees of freedom of deal.II's scalar element, one a node, and where they went in the model.
struct Nodes {
  const dealii::DoFHandler<2>& dofs;
  std::vector<std::uint32_t> node_of_dof;      ///< no_node where it is another process's
  std::vector<dealii::Point<2>> place;         ///< of each node, in units of elements
  std::vector<global_dof_index> dof_of_node;
};

// Of the dofs that a periodic boundary identifies, the one that stands for all.
std::vector<global_dof_index> masters(const dealii::DoFHandler<2>& dofs, bool periodic) {
  std::vector<global_dof_index> master(dofs.n_dofs());
  std::iota(master.begin(), master.end(), global_dof_index{0});
  if (!periodic) return master;
  dealii::IndexSet relevant;
  dealii::DoFTools::extract_locally_relevant_dofs(dofs, relevant);
  dealii::AffineConstraints<double> constraints(relevant);
  dealii::DoFTools::make_periodicity_constraints(dofs, meshes::bottom_id, meshes::top_id, 1, constraints);
  constraints.close();
  for (const global_dof_index dof : relevant) {
    const auto* entries = constraints.get_constraint_entries(dof);
    if (entries == nullptr) continue;
    if (entries->size() != 1) throw std::runtime_error("the periodic edges do not match node by node");
    master[dof] = entries->front().first;
  }
  return master;
}

// Of this process's elements.
std::vector<Cell> own_cells(const dealii::DoFHandler<2>& dofs) {
  std::vector<Cell> cells;
  for (const Cell& cell : dofs.active_cell_iterators()) {
    if (cell->is_locally_owned()) cells.push_back(cell);
  }
  return cells;
}

// Numbers the nodes of this process's elements along x first: an element's nodes are then close in memory, as the strip
// is narrow.
Nodes number_nodes(const dealii::DoFHandler<2>& dofs, bool periodic) {
  Nodes nodes{dofs, std::vector(dofs.n_dofs(), no_node), {}, {}};
  const auto master = masters(dofs, periodic);
  const auto& unit_places = dofs.get_fe().get_unit_support_points();
  const dealii::MappingQ1<2> mapping;
  std::vector<global_dof_index> indices(unit_places.size());
  // The place of a master counts: of the dofs that are one node, it is the same for all processes.
  std::map<global_dof_index, dealii::Point<2>> places, own;
  for (const Cell& cell : dofs.active_cell_iterators()) {
    if (cell->is_artificial()) continue;
    cell->get_dof_indices(indices);
    for (unsigned k = 0; k < indices.size(); ++k) {
      if (master[indices[k]] == indices[k]) places[indices[k]] = mapping.transform_unit_to_real_cell(cell, unit_places[k]);
    }
  }
  for (const Cell& cell : own_cells(dofs)) {
    cell->get_dof_indices(indices);
    for (const global_dof_index dof : indices) own[master[dof]] = places.at(master[dof]);
  }
  std::vector<std::pair<global_dof_index, dealii::Point<2>>> kept(own.begin(), own.end());
  const auto rank = [&](const auto& node) {  // rounded: the nodes of a column differ by round-off
    return std::pair(std::llround(node.second[0] * 1e6), std::llround(node.second[1] * 1e6));
  };
  std::sort(kept.begin(), kept.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  for (const auto& [dof, place] : kept) {
    nodes.node_of_dof[dof] = static_cast<std::uint32_t>(nodes.place.size());
    nodes.place.push_back(place);
    nodes.dof_of_node.push_back(dof);
  }
  for (global_dof_index dof = 0; dof < dofs.n_dofs(); ++dof) nodes.node_of_dof[dof] = nodes.node_of_dof[master[dof]];
  return nodes;
}

// Of every group of `count`.
void keep_first_of(std::size_t count, std::vector<std::array<double, 4>>& values) {
  for (std::size_t k = 0; k * count < values.size(); ++k) values[k] = values[k * count];
  values.resize(values.size() / count);
}

// This process's elements in the order of the model.
std::vector<Cell> sorted_cells(const dealii::DoFHandler<2>& dofs) {
  std::vector<Cell> cells = own_cells(dofs);
  const auto rank = [](const Cell& cell) {
    return std::pair(std::llround(cell->center()[0] * 2.0), std::llround(cell->center()[1] * 2.0));
  };
  std::sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) { return rank(a) < rank(b); });
  return cells;
}

ElementMesh make_elements(const Nodes& nodes, const std::vector<Cell>& cells, double hx, double hy) {
  const auto& fe = dynamic_cast<const dealii::FE_Q<2>&>(nodes.dofs.get_fe());
  const std::vector<unsigned> lexicographic = fe.get_poly_space_numbering_inverse();
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
  for (const auto dof : dofs) {
    if (nodes.node_of_dof[dof] != no_node) result.push_back(nodes.node_of_dof[dof]);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());  // corners of periodic edges
  return result;
}

// Of the strip as a whole to this process's: only nodes that it owns, so that the processes' values add up.
class StripNumbers {
 public:
  StripNumbers(const Nodes& nodes, const StripGrid& grid, const Processes& processes) {
    const GaussLobatto rule = gauss_lobatto(grid.degree);
    const unsigned p = static_cast<unsigned>(grid.degree), rows = grid.ny * p + (grid.periodic ? 0 : 1);
    const auto line = [&](double place, unsigned elements) {
      const unsigned element = std::min(static_cast<unsigned>(place + 1e-6), elements - 1);
      const auto nearest = std::min_element(rule.points.begin(), rule.points.end(), [&](double a, double b) {
        return std::abs(a - (place - element)) < std::abs(b - (place - element));
      });
      return element * p + static_cast<unsigned>(nearest - rule.points.begin());
    };
    for (std::uint32_t node = 0; node < nodes.place.size(); ++node) {
      if (processes.owned()[node] == 0.0) continue;
      const auto& place = nodes.place[node];
      own_[line(place[0], grid.nx) * rows + line(place[1], grid.ny) % rows] = node;
    }
  }

  NodeWeights of(const NodeWeights& weights) const {
    NodeWeights result;
    for (const auto& [node, weight] : weights) {
      const auto found = own_.find(node);
      if (found != own_.end()) result.emplace_back(found->second, weight);
    }
    return result;
  }

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> own_;
};

void add_receivers(const StripCase& strip, const Grid& grid, const Nodes& nodes, StripModel& model) {
  const double hx = strip.length / grid.length, hy = strip.width / grid.width;
  const StripGrid layout{strip.elements[0], strip.elements[1], strip.degree, strip.periodic};
  const MeshNodes mesh_nodes{nodes.dofs, nodes.node_of_dof};
  for (const auto& point : strip.receivers.points) {
    const double x = std::min(point[0] / hx, grid.length), y = std::min(point[1] / hy, grid.width);
    model.points.push_back(strip.mesh.empty() ? at_point(layout, x, y) : at_point(mesh_nodes, {x, y}));
  }
  for (const double place : strip.receivers.sections) {
    const double x = std::min(place / hx, grid.length);
    model.sections.push_back(strip.mesh.empty() ? at_section(layout, x) : at_section(mesh_nodes, x));
  }
}

bool several_processes() {
  return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1;
}

// The elements dealt out to the processes. Across a periodic edge they are neighbours.
std::unique_ptr<dealii::Triangulation<2>> distribute(const dealii::Triangulation<2>& whole, bool periodic) {
  auto grid = std::make_unique<dealii::parallel::distributed::Triangulation<2>>(MPI_COMM_WORLD);
  grid->copy_triangulation(whole);
  if (!periodic) return grid;
  std::vector<dealii::GridTools::PeriodicFacePair<dealii::Triangulation<2>::cell_iterator>> pairs;
  dealii::GridTools::collect_periodic_faces(*grid, meshes::bottom_id, meshes::top_id, 1, pairs);
  grid->add_periodicity(pairs);
  return grid;
}

}  // namespace

struct StripModeller::Meshes {
  std::map<std::pair<unsigned, unsigned>, Grid> rectangles;
  std::map<std::tuple<std::filesystem::path, double, double, bool>, Grid> users;  ///< with what they were checked for

  const Grid& of(const StripCase& strip) {
    const auto [nx, ny] = strip.elements;
    Grid& grid = strip.mesh.empty() ? rectangles[{nx, ny}] : users[{strip.mesh, strip.length, strip.width, strip.periodic}];
    if (grid.triangulation == nullptr) grid = strip.mesh.empty() ? rectangle_grid(nx, ny) : user_grid(strip);
    return grid;
  }
};

StripModeller::StripModeller() : meshes_(std::make_unique<Meshes>()) {}
StripModeller::~StripModeller() = default;

void StripModeller::read_meshes(const std::vector<StripCase>& cases) {
  std::set<std::string> problems;  // of a mesh that many cases share once
  for (const StripCase& strip : cases) {
    try {
      if (!strip.mesh.empty()) meshes_->of(strip);
    } catch (const CaseError& error) {
      problems.insert(error.what());
    }
  }
  if (!problems.empty()) throw CaseError(fmt::format("{}", fmt::join(problems, "\n")));
}

StripModel StripModeller::model(const StripCase& strip) {
  const auto [nx, ny] = strip.elements;
  const Grid& grid = meshes_->of(strip);
  std::unique_ptr<dealii::Triangulation<2>> shared;
  if (several_processes()) {
    if (!strip.mesh.empty()) throw CaseError(strip.mesh.string() + ": a mesh from a file runs in one process");
    if (strip.snapshots > 0) throw CaseError("case \"" + strip.id + "\", snapshots: need one process; run ddem-fem without mpirun");
    shared = distribute(*grid.triangulation, strip.periodic);
  }
  dealii::DoFHandler<2> dofs(shared ? *shared : *grid.triangulation);
  dofs.distribute_dofs(dealii::FE_Q<2>(strip.degree));  // on Gauss-Lobatto points
  const Nodes nodes = number_nodes(dofs, strip.periodic);

  const double hx = strip.length / grid.length, hy = strip.width / grid.width;
  StripModel model;
  const std::vector<Cell> cells = sorted_cells(dofs);
  model.mesh = make_elements(nodes, cells, hx, hy);
  if (strip.snapshots > 0) {
    for (const Cell& cell : cells) {
      auto& corners = model.corners.emplace_back();
      for (unsigned k = 0; k < 4; ++k) corners[k] = {cell->vertex(k)[0] * hx, cell->vertex(k)[1] * hy};
    }
  }
  model.left_nodes = nodes_of_edge(nodes, meshes::left_id);
  model.right_nodes = nodes_of_edge(nodes, meshes::right_id);
  for (const auto& place : nodes.place) {
    model.x.push_back(place[0] * hx);
    model.y.push_back(place[1] * hy);
  }
  add_receivers(strip, grid, nodes, model);
  if (!shared) return model;
  model.processes = std::make_shared<DistributedProcesses>(dofs.locally_owned_dofs(), nodes.dof_of_node);
  const StripNumbers own(nodes, {nx, ny, strip.degree, strip.periodic}, *model.processes);
  for (auto* receivers : {&model.points, &model.sections}) {
    for (NodeWeights& weights : *receivers) weights = own.of(weights);
  }
  return model;
}

}  // namespace ddem::fem
