#pragma once
// What the kernel knows of a mesh: which nodes an element has, and its shape. No coordinates, no deal.II.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ddem::fem {

/// Quadrilaterals of one degree, all of them parallelograms or of any shape. Nodes that a periodic boundary
/// identifies are one node.
struct ElementMesh {
  int degree = 1;
  std::size_t node_count = 0;
  /// elements x (degree+1)^2: node of each Gauss-Lobatto point, the first reference direction xi fastest.
  std::vector<std::uint32_t> nodes;
  /// dx/dxi, dx/deta, dy/dxi, dy/deta in metres, xi and eta running over [0, 1]: one an element, where all elements
  /// are parallelograms, or one at each point of each element, ordered as `nodes`.
  std::vector<std::array<double, 4>> jacobians;

  std::size_t points_per_element() const { return std::size_t(degree + 1) * std::size_t(degree + 1); }
  std::size_t element_count() const { return nodes.size() / points_per_element(); }
  bool affine() const { return jacobians.size() == element_count(); }
};

}  // namespace ddem::fem
