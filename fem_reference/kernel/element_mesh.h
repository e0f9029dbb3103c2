#pragma once
// What the kernel knows of a mesh: which nodes an element has, and its shape. No coordinates, no deal.II.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ddem::fem {

/// Affine quadrilaterals (parallelograms) of one degree. Nodes that a periodic boundary identifies are one
/// node.
struct ElementMesh {
  int degree = 1;
  std::size_t node_count = 0;
  /// elements x (degree+1)^2: node of each Gauss-Lobatto point, the first reference direction xi fastest.
  std::vector<std::uint32_t> nodes;
  /// Per element dx/dxi, dx/deta, dy/dxi, dy/deta in metres, xi and eta running over [0, 1].
  std::vector<std::array<double, 4>> jacobians;

  std::size_t element_count() const { return jacobians.size(); }
};

}  // namespace ddem::fem
