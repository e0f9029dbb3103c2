#include "fem_reference/kernel/node_strains.h"

#include <array>

#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem {
namespace {

/// d(ux, ux, uy, uy)/d(xi, eta, xi, eta) at point (a, b) of an element whose nodes are given.
std::array<double, 4> reference_slopes(const GaussLobatto& rule, std::span<const std::uint32_t> nodes, std::span<const double> u,
                                       std::size_t a, std::size_t b) {
  const std::size_t n = rule.points.size();
  std::array<double, 4> slopes{};
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t along = nodes[b * n + k], across = nodes[k * n + a];
    for (std::size_t c = 0; c < 2; ++c) {
      slopes[2 * c] += rule.derivative[a * n + k] * u[2 * along + c];
      slopes[2 * c + 1] += rule.derivative[b * n + k] * u[2 * across + c];
    }
  }
  return slopes;
}

}  // namespace

NodeTensor node_strains(const ElementMesh& mesh, std::span<const double> u) {
  const GaussLobatto rule = gauss_lobatto(mesh.degree);
  const std::size_t n = rule.points.size(), points = mesh.points_per_element();
  std::vector<double> xx(mesh.node_count, 0.0), weight = xx;
  NodeTensor strain{xx, xx, xx};
  for (std::size_t element = 0; element < mesh.element_count(); ++element) {
    const std::span<const std::uint32_t> nodes(mesh.nodes.data() + element * points, points);
    for (std::size_t point = 0; point < points; ++point) {
      const std::size_t a = point % n, b = point / n;
      const std::array<double, 4>& j = mesh.jacobians[mesh.affine() ? element : element * points + point];
      const auto [x_xi, x_eta, y_xi, y_eta] = reference_slopes(rule, nodes, u, a, b);
      // du/dx det J = du/dxi dy/deta - du/deta dy/dxi, du/dy det J = du/deta dx/dxi - du/dxi dx/deta; the weight has det J, too.
      const double w = rule.weights[a] * rule.weights[b];
      const std::uint32_t node = nodes[point];
      strain.xx[node] += w * (x_xi * j[3] - x_eta * j[2]);
      strain.yy[node] += w * (y_eta * j[0] - y_xi * j[1]);
      strain.xy[node] += 0.5 * w * (x_eta * j[0] - x_xi * j[1] + y_xi * j[3] - y_eta * j[2]);
      weight[node] += w * (j[0] * j[3] - j[1] * j[2]);
    }
  }
  for (std::size_t node = 0; node < mesh.node_count; ++node) {
    for (std::vector<double>* component : {&strain.xx, &strain.yy, &strain.xy}) (*component)[node] /= weight[node];
  }
  return strain;
}

NodeTensor stresses(const NodeTensor& strain, const PlaneMaterial& material) {
  NodeTensor stress = strain;
  const double twice_shear = 2.0 * material.shear_modulus;
  for (std::size_t node = 0; node < strain.xx.size(); ++node) {
    const double mean = material.lame_lambda * (strain.xx[node] + strain.yy[node]);
    stress.xx[node] = mean + twice_shear * strain.xx[node];
    stress.yy[node] = mean + twice_shear * strain.yy[node];
    stress.xy[node] = twice_shear * strain.xy[node];
  }
  return stress;
}

}  // namespace ddem::fem
