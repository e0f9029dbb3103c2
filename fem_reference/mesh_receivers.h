#pragma once
// Receivers in a mesh of general quadrilaterals: the polynomial of the element that holds them.

#include <deal.II/dofs/dof_handler.h>

#include <vector>

#include "fem_reference/strip_receivers.h"

namespace ddem::fem {

/// A node for each degree of freedom of deal.II's scalar element, and places in the units of the grid.
struct MeshNodes {
  const dealii::DoFHandler<2>& dofs;
  const std::vector<std::uint32_t>& node_of_dof;
};

/// Throws CaseError if no element holds the point.
NodeWeights at_point(const MeshNodes& nodes, const dealii::Point<2>& place);

/// The average over what of the line at x lies in elements, by Gauss-Lobatto rules in each of them. Throws CaseError if
/// nothing does.
NodeWeights at_section(const MeshNodes& nodes, double x);

}  // namespace ddem::fem
