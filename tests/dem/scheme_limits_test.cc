// The critical step of each scheme: against exact plane waves of the lattice, and against direct runs on both sides of it.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/simulation/simulation.h"
#include "dem/spectra/bloch.h"
#include "dem/spectra/spectra.h"
#include "harness/references/lattice_stability.h"
#include "tests/support/assemblies.h"
#include "tests/support/parameters.h"

namespace ddem {
namespace {

using references::ContactModel;
using test::linear_contact;
using test::strains;

constexpr double kRadius = 1e-4;
constexpr int kCells = 12;

Assembly periodic_cell(double thickness = 1.0) {
  return test::hexagonal_assembly({.columns = kCells, .rows = kCells, .radius = kRadius, .periodic_x = true, .periodic_y = true}, thickness);
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
  const double thickness = 1.25;
  const Assembly a = periodic_cell(thickness);
  for (const double lambda : {0.0, 0.3}) {
    for (const DeformationParameters& d :
         {DeformationParameters{}, strains(Scheme::implicit, Correction::full, 2.0), strains(Scheme::implicit, Correction::normal_only_stress, 0.5),
          strains(Scheme::lagged, Correction::normal, 0.25), strains(Scheme::lagged, Correction::full, 0.4),
          strains(Scheme::lagged, Correction::normal_only_stress, 0.4), strains(Scheme::lagged, Correction::full, 1.0, 1, 0.5),
          strains(Scheme::lagged, Correction::full, 0.4, 3), strains(Scheme::lagged, Correction::full, 0.2, 5, 0.8),
          strains(Scheme::lagged, Correction::full, 0.2, 2, 0.5)}) {
      const CriticalStep limit = critical_step(a, linear_contact(lambda), d, {});
      ASSERT_TRUE(limit.step.has_value());
      EXPECT_EQ(limit.bound, d.scheme == Scheme::lagged ? StepBound::flip : StepBound::oscillation);
      const HexagonalBloch bloch({kRadius, test::kDensity, thickness, 0.0}, linear_contact(lambda), d);
      // The uniform translation is a defective double eigenvalue 1: round-off to the power 1/2.
      EXPECT_LT(largest_growth(bloch, 0.9999 * *limit.step), 1e-7)
          << lambda << " " << static_cast<int>(d.scheme) << static_cast<int>(d.correction) << " " << d.evaluations;
      EXPECT_GT(largest_growth(bloch, 1.0001 * *limit.step), 1e-4)
          << lambda << " " << static_cast<int>(d.scheme) << static_cast<int>(d.correction) << " " << d.evaluations;
    }
  }
}

/// Largest displacement after `steps` from noise, over that of the noise; infinite if the run diverged.
double amplification(const Assembly& a, double lambda, const DeformationParameters& d, double dt, long steps) {
  SimulationInput in;
  in.contact = linear_contact(lambda);
  in.deformation = d;
  in.time_step = dt;
  in.steps = steps;
  in.initial.ux = test::Noise(3).vector(a.size(), 1e-9);
  in.initial.uy = test::Noise(4).vector(a.size(), 1e-9);
  const SimulationResult r = simulate(a, in);
  if (r.breakdown) return HUGE_VAL;
  double largest = 0.0;
  for (const auto* u : {&r.final_state.ux, &r.final_state.uy}) {
    for (const double value : *u) largest = std::max(largest, std::abs(value));
  }
  return largest / 1e-9;
}

// Noise of amplitude 1 in 682 discs that keeps its energy has no displacement above 10 (the largest of 1400 sums of
// modes whose phases met); what grows by 1e3 is reported as diverged.
constexpr double kBounded = 10.0;

TEST(DirectRuns, BracketTheCriticalStepWithin01Percent) {
  const Assembly a = test::random_free_strip();
  for (const double lambda : {0.0, 0.5}) {
    for (const DeformationParameters& d : {DeformationParameters{}, strains(Scheme::implicit, Correction::full, 1.0),
                                    strains(Scheme::lagged, Correction::normal_only_stress, 0.25)}) {
      const double limit = critical_step(a, linear_contact(lambda), d, {}).step.value();
      // 0.1 % above the limit the fastest mode grows by 2 sqrt(2e-3) = 9 % a step.
      EXPECT_LT(amplification(a, lambda, d, 0.999 * limit, 4000), kBounded) << lambda << static_cast<int>(d.scheme);
      EXPECT_EQ(amplification(a, lambda, d, 1.001 * limit, 4000), HUGE_VAL) << lambda << static_cast<int>(d.scheme);
    }
  }
}

TEST(DirectRuns, BracketTheSoftnessOfTheLattice) {
  // The exact limit of theory section 3: beyond it by 3 % the strains grow by up to 3 % a step.
  const Assembly a = periodic_cell();
  const double lambda = 0.3;
  const double dt = 0.3 * 2.0 / largest_frequency(a, linear_contact(lambda), {});
  for (const auto& [model, correction] : {std::pair{ContactModel::ddem_normal, Correction::normal},
                                          std::pair{ContactModel::ddem_full, Correction::full},
                                          std::pair{ContactModel::ddem_normal_only_stress, Correction::normal_only_stress}}) {
    const double limit = references::hexagonal_fixed_point_limit(model, 0.3, lambda);
    EXPECT_LT(amplification(a, lambda, strains(Scheme::lagged, correction, 0.97 * limit), dt, 20000), kBounded);
    EXPECT_EQ(amplification(a, lambda, strains(Scheme::lagged, correction, 1.03 * limit), dt, 20000), HUGE_VAL);
  }
}

TEST(DirectRuns, BracketTheStiffnessRatioOfThePublishedCorrection) {
  const Assembly a = periodic_cell();
  const DeformationParameters d = strains(Scheme::lagged, Correction::normal, 0.25);
  const auto after = [&](double lambda, long steps) {
    return amplification(a, lambda, d, 0.5 * 2.0 / largest_frequency(a, linear_contact(lambda), {}), steps);
  };
  EXPECT_LT(after(0.32, 100000), kBounded);
  EXPECT_EQ(after(0.35, 100000), HUGE_VAL);
}

TEST(DirectRuns, BracketTheSoftnessOfARandomPackingWithin1Percent) {
  const Assembly a = test::random_free_strip();
  struct Case {
    double lambda;
    Correction correction;
  };
  for (const Case& c : {Case{0.0, Correction::normal}, Case{0.5, Correction::full}, Case{0.5, Correction::normal_only_stress}}) {
    const double critical = 2.0 / largest_frequency(a, linear_contact(c.lambda), {});
    // The small step is bounded by the fixed point, the large one by the flip.
    for (const double fraction : {0.1, 0.8}) {
      const DeformationParameters d = strains(Scheme::lagged, c.correction, 0.25);
      const double factor = stable_softness_factor(a, linear_contact(c.lambda), d, {}, fraction * critical).value().at_least;
      const double fixed_point = 1.0 / fixed_point_radius(a, linear_contact(c.lambda), d);
      EXPECT_EQ(factor < 0.99 * fixed_point, fraction > 0.5);
      const auto after = [&](double share) {
        return amplification(a, c.lambda, strains(Scheme::lagged, c.correction, share * factor * 0.25), fraction * critical, 4000);
      };
      EXPECT_LT(after(0.99), kBounded) << c.lambda << " " << fraction;
      EXPECT_EQ(after(1.01), HUGE_VAL) << c.lambda << " " << fraction;
    }
  }
}

}  // namespace
}  // namespace ddem
