#pragma once
// A structured mesh of a rectangle (or of the parallelogram that a shear makes of it), with its coordinates,
// for tests of the kernel without deal.II or gmsh.

#include <array>
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
  /// Vertices are moved by a wave along either direction whose slope is up to this: general quadrilaterals. For meshes
  /// without periodic edges and slant.
  double distortion = 0.0;
};

struct RectangleMesh {
  ElementMesh mesh;
  std::vector<double> x, y;  ///< of each node
};

/// The mesh of `r` without distortion, moved: positions and Jacobians of bilinear elements at their points.
inline void distort(const Rectangle& r, RectangleMesh& result) {
  const GaussLobatto rule = gauss_lobatto(r.degree);
  const double hx = r.length / r.nx, hy = r.height / r.ny;
  using Point = std::array<double, 2>;
  const auto vertex = [&](int i, int j) -> Point {
    const double edge = (i % r.nx == 0 || j % r.ny == 0) ? 0.0 : r.distortion / M_PI;
    const double wave = edge * std::sin(M_PI * i / r.nx) * std::sin(M_PI * j / r.ny);
    return {i * hx + wave * r.length, j * hy - 0.6 * wave * r.height};
  };
  std::size_t place = 0;
  result.mesh.jacobians.clear();
  for (int ex = 0; ex < r.nx; ++ex) {
    for (int ey = 0; ey < r.ny; ++ey) {
      const Point v[4] = {vertex(ex, ey), vertex(ex + 1, ey), vertex(ex, ey + 1), vertex(ex + 1, ey + 1)};
      for (int b = 0; b <= r.degree; ++b) {
        for (int a = 0; a <= r.degree; ++a, ++place) {
          const double xi = rule.points[a], eta = rule.points[b];
          std::array<double, 4> jacobian{};
          Point position{};
          for (int c = 0; c < 2; ++c) {
            const double along = (v[1][c] - v[0][c]) * (1.0 - eta) + (v[3][c] - v[2][c]) * eta;
            const double across = (v[2][c] - v[0][c]) * (1.0 - xi) + (v[3][c] - v[1][c]) * xi;
            jacobian[2 * c] = along;
            jacobian[2 * c + 1] = across;
            position[c] = v[0][c] + xi * (v[1][c] - v[0][c]) + eta * across;
          }
          result.mesh.jacobians.push_back(jacobian);
          result.x[result.mesh.nodes[place]] = position[0];
          result.y[result.mesh.nodes[place]] = position[1];
        }
      }
    }
  }
}

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
  if (r.distortion > 0.0) distort(r, result);
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
