// The element kernel against what elasticity demands of any stiffness matrix: no force in rigid motion,
// symmetry, exact energy of uniform strain; all degrees, straight and slanted elements, all instruction sets.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "fem_reference/kernel/elastic_operator.h"
#include "fem_reference/kernel/gauss_lobatto.h"
#include "fem_reference/kernel/node_strains.h"
#include "tests/fem_reference/rectangle_mesh.h"

namespace ddem::fem {
namespace {

using test::interpolate;
using test::make_rectangle;
using test::Rectangle;

const PlaneMaterial material = plane_material(1e10, 0.3, 1700.0, Plane::stress);

std::vector<double> random_vector(std::size_t size) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> values(size);
  for (double& value : values) value = uniform(generator);
  values[size - 2] = values[size - 1] = 0.0;
  return values;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::vector<double> times(const ElasticOperator& stiffness, const std::vector<double>& u) {
  std::vector<double> f(stiffness.vector_size());
  stiffness.apply(u, f);
  return f;
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

class Kernel : public testing::TestWithParam<int> {
 protected:
  // 3 x 5 = 15 elements: the second batch of 8 has an empty lane.
  const Rectangle rectangle{
      .length = 0.6, .height = 0.7, .nx = 3, .ny = 5, .degree = GetParam(), .slant = 0.4};
};
INSTANTIATE_TEST_SUITE_P(Degrees, Kernel, testing::Range(1, max_degree + 1));

TEST_P(Kernel, QuadratureIsExactToItsOrderAndSlopesOfPolynomialsAreExact) {
  const int p = GetParam();
  const GaussLobatto rule = gauss_lobatto(p);
  for (int power = 0; power <= 2 * p - 1; ++power) {
    double integral = 0.0;
    for (int q = 0; q <= p; ++q) integral += rule.weights[q] * std::pow(rule.points[q], power);
    EXPECT_NEAR(integral, 1.0 / (power + 1), 1e-15) << "x^" << power;
  }
  double beyond = 0.0;  // x^(2p) is the first that fails
  for (int q = 0; q <= p; ++q) beyond += rule.weights[q] * std::pow(rule.points[q], 2 * p);
  EXPECT_GT(std::abs(beyond - 1.0 / (2 * p + 1)), 1e-10);
  for (int q = 0; q <= p; ++q) {
    double slope = 0.0;
    for (int k = 0; k <= p; ++k) slope += rule.derivative[q * (p + 1) + k] * std::pow(rule.points[k], p);
    EXPECT_NEAR(slope, p * std::pow(rule.points[q], p - 1), 1e-12);
  }
}

TEST_P(Kernel, RigidMotionHasNoForce) {
  const auto mesh = make_rectangle(rectangle);
  const ElasticOperator stiffness(mesh.mesh, material);
  const auto rigid = interpolate(
      mesh, [](double, double y) { return 0.3 - 0.7 * y; }, [](double x, double) { return -0.2 + 0.7 * x; });
  const auto uniform = interpolate(
      mesh, [](double x, double) { return 0.7 * x; }, [](double, double) { return 0.0; });
  // Round-off of the largest terms that cancel, against a strain of the same size as the rotation.
  EXPECT_LT(largest(times(stiffness, rigid)), 1e-12 * largest(times(stiffness, uniform)));
}

TEST_P(Kernel, GeneralQuadrilateralsPassThePatchTest) {
  Rectangle distorted = rectangle;
  distorted.slant = 0.0;
  distorted.distortion = 0.4;
  const auto mesh = make_rectangle(distorted);
  ASSERT_FALSE(mesh.mesh.affine());
  const ElasticOperator stiffness(mesh.mesh, material);
  const double exx = 1e-3, eyy = -4e-4, exy = 7e-4;
  const auto u = interpolate(
      mesh, [&](double x, double y) { return exx * x + (exy - 0.3) * y; },
      [&](double x, double y) { return eyy * y + (exy + 0.3) * x; });
  const double trace = exx + eyy, squares = exx * exx + eyy * eyy + 2.0 * exy * exy;
  const double area = distorted.length * distorted.height;
  const double energy = area * (0.5 * material.lame_lambda * trace * trace + material.shear_modulus * squares);
  const auto force = times(stiffness, u);
  // The rotation of 0.3 is 400 times the strain: its forces cancel to 400 times the round-off.
  EXPECT_NEAR(0.5 * dot(u, force), energy, 1e-9 * energy);
  for (std::size_t node = 0; node < mesh.mesh.node_count; ++node) {
    const double x = mesh.x[node], y = mesh.y[node];
    if (std::min({x, y, distorted.length - x, distorted.height - y}) < 1e-9) continue;
    EXPECT_LT(std::hypot(force[2 * node], force[2 * node + 1]), 1e-9 * largest(force));
  }
  const double total = std::accumulate(stiffness.mass().begin(), stiffness.mass().end(), 0.0);
  EXPECT_NEAR(total, material.density * area, 1e-13 * material.density * area);
  const auto random = random_vector(stiffness.vector_size());
  auto other = random;
  std::reverse(other.begin(), other.end() - 2);
  EXPECT_NEAR(dot(random, times(stiffness, other)), dot(other, times(stiffness, random)),
              1e-13 * dot(random, times(stiffness, random)));
  for (const auto set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!is_available(set)) continue;
    EXPECT_EQ(times(ElasticOperator(mesh.mesh, material, set), u), force);
  }
}

TEST_P(Kernel, NodesHaveTheStrainOfAUniformField) {
  Rectangle distorted = rectangle;
  distorted.slant = 0.0;
  distorted.distortion = 0.4;
  const double exx = 1e-3, eyy = -4e-4, exy = 7e-4;
  for (const auto& mesh : {make_rectangle(rectangle), make_rectangle(distorted)}) {
    const auto u = interpolate(
        mesh, [&](double x, double y) { return exx * x + (exy - 0.3) * y; },
        [&](double x, double y) { return eyy * y + (exy + 0.3) * x; });
    const NodeTensor strain = node_strains(mesh.mesh, u), stress = stresses(strain, material);
    // Slopes of 0.3 from differences of a dozen values of 0.2 over elements of 0.14: round-off of 1e-13 or so.
    for (std::size_t node = 0; node < mesh.mesh.node_count; ++node) {
      ASSERT_NEAR(strain.xx[node], exx, 1e-12);
      ASSERT_NEAR(strain.yy[node], eyy, 1e-12);
      ASSERT_NEAR(strain.xy[node], exy, 1e-12);
      // Plane stress, E = 10 GPa, nu = 0.3: E/(1 - nu^2) (exx + nu eyy) and so on, E/(1 + nu) exy; 1e-12 of strain is 0.01 Pa.
      ASSERT_NEAR(stress.xx[node], 1e10 / 0.91 * (exx + 0.3 * eyy), 0.05);
      ASSERT_NEAR(stress.yy[node], 1e10 / 0.91 * (eyy + 0.3 * exx), 0.05);
      ASSERT_NEAR(stress.xy[node], 1e10 / 1.3 * exy, 0.05);
    }
  }
}

// Of a plane wave across it the strain at the nodes converges with the degree, p: halving the elements takes 2^-p of the error.
TEST_P(Kernel, StrainsOfAPlaneWaveConvergeWithTheDegree) {
  const double k1 = 5.0, k2 = -3.0;
  const auto error = [&](int n) {
    const auto mesh = make_rectangle({.length = 1.0, .height = 1.0, .nx = n, .ny = n, .degree = GetParam(), .slant = 0.2});
    const auto u = interpolate(
        mesh, [&](double x, double y) { return std::sin(k1 * x + k2 * y); },
        [&](double x, double y) { return 0.5 * std::cos(k1 * x + k2 * y); });
    const NodeTensor strain = node_strains(mesh.mesh, u);
    double sum = 0.0, square = 0.0;
    for (std::size_t node = 0; node < mesh.mesh.node_count; ++node) {
      const double phase = k1 * mesh.x[node] + k2 * mesh.y[node];
      const double xx = k1 * std::cos(phase), yy = -0.5 * k2 * std::sin(phase);
      const double xy = 0.5 * (k2 * std::cos(phase) - 0.5 * k1 * std::sin(phase));
      sum += std::pow(strain.xx[node] - xx, 2) + std::pow(strain.yy[node] - yy, 2) + 2.0 * std::pow(strain.xy[node] - xy, 2);
      square += xx * xx + yy * yy + 2.0 * xy * xy;
    }
    return std::sqrt(sum / square);
  };
  const int n = GetParam() > 4 ? 3 : 8;
  const double order = std::log2(error(n) / error(2 * n));
  // At least p; the mean of both sides may cancel the leading term (the odd degrees inside do), which adds up to one.
  EXPECT_GT(order, GetParam() - 0.15);
  EXPECT_LT(error(2 * n), 0.1);
}

TEST_P(Kernel, RectanglesAndParallelogramsMayBeGivenPointByPoint) {
  for (const double slant : {rectangle.slant, 0.0}) {
    Rectangle r = rectangle;
    r.slant = slant;
    const auto mesh = make_rectangle(r);
    auto by_point = mesh.mesh;
    by_point.jacobians.clear();
    for (const auto& jacobian : mesh.mesh.jacobians) {
      by_point.jacobians.insert(by_point.jacobians.end(), by_point.points_per_element(), jacobian);
    }
    const ElasticOperator stiffness(mesh.mesh, material), general(by_point, material);
    const auto u = random_vector(stiffness.vector_size());
    EXPECT_EQ(times(general, u), times(stiffness, u));  // terms that vanish, written out or not, change no bit
    EXPECT_EQ(general.mass(), stiffness.mass());
  }
}

TEST_P(Kernel, StiffnessIsSymmetric) {
  const auto mesh = make_rectangle(rectangle);
  const ElasticOperator stiffness(mesh.mesh, material);
  const auto u = random_vector(stiffness.vector_size());
  auto v = u;
  std::reverse(v.begin(), v.end() - 2);
  const double uv = dot(v, times(stiffness, u)), vu = dot(u, times(stiffness, v));
  EXPECT_NEAR(uv, vu, 1e-13 * dot(u, times(stiffness, u)));
}

TEST_P(Kernel, UniformStrainHasItsEnergyAndNoForceInside) {
  const auto mesh = make_rectangle(rectangle);
  const ElasticOperator stiffness(mesh.mesh, material);
  const double exx = 1e-3, eyy = -4e-4, exy = 7e-4;  // tensor shear
  const auto u = interpolate(
      mesh, [&](double x, double y) { return exx * x + 2.0 * exy * y; },
      [&](double, double y) { return eyy * y; });
  const double trace = exx + eyy, squares = exx * exx + eyy * eyy + 2.0 * exy * exy;
  const double area = rectangle.length * rectangle.height;
  const double energy =
      area * (0.5 * material.lame_lambda * trace * trace + material.shear_modulus * squares);
  const auto force = times(stiffness, u);
  EXPECT_NEAR(0.5 * dot(u, force), energy, 1e-13 * energy);
  for (std::size_t node = 0; node < mesh.mesh.node_count; ++node) {
    const double y = mesh.y[node], x = mesh.x[node] - rectangle.slant * y;
    const bool edge = std::min({x, y, rectangle.length - x, rectangle.height - y}) < 1e-9;
    if (edge) continue;
    EXPECT_LT(std::hypot(force[2 * node], force[2 * node + 1]), 1e-11 * largest(force));
  }
}

TEST_P(Kernel, MassIsDensityTimesArea) {
  const auto mesh = make_rectangle(rectangle);
  const ElasticOperator stiffness(mesh.mesh, material);
  const double total = std::accumulate(stiffness.mass().begin(), stiffness.mass().end(), 0.0);
  const double expected = material.density * rectangle.length * rectangle.height;
  EXPECT_NEAR(total, expected, 1e-13 * expected);
}

TEST_P(Kernel, EveryInstructionSetGivesTheSameBits) {
  for (const double slant : {rectangle.slant, 0.0}) {
    Rectangle r = rectangle;
    r.slant = slant;
    const auto mesh = make_rectangle(r);
    const ElasticOperator baseline(mesh.mesh, material, InstructionSet::baseline);
    const auto u = random_vector(baseline.vector_size());
    const auto expected = times(baseline, u);
    for (const auto set : {InstructionSet::avx2, InstructionSet::avx512}) {
      if (!is_available(set)) continue;
      EXPECT_EQ(times(ElasticOperator(mesh.mesh, material, set), u), expected);
    }
  }
}

TEST_P(Kernel, AnyNumberOfThreadsGivesTheSameBits) {
  Rectangle larger = rectangle;
  larger.nx = 40;
  const auto mesh = make_rectangle(larger);
  ElasticOperator stiffness(mesh.mesh, material);
  const auto u = random_vector(stiffness.vector_size());
  const auto expected = times(stiffness, u);
  for (const int threads : {2, 3, 7}) {
    Team team(threads);
    stiffness.use(team);
    for (int repeat = 0; repeat < 3; ++repeat) ASSERT_EQ(times(stiffness, u), expected) << threads;
  }
}

TEST_P(Kernel, PeriodicNodesAreOneNode) {
  // A field of the period's own wavelength: the periodic mesh must give the force of the middle of three
  // copies.
  Rectangle one = rectangle;
  one.slant = 0.0;
  one.periodic_y = true;
  Rectangle three = one;
  three.periodic_y = false;
  three.ny *= 3;
  three.height *= 3.0;
  const auto wave = [&](double x, double y) { return x * x + std::sin(2.0 * M_PI * y / one.height); };
  const auto merged = make_rectangle(one), copies = make_rectangle(three);
  const auto force = times(ElasticOperator(merged.mesh, material), interpolate(merged, wave, wave));
  const auto long_force = times(ElasticOperator(copies.mesh, material), interpolate(copies, wave, wave));
  const std::size_t rows = one.ny * one.degree, long_rows = 3 * rows + 1;
  for (std::size_t node = 0; node < merged.mesh.node_count; ++node) {
    const std::size_t copy = node / rows * long_rows + rows + node % rows;
    EXPECT_NEAR(force[2 * node], long_force[2 * copy], 1e-11 * largest(force));
    EXPECT_NEAR(force[2 * node + 1], long_force[2 * copy + 1], 1e-11 * largest(force));
  }
}

TEST(PlaneMaterial, HasThePlaneModuliOfTheory) {
  // 2K = E/(1-nu), 2G = E/(1+nu) in plane stress; K = lambda + mu of the plane.
  const PlaneMaterial stress = plane_material(7e9, 0.22, 1.0, Plane::stress);
  EXPECT_NEAR(2.0 * (stress.lame_lambda + stress.shear_modulus), 7e9 / 0.78, 1e-3);
  EXPECT_NEAR(2.0 * stress.shear_modulus, 7e9 / 1.22, 1e-3);
  // Plane strain: P-wave modulus E (1-nu)/((1+nu)(1-2nu)), the same shear modulus.
  const PlaneMaterial strain = plane_material(7e9, 0.22, 1.0, Plane::strain);
  EXPECT_NEAR(strain.lame_lambda + 2.0 * strain.shear_modulus, 7e9 * 0.78 / (1.22 * 0.56), 1e-3);
  EXPECT_NEAR(strain.shear_modulus, stress.shear_modulus, 1e-3);
}

TEST(PlaneMaterial, RefusesWhatIsUnstable) {
  EXPECT_THROW(plane_material(-1.0, 0.3, 1.0, Plane::stress), std::invalid_argument);
  EXPECT_THROW(plane_material(1.0, 1.0, 1.0, Plane::stress), std::invalid_argument);
  EXPECT_THROW(plane_material(1.0, 0.5, 1.0, Plane::strain), std::invalid_argument);
  EXPECT_THROW(plane_material(1.0, 0.3, NAN, Plane::strain), std::invalid_argument);
}

TEST(Operator, RefusesBrokenMeshes) {
  auto mesh = make_rectangle({.degree = 2}).mesh;
  auto turned = mesh, short_list = mesh, stray = mesh, lonely = mesh;
  turned.jacobians[0] = {1.0, 0.0, 0.0, -1.0};
  short_list.nodes.pop_back();
  stray.nodes[3] = 9;
  lonely.node_count = 10;
  for (const auto& broken : {turned, short_list, stray, lonely}) {
    EXPECT_THROW(ElasticOperator(broken, material), std::invalid_argument);
  }
  EXPECT_THROW(gauss_lobatto(0), std::invalid_argument);
  EXPECT_THROW(gauss_lobatto(9), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::fem
