#include "fem_reference/mesh_receivers.h"

#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "fem_reference/cases.h"
#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem {
namespace {

using Cell = dealii::DoFHandler<2>::active_cell_iterator;

class Weights {
 public:
  explicit Weights(const MeshNodes& nodes) : nodes_(nodes), indices_(nodes.dofs.get_fe().n_dofs_per_cell()) {}

  void add(const Cell& cell, const dealii::Point<2>& unit, double factor) {
    cell->get_dof_indices(indices_);
    for (unsigned k = 0; k < indices_.size(); ++k) {
      weights_[nodes_.node_of_dof[indices_[k]]] += factor * nodes_.dofs.get_fe().shape_value(k, unit);
    }
  }

  NodeWeights take() const { return {weights_.begin(), weights_.end()}; }

 private:
  const MeshNodes& nodes_;
  std::vector<dealii::types::global_dof_index> indices_;
  std::map<std::uint32_t, double> weights_;
};

// Lower and upper end of the line at x in a cell; empty if they are equal. An edge along the line belongs to the cell on
// its right, or at the very end to that on its left.
std::pair<double, double> segment(const Cell& cell, double x, double end) {
  constexpr unsigned around[] = {0, 1, 3, 2, 0};
  double low = std::numeric_limits<double>::infinity(), high = -low, right = -low;
  for (int k = 0; k < 4; ++k) {
    const auto &a = cell->vertex(around[k]), &b = cell->vertex(around[k + 1]);
    right = std::max(right, a[0]);
    if ((a[0] - x) * (b[0] - x) > 0.0) continue;
    const double s = a[0] == b[0] ? 0.0 : (x - a[0]) / (b[0] - a[0]);
    for (const double y : {a[1] + s * (b[1] - a[1]), a[0] == b[0] ? b[1] : a[1] + s * (b[1] - a[1])}) {
      low = std::min(low, y);
      high = std::max(high, y);
    }
  }
  if (!(high > low) || (right <= x && x < end)) return {0.0, 0.0};
  return {low, high};
}

}  // namespace

NodeWeights at_point(const MeshNodes& nodes, const dealii::Point<2>& place) {
  const dealii::MappingQ1<2> mapping;
  Weights weights(nodes);
  try {
    const auto [cell, unit] = dealii::GridTools::find_active_cell_around_point(mapping, nodes.dofs, place);
    if (cell == nodes.dofs.end()) throw CaseError("");
    weights.add(cell, unit, 1.0);
  } catch (const std::exception&) {  // deal.II says it by an exception or by an end iterator, depending on its version
    throw CaseError("receivers, points: one of them lies in no element of the mesh");
  }
  return weights.take();
}

NodeWeights at_section(const MeshNodes& nodes, double x) {
  const dealii::MappingQ1<2> mapping;
  const GaussLobatto rule = gauss_lobatto(static_cast<int>(nodes.dofs.get_fe().degree));
  double end = 0.0, total = 0.0;
  for (const auto& vertex : nodes.dofs.get_triangulation().get_vertices()) end = std::max(end, vertex[0]);
  x = std::min(x, end);
  for (const Cell& cell : nodes.dofs.active_cell_iterators()) {
    const auto [low, high] = segment(cell, x, end);
    total += high - low;
  }
  if (!(total > 0.0)) throw CaseError("receivers, sections: one of them meets no element of the mesh");
  Weights weights(nodes);
  for (const Cell& cell : nodes.dofs.active_cell_iterators()) {
    const auto [low, high] = segment(cell, x, end);
    if (!(high > low)) continue;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const dealii::Point<2> place(x, low + rule.points[q] * (high - low));
      weights.add(cell, mapping.transform_real_to_unit_cell(cell, place), rule.weights[q] * (high - low) / total);
    }
  }
  return weights.take();
}

}  // namespace ddem::fem
