#pragma once
// Strain and stress at the nodes, for looking at: an element's own jump from one to the next.

#include <span>
#include <vector>

#include "fem_reference/kernel/element_mesh.h"
#include "fem_reference/kernel/material.h"

namespace ddem::fem {

/// A symmetric tensor of each node; xy is the tensor's component, half the engineering shear.
struct NodeTensor {
  std::vector<double> xx, yy, xy;
};

/// The mean of the strains that the elements at a node have there, weighted with the mass that each of them gives it: the lumped
/// projection onto the nodes. Exact for displacements that are linear in x and y; else of the order of the degree in the size of
/// the elements. `u`: 2 a node, interleaved, m.
NodeTensor node_strains(const ElementMesh& mesh, std::span<const double> u);

/// sigma = lambda tr(eps) 1 + 2 mu eps, Pa, in the plane.
NodeTensor stresses(const NodeTensor& strain, const PlaneMaterial& material);

}  // namespace ddem::fem
