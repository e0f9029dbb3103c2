// The critical step of each scheme: against exact plane waves of the lattice, and against direct runs on both sides of it.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/simulation/simulation.h"
#include "dem/spectra/bloch.h"
#include "dem/spectra/spectra.h"
#include "harness/references/lattice_stability.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using references::ContactModel;
using test::kNormalStiffness;

constexpr double kRadius = 1e-4;
constexpr int kCells = 12;

ContactParameters contact(double lambda) { return {kNormalStiffness, lambda, Kinematics::linear}; }

DeformationParameters strains(Scheme scheme, Correction c, double softness, int evaluations = 1, double relaxation = 1.0) {
  DeformationParameters d{scheme, c, kNormalStiffness / softness, 0.3, Plane::stress};
  d.evaluations = evaluations;
  d.relaxation = relaxation;
  return d;
}

Assembly periodic_cell() {
  return test::hexagonal_assembly({.columns = kCells, .rows = kCells, .radius = kRadius, .periodic_x = true, .periodic_y = true});
}

/// Largest |z| - 1 of the waves that fit periodic_cell().
double largest_growth(const HexagonalBloch& bloch, double dt) {
  double worst = -1.0;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const double unit = 2.0 * std::numbers::pi / (kCells * kRadius);
      worst = std::max(worst, bloch.growth({0.5 * unit * i, unit * j / std::sqrt(3.0)}, dt));
    }
  }
  return worst;
}

TEST(CriticalStep, IsWhereThePlaneWavesOfTheLatticeBeginToGrow) {
  const Assembly a = periodic_cell();
  for (const double lambda : {0.0, 0.3}) {
    for (const DeformationParameters& d :
         {DeformationParameters{}, strains(Scheme::implicit, Correction::full, 2.0), strains(Scheme::implicit, Correction::normal_only_stress, 0.5),
          strains(Scheme::lagged, Correction::normal, 0.25), strains(Scheme::lagged, Correction::full, 0.4),
          strains(Scheme::lagged, Correction::normal_only_stress, 0.4), strains(Scheme::lagged, Correction::full, 1.0, 1, 0.5),
          strains(Scheme::lagged, Correction::full, 0.4, 3), strains(Scheme::lagged, Correction::full, 0.2, 5, 0.8),
          strains(Scheme::lagged, Correction::full, 0.2, 2, 0.5)}) {
      const CriticalStep limit = critical_step(a, contact(lambda), d, {});
      ASSERT_TRUE(limit.step.has_value());
      EXPECT_EQ(limit.bound, d.scheme == Scheme::lagged ? StepBound::flip : StepBound::oscillation);
      const HexagonalBloch bloch({kRadius, test::kDensity, 1.0, 0.0}, contact(lambda), d);
      // The uniform translation is a defective double eigenvalue 1: round-off to the power 1/2.
      EXPECT_LT(largest_growth(bloch, 0.9999 * *limit.step), 1e-7)
          << lambda << " " << static_cast<int>(d.scheme) << static_cast<int>(d.correction) << " " << d.evaluations;
      EXPECT_GT(largest_growth(bloch, 1.0001 * *limit.step), 1e-4)
          << lambda << " " << static_cast<int>(d.scheme) << static_cast<int>(d.correction) << " " << d.evaluations;
    }
  }
}

}  // namespace
}  // namespace ddem
