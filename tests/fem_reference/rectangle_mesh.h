#pragma once
// A structured mesh of a rectangle (or of the parallelogram that a shear makes of it), with its coordinates,
// for tests of the kernel without deal.II or gmsh.

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "fem_reference/kernel/elastic_operator.h"
#include "fem_reference/kernel/element_mesh.h"
#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem::test {

struct Rectangle {
  double length = 1.0, height = 1.0;
  int nx = 1, ny = 1, degree = 1;
  bool periodic_x = false, periodic_y = false;
  double slant = 0.0;  ///< x is moved by slant * y
};

struct RectangleMesh {
  ElementMesh mesh;
  std::vector<double> x, y;  ///< of each node
};

inline RectangleMesh make_rectangle(const Rectangle& r) {
  const GaussLobatto rule = gauss_lobatto(r.degree);
  const int p = r.degree;
  const int columns = r.nx * p + (r.periodic_x ? 0 : 1), rows = r.ny * p + (r.periodic_y ? 0 : 1);
  const double hx = r.length / r.nx, hy = r.height / r.ny;
  RectangleMesh result;
  result.mesh.degree = p;
  result.mesh.node_count = static_cast<std::size_t>(columns * rows);
  result.x.resize(result.mesh.node_count);
  result.y.resize(result.mesh.node_count);
  for (int ex = 0; ex < r.nx; ++ex) {
    for (int ey = 0; ey < r.ny; ++ey) {
      result.mesh.jacobians.push_back({hx, r.slant * hy, 0.0, hy});
      for (int b = 0; b <= p; ++b) {
        for (int a = 0; a <= p; ++a) {
          const int column = (ex * p + a) % columns, row = (ey * p + b) % rows;
          const auto node = static_cast<std::uint32_t>(column * rows + row);
          result.mesh.nodes.push_back(node);
          if (ex * p + a >= columns || ey * p + b >= rows) continue;
          result.y[node] = (ey + rule.points[b]) * hy;
          result.x[node] = (ex + rule.points[a]) * hx + r.slant * result.y[node];
        }
      }
    }
  }
  return result;
}

/// Interleaved nodal values of a displacement field, with the zero of the padding node.
inline std::vector<double> interpolate(const RectangleMesh& mesh,
                                       const std::function<double(double, double)>& ux,
                                       const std::function<double(double, double)>& uy) {
  std::vector<double> u(2 * (mesh.mesh.node_count + 1), 0.0);
  for (std::size_t node = 0; node < mesh.mesh.node_count; ++node) {
    u[2 * node] = ux(mesh.x[node], mesh.y[node]);
    u[2 * node + 1] = uy(mesh.x[node], mesh.y[node]);
  }
  return u;
}

/// Inverse lumped mass of both components of every node; the padding node does not move.
inline std::vector<double> free_inverse_mass(const ElasticOperator& stiffness) {
  std::vector<double> inverse(stiffness.vector_size(), 0.0);
  for (std::size_t node = 0; node < stiffness.node_count(); ++node) {
    inverse[2 * node] = inverse[2 * node + 1] = 1.0 / stiffness.mass()[node];
  }
  return inverse;
}

}  // namespace ddem::fem::test
