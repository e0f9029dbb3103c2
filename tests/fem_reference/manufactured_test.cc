// Manufactured solutions with loads: at rest on general quadrilaterals, and in time under a load that acts for a while.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/core/time_filter.h"
#include "fem_reference/kernel/critical_step.h"
#include "fem_reference/kernel/leapfrog.h"
#include "tests/fem_reference/dense.h"
#include "tests/fem_reference/rectangle_mesh.h"

namespace ddem::fem {
namespace {

using std::numbers::pi;

const PlaneMaterial material = plane_material(1.0, 0.3, 1.0, Plane::stress);

// ux = sin(k x) cos(l y), uy = cos(m x) sin(n y), and the body force -div sigma that holds it.
struct Solution {
  double k = 1.1, l = 0.7, m = 0.6, n = 1.3;

  double ux(double x, double y) const { return std::sin(k * x) * std::cos(l * y); }
  double uy(double x, double y) const { return std::cos(m * x) * std::sin(n * y); }
  // (lambda + 2 mu) ux_xx + mu ux_yy + (lambda + mu) uy_xy, and the same with x and y exchanged.
  double fx(double x, double y) const {
    const double p = material.lame_lambda + 2.0 * material.shear_modulus, s = material.shear_modulus;
    return (p * k * k + s * l * l) * ux(x, y) + (p - s) * m * n * std::sin(m * x) * std::cos(n * y);
  }
  double fy(double x, double y) const {
    const double p = material.lame_lambda + 2.0 * material.shear_modulus, s = material.shear_modulus;
    return (p * n * n + s * m * m) * uy(x, y) + (p - s) * k * l * std::cos(k * x) * std::sin(l * y);
  }
};

// Root of the integral of the squared error over the square with its edges prescribed.
double static_error(int degree, int elements) {
  const auto mesh = test::make_rectangle({.length = 2.0, .height = 2.0, .nx = elements, .ny = elements, .degree = degree, .distortion = 0.4});
  const ElasticOperator stiffness(mesh.mesh, material);
  const Solution s;
  auto exact = test::interpolate(mesh, [&](double x, double y) { return s.ux(x, y); }, [&](double x, double y) { return s.uy(x, y); });
  auto force = test::interpolate(mesh, [&](double x, double y) { return s.fx(x, y); }, [&](double x, double y) { return s.fy(x, y); });
  std::vector<bool> fixed(exact.size(), true);
  for (std::size_t node = 0; node < mesh.mesh.node_count; ++node) {
    const double x = mesh.x[node], y = mesh.y[node];
    const bool edge = std::min({x, y, 2.0 - x, 2.0 - y}) < 1e-9;
    for (const std::size_t k : {2 * node, 2 * node + 1}) {
      force[k] *= stiffness.mass()[node];  // of density 1: the quadrature's weight
      fixed[k] = edge;
    }
  }
  const auto u = test::solve_statics(stiffness, force, fixed, exact);
  double error2 = 0.0;
  for (std::size_t node = 0; node < mesh.mesh.node_count; ++node) {
    error2 += stiffness.mass()[node] * (std::pow(u[2 * node] - exact[2 * node], 2) + std::pow(u[2 * node + 1] - exact[2 * node + 1], 2));
  }
  return std::sqrt(error2);
}

class Manufactured : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Degrees, Manufactured, testing::Range(1, max_degree + 1));

TEST_P(Manufactured, StaticLoadOnGeneralQuadrilateralsConverges) {
  const int p = GetParam(), coarse = p <= 2 ? 6 : p <= 5 ? 3 : 2;
  const double error = static_error(p, coarse), finer = static_error(p, 2 * coarse);
  // The order of the interpolation, p + 1, or better (measured: 1.98, 3.8, 4.5, 5.5, 6.6, 7.0, 8.0, 8.95).
  EXPECT_GT(std::log2(error / finer), p + 0.8) << error << " " << finer;
}

TEST_P(Manufactured, LoadThatActsForAWhileMovesAModeAsAnOscillator) {
  // Body force g(t) cos(k x) along y between periodic edges, density 1: uy = cos(k x) q(t), q'' + w^2 q = g, w = c_s k.
  const int p = GetParam(), elements = p == 1 ? 60 : p == 2 ? 20 : 10;
  const auto mesh = test::make_rectangle({.length = 1.0, .height = 0.1, .nx = elements, .ny = 1, .degree = p, .periodic_y = true});
  const ElasticOperator stiffness(mesh.mesh, material);
  const auto inverse_mass = test::free_inverse_mass(stiffness);
  const double dt = 0.99 * critical_time_step(stiffness, inverse_mass), k = 2.0 * pi, w = k * std::sqrt(material.shear_modulus);
  const auto shape = test::interpolate(mesh, [](double, double) { return 0.0; }, [&](double x, double) { return std::cos(k * x); });
  const Sin2 pulse{1.3};
  const double t = 2.7, W = 2.0 * pi / pulse.duration;
  // q after the pulse: the response to (1 - cos(W s))/2 from 0 less the same from the pulse's end on.
  const auto response = [&](double s) {
    return 0.5 * ((1.0 - std::cos(w * s)) / (w * w) - (std::cos(W * s) - std::cos(w * s)) / (w * w - W * W));
  };
  const double q = response(t) - response(t - pulse.duration);
  ASSERT_LE(dt, largest_step_for(pulse));
  std::vector<double> a(states_for(t, dt)), u(shape.size(), 0.0);
  drive_coefficients(pulse, {&t, 1}, dt, a);
  Leapfrog leapfrog(stiffness, inverse_mass, {shape, {}}, dt);
  for (const double coefficient : a) {
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += coefficient * leapfrog.displacement()[i];
    leapfrog.step();
  }
  double error = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) error = std::max(error, std::abs(u[i] - q * shape[i]));
  // What is left is the elements' error of the frequency, (k h/p)^(2p) over 6 radians of phase, and that the interpolated
  // shape is no exact mode of theirs, of order p + 3 and more (measured below 0.2 of the bound). Round-off of a thousand
  // states: 1e-13.
  const double per_node = k / (elements * p);
  EXPECT_LT(error, std::abs(q) * (std::pow(per_node, std::min(2 * p, p + 3)) + 1e-12));
}

}  // namespace
}  // namespace ddem::fem
