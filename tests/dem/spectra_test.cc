// Critical steps and limits against exact eigenfrequencies and the closed forms of theory section 3.

#include <gtest/gtest.h>

#include <cmath>

#include "dem/spectra/rigid_stiffness.h"
#include "dem/spectra/scheme_stiffness.h"
#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

Assembly lattice() {
  return test::hexagonal_assembly({.columns = 12, .rows = 12, .radius = 1e-3, .periodic_x = true, .periodic_y = true});
}

TEST(LargestFrequency, StripOfTheOracle) {
  // Exact largest eigenfrequencies of the constrained strip, from tests/oracles/README.md.
  const Packing p = test::oracle_packing("hex_strip/discs.csv", {}, 62 * 0.264e-3, 11 * 0.264e-3 * std::sqrt(0.75));
  const Assembly a = make_assembly(p, bonds_within_gap(p, 0.1 * mean_radius(p)), 1.0, test::kDensity);
  HeldDofs held;
  held.x.assign(a.size(), 0);
  for (const int d : edge_discs(p, Edge::right, 1.2 * mean_radius(p))) held.x[d] = 1;
  EXPECT_NEAR(largest_frequency(a, {1e10, 0.0, Kinematics::linear}, held) / 23288562.9875396, 1.0, 1e-6);
  EXPECT_NEAR(largest_frequency(a, {1e10, 0.5, Kinematics::linear}, held) / 32935392.075242645, 1.0, 1e-6);
}

/// Bond by bond what the matrices make of it: with and without rotation, one stiffness and one a bond, held or not.
TEST(RigidStiffness, IsThatOfTheMatrices) {
  const Assembly a = test::random_free_strip();
  HeldDofs some;
  some.x.assign(a.size(), 0), some.y = some.theta = some.x;
  for (std::size_t d = 0; d < a.size(); d += 3) some.x[d] = 1, some.y[(d + 1) % a.size()] = 1, some.theta[(d + 5) % a.size()] = 1;
  for (const double stiffness_ratio : {0.0, 0.3}) {
    for (const double modulus : {0.0, 1e13}) {
      for (const HeldDofs& held : {HeldDofs{}, some}) {
        const ContactParameters contact{1e10, stiffness_ratio, Kinematics::linear, modulus};
        const Operators op = make_operators(a, contact, {});
        const Eigen::VectorXd s = mass_scaling(op, held);
        RigidStiffness stiffness(a, contact, held);
        ASSERT_EQ(stiffness.size(), s.size());
        const std::vector<double> noise = test::Noise(3).vector(static_cast<std::size_t>(s.size()), 1.0);
        const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(noise.data(), s.size());
        const Eigen::VectorXd expected = s.cwiseProduct(op.stiffness_matrix() * s.cwiseProduct(x));
        Eigen::VectorXd y(s.size());
        stiffness.apply(x, y);
        EXPECT_LT((y - expected).norm(), 1e-14 * expected.norm()) << stiffness_ratio << " " << modulus;
      }
    }
  }
}

TEST(LargestFrequency, InfiniteLattice) {
  const Assembly a = lattice();
  EXPECT_NEAR(largest_frequency(a, {1e10, 0.0, Kinematics::linear}, {}), std::sqrt(6.0 * 1e10 / a.mass[0]), 1e-5 * std::sqrt(6.0 * 1e10 / a.mass[0]));
}

TEST(FixedPoint, InfiniteLattice) {
  const Assembly a = lattice();
  for (const double nu : {0.0, 0.3, 0.45}) {
    for (const double lambda : {0.0, 0.5, 1.0}) {
      for (const Correction c : {Correction::normal, Correction::full, Correction::normal_only_stress}) {
        const double ratio = 0.25;
        const DeformationParameters d{Scheme::lagged, c, 1e10 / ratio, nu, Plane::stress};
        const double shear = c == Correction::full ? 1.0 + lambda : 1.0;
        const double limit = std::min(M_PI / (6.0 * (1.0 - nu)), M_PI / (3.0 * (1.0 + nu) * shear));
        EXPECT_NEAR(fixed_point_radius(a, {1e10, lambda, Kinematics::linear}, d), ratio / limit, 1e-6);
      }
    }
  }
}

TEST(FixedPoint, KnownRadius) {
  const DeformationParameters d{Scheme::lagged, Correction::normal, 4e10, 0.3, Plane::stress};
  EXPECT_NEAR(fixed_point_radius(lattice(), {1e10, 0.0, Kinematics::linear}, d), 0.334225, 1e-6);
}

TEST(SmallAssemblies, TwoDiscsAndChains) {
  // A short chain's operators have less rank than Lanczos has vectors, and a wrong answer from it.
  for (const int n : {2, 3, 25, 70}) {
    Packing p;
    for (int d = 0; d < n; ++d) {
      p.x.push_back(2e-4 * d);
      p.y.push_back(0.0);
      p.radius.push_back(1e-4);
    }
    p.length = 2e-4 * n, p.width = 2e-4;
    const Assembly a = make_assembly(p, bonds_within_gap(p, 1e-5), 1.0, test::kDensity);
    const ContactParameters contact{1e10, 0.0, Kinematics::linear};
    // Longitudinal waves of a free chain: omega = 2 sqrt(k_n/m) sin(pi (n - 1)/(2 n)).
    const double omega = 2.0 * std::sqrt(1e10 / a.mass[0]) * std::sin(0.5 * M_PI * (n - 1) / n);
    EXPECT_NEAR(largest_frequency(a, contact, {}) / omega, 1.0, 1e-6) << n;
    for (const double share : {0.25, 6.276902122}) {
      const DeformationParameters d{Scheme::lagged, Correction::normal, 4e10 / share, 0.3, Plane::stress};
      // A bond's force F strains a disc by r F/(pi r^2 E_p), which moves its bonds by r times that: with b = k_n/(pi E_p),
      // K B has 2 b (both discs) on the diagonal and b beside it (the disc between), of n - 1 bonds.
      const double b = share * 0.25 / M_PI;
      EXPECT_NEAR(fixed_point_radius(a, contact, d), 2.0 * b * (1.0 + std::cos(M_PI / n)), 1e-6 * b) << n;
    }
  }
}

}  // namespace
}  // namespace ddem
