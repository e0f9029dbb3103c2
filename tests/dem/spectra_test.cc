// Critical steps and limits against exact eigenfrequencies and the closed forms of theory section 3.

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace ddem
