// Largest eigenvalue, eigenfrequencies, order of convergence, energy and stability of the semi-discrete and
// the discrete equations of motion.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>

#include "dem/spectra/dense_eigen.h"
#include "fem_reference/kernel/critical_step.h"
#include "fem_reference/kernel/leapfrog.h"
#include "tests/fem_reference/rectangle_mesh.h"

namespace ddem::fem {
namespace {

using std::numbers::pi;
using test::free_inverse_mass;
using test::interpolate;
using test::make_rectangle;
using test::Rectangle;
using test::RectangleMesh;

const PlaneMaterial material = plane_material(1e10, 0.3, 1700.0, Plane::stress);
const double shear_speed = std::sqrt(material.shear_modulus / material.density);

double nothing(double, double) {
  return 0.0;
}

Eigen::MatrixXd dense_stiffness(const ElasticOperator& stiffness) {
  const auto size = static_cast<Eigen::Index>(2 * stiffness.node_count());
  Eigen::MatrixXd dense(size, size);
  std::vector<double> u(stiffness.vector_size(), 0.0), f(u.size());
  for (Eigen::Index k = 0; k < size; ++k) {
    u[k] = 1.0;
    stiffness.apply(u, f);
    dense.col(k) = Eigen::Map<const Eigen::VectorXd>(f.data(), size);
    u[k] = 0.0;
  }
  return dense;
}

// Of D^-1/2 A D^-1/2, ascending; `inverse` holds the diagonal of D^-1.
Eigen::VectorXd eigenvalues(Eigen::MatrixXd a, const std::vector<double>& inverse) {
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    for (Eigen::Index row = 0; row < a.rows(); ++row)
      a(row, column) *= std::sqrt(inverse[row] * inverse[column]);
  }
  return ddem::symmetric_eigenvalues(a, "time stepping");
}

class CriticalStep : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Degrees, CriticalStep, testing::Values(1, 2, 4, 8));

TEST_P(CriticalStep, IsSharpAndSafeAgainstDenseEigenvalues) {
  const int p = GetParam(), cells = p > 4 ? 2 : 4;
  const auto mesh =
      make_rectangle({.length = 0.01, .height = 0.006, .nx = cells, .ny = cells, .degree = p, .slant = 0.2});
  const ElasticOperator stiffness(mesh.mesh, material);
  auto inverse_mass = free_inverse_mass(stiffness);
  for (int k = 0; k < 2 * p; ++k) inverse_mass[k] = 0.0;  // part of the left edge is fixed
  const double exact = eigenvalues(dense_stiffness(stiffness), inverse_mass).maxCoeff();
  const double bound = largest_squared_frequency(stiffness, inverse_mass);
  EXPECT_GE(bound, exact * (1.0 - 1e-12));
  EXPECT_LE(bound, exact * (1.0 + 2.0 * eigenvalue_tolerance));
  EXPECT_DOUBLE_EQ(critical_time_step(stiffness, inverse_mass), 2.0 / std::sqrt(bound));
}

TEST_P(CriticalStep, OfPiecesIsSafeAndSharpWhereAnEndIsFree) {
  const unsigned nx = 19, ny = 3;  // pieces of 9 and 10
  for (const bool periodic : {false, true}) {
    const auto mesh = make_rectangle(
        {.length = 0.019, .height = 0.003, .nx = nx, .ny = ny, .degree = GetParam(), .periodic_y = periodic});
    const ElasticOperator stiffness(mesh.mesh, material);
    auto inverse_mass = free_inverse_mass(stiffness);
    for (std::size_t node = 0; node < stiffness.node_count(); ++node) {
      if (mesh.x[node] > 0.019 - 1e-9) inverse_mass[2 * node] = 0.0;
    }
    const double whole = critical_time_step(stiffness, inverse_mass);
    Team one(1), three(3);
    const RectangleStrip strip{GetParam(), nx, ny, 1e-3, 1e-3, periodic};
    const double pieces = critical_time_step(strip, material, one);
    EXPECT_EQ(critical_time_step(strip, material, three), pieces);
    // Both are from below, and Lanczos leaves half of its tolerance to either. What the cut leaves was measured in 144
    // strips, at most 1.5e-3: short waves of low degrees that fit the whole better than its pieces.
    EXPECT_LT(pieces, whole * (1.0 + eigenvalue_tolerance)) << periodic;
    EXPECT_GT(pieces, whole * (1.0 - 1.5e-3)) << periodic;
  }
}

TEST(CriticalStep, OfBilinearElementsHasAClosedForm) {
  // Degree 1, Gauss-Lobatto points, nu = 0: at the checkerboard of ux alone on square elements every slope is
  // 2/h; the element's energy 1/2 h^2 (E + G)(2/h)^2 over its mass rho h^2 u'^2/2 gives omega^2 = 4 (E +
  // G)/(rho h^2).
  const int cells = 8;
  const double h = 1e-3;
  const PlaneMaterial uncoupled = plane_material(1e10, 0.0, 1700.0, Plane::stress);
  const auto mesh = make_rectangle({.length = cells * h,
                                    .height = cells * h,
                                    .nx = cells,
                                    .ny = cells,
                                    .degree = 1,
                                    .periodic_x = true,
                                    .periodic_y = true});
  const ElasticOperator stiffness(mesh.mesh, uncoupled);
  const double exact = 4.0 * (1e10 + uncoupled.shear_modulus) / (1700.0 * h * h);
  const double bound = largest_squared_frequency(stiffness, free_inverse_mass(stiffness));
  EXPECT_NEAR(bound / exact, 1.0, 2.0 * eigenvalue_tolerance);
}

// Relative error of the frequency of uy = cos(pi half_waves x) in a strip of length 1 with periodic edges,
// exactly c_s pi half_waves: the stiffness restricted to uy(x), where each column of nodes moves as one.
double shear_mode_error(int degree, int elements, int half_waves) {
  const auto mesh = make_rectangle({.nx = elements, .ny = 1, .degree = degree, .periodic_y = true});
  const ElasticOperator stiffness(mesh.mesh, material);
  const int columns = elements * degree + 1;
  std::vector<double> u(stiffness.vector_size()), f(u.size());
  Eigen::MatrixXd reduced(columns, columns);
  std::vector<double> inverse_mass(columns);
  const auto row = [&](int column, int k) { return static_cast<std::size_t>(column * degree + k); };
  for (int c = 0; c < columns; ++c) {
    std::fill(u.begin(), u.end(), 0.0);
    double mass = 0.0;
    for (int k = 0; k < degree; ++k) {
      u[2 * row(c, k) + 1] = 1.0;
      mass += stiffness.mass()[row(c, k)];
    }
    inverse_mass[c] = 1.0 / mass;
    stiffness.apply(u, f);
    for (int other = 0; other < columns; ++other) {
      reduced(other, c) = 0.0;
      for (int k = 0; k < degree; ++k) reduced(other, c) += f[2 * row(other, k) + 1];
    }
  }
  const double eigenvalue = eigenvalues(reduced, inverse_mass)[half_waves];
  return std::abs(std::sqrt(eigenvalue) / (shear_speed * pi * half_waves) - 1.0);
}

class ShearMode : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Degrees, ShearMode, testing::Range(1, max_degree + 1));

// The order that three meshes show as h -> 0: between two of them it is 2p + s <h^2>, the next term of the error, with
// <h^2> = (h_1^2 - h_2^2)/ln(h_1^2/h_2^2); s is eliminated.
double extrapolated_order(const std::array<int, 3>& elements, const std::array<double, 3>& errors) {
  std::array<double, 2> order, h2;
  for (std::size_t k = 0; k < 2; ++k) {
    const double log_ratio = std::log(double(elements[k + 1]) / elements[k]);
    order[k] = std::log(errors[k] / errors[k + 1]) / log_ratio;
    h2[k] = (std::pow(elements[k], -2) - std::pow(elements[k + 1], -2)) / (2.0 * log_ratio);
  }
  return order[1] - (order[0] - order[1]) * h2[1] / (h2[0] - h2[1]);
}

TEST_P(ShearMode, FrequencyConvergesWithTwiceTheDegree) {
  // Frequencies of spectral elements converge as h^(2p). Mode and meshes are chosen so that the finest error is still
  // well above the round-off of the eigenvalues, 1e-14. Measured: within 0.03 for all degrees.
  const int p = GetParam();
  const int half_waves = p <= 5 ? 2 : p == 6 ? 6 : 11;
  const std::array<int, 3> meshes = p <= 4   ? std::array{4, 6, 8}
                                    : p == 5 ? std::array{4, 5, 6}
                                    : p == 6 ? std::array{8, 10, 12}
                                             : std::array{6, 8, 10};
  std::array<double, 3> errors{};
  for (std::size_t k = 0; k < 3; ++k) errors[k] = shear_mode_error(p, meshes[k], half_waves);
  EXPECT_NEAR(extrapolated_order(meshes, errors), 2.0 * p, 0.1) << errors[0] << " " << errors[1] << " " << errors[2];
}

struct Sample {
  RectangleMesh mesh;
  ElasticOperator stiffness;
  std::vector<double> inverse_mass;
  double critical;

  explicit Sample(const Rectangle& rectangle)
      : mesh(make_rectangle(rectangle)),
        stiffness(mesh.mesh, material),
        inverse_mass(free_inverse_mass(stiffness)),
        critical(critical_time_step(stiffness, inverse_mass)) {}
};

const Rectangle bar{.length = 0.01, .height = 0.002, .nx = 10, .ny = 2, .degree = 4};

std::vector<double> pulse(const RectangleMesh& mesh) {
  return interpolate(
      mesh, [](double x, double) { return 1e-6 * std::exp(-std::pow((x - 0.005) / 0.0008, 2)); }, nothing);
}

double largest(std::span<const double> values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

TEST(Leapfrog, KeepsItsInvariantAndTheMomentum) {
  Sample run(bar);
  Leapfrog leapfrog(run.stiffness, run.inverse_mass, {pulse(run.mesh), {}}, 0.7 * run.critical);
  leapfrog.step();
  const double energy = leapfrog.energy();
  double worst = 0.0;
  for (int step = 0; step < 10000; ++step) {
    leapfrog.step();
    if (step % 100 == 0) worst = std::max(worst, std::abs(leapfrog.energy() / energy - 1.0));
  }
  EXPECT_GT(energy, 0.0);
  EXPECT_LT(worst, 1e-12);
}

TEST(Leapfrog, IsStableBelowTheCriticalStepAndBlowsUpAboveIt) {
  Sample run(bar);
  for (const double fraction : {0.99, 1.01}) {
    auto u = pulse(run.mesh);
    u[10] += 1e-9;  // a part in the fastest modes
    Leapfrog leapfrog(run.stiffness, run.inverse_mass, {u, {}}, fraction * run.critical);
    for (int step = 0; step < 2000 && largest(leapfrog.displacement()) < 1.0; ++step) leapfrog.step();
    if (fraction < 1.0) {
      EXPECT_LT(largest(leapfrog.displacement()), 1e-5);
    } else {
      EXPECT_GT(largest(leapfrog.displacement()), 1.0);
    }
  }
}

TEST(Leapfrog, IsOfSecondOrderInTheTimeStep) {
  // A standing shear mode over half a period, where cos(omega t) = -1... is flat: compare after a quarter,
  // where the error of the frequency shows in full. p = 8 makes the error of space 1e-13.
  Sample run({.length = 0.01, .height = 0.001, .nx = 10, .ny = 1, .degree = 8, .periodic_y = true});
  const double k = pi / 0.01, end = 0.5 * pi / (k * shear_speed);
  std::vector<double> errors;
  for (const int steps : {600, 1200}) {
    ASSERT_LT(end / steps, run.critical);
    Leapfrog leapfrog(run.stiffness, run.inverse_mass,
                      {interpolate(run.mesh, nothing, [&](double x, double) { return std::cos(k * x); }), {}},
                      end / steps);
    for (int step = 0; step < steps; ++step) leapfrog.step();
    errors.push_back(largest(leapfrog.displacement()));
    // The frequency errs by (omega dt)^2/24: after a quarter of a period the displacement is that times pi/2.
    EXPECT_NEAR(errors.back(), std::pow(0.5 * pi / steps, 2) / 24.0 * 0.5 * pi, 0.01 * errors.back());
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.05);
}

TEST(Leapfrog, LeavesFixedDegreesOfFreedomAlone) {
  Sample run(bar);
  run.inverse_mass[4] = 0.0;
  Leapfrog leapfrog(run.stiffness, run.inverse_mass, {pulse(run.mesh), {}}, 0.5 * run.critical);
  const double start = leapfrog.displacement()[4];
  for (int step = 0; step < 500; ++step) leapfrog.step();
  EXPECT_EQ(leapfrog.displacement()[4], start);
  EXPECT_GT(std::abs(leapfrog.displacement()[6]), 1e-9);
}

}  // namespace
}  // namespace ddem::fem
