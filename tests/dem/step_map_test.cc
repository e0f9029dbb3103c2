// The step as a matrix against plane waves of the lattice and against the sharp critical step of a random packing.

#include "dem/spectra/step_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/spectra/bloch.h"
#include "dem/spectra/spectra.h"
#include "meshes/packings/random.h"
#include "tests/support/assemblies.h"
#include "tests/support/parameters.h"
#include "tests/support/step_matrix.h"

namespace ddem {
namespace {

using test::linear_contact;
using test::strains;

constexpr double kRadius = 1e-4;
constexpr int kCells = 4;

/// Largest growth of the waves that fit the cell; those with motion, but translations.
double wave_growth(const HexagonalBloch& bloch, double dt) {
  double largest = 0.0;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const double unit = 2.0 * std::numbers::pi / (kCells * kRadius);
      for (const WaveMode& m : bloch.modes({0.5 * unit * i, unit * j / std::numbers::sqrt3}, dt)) {
        if (m.motion.norm() > 0.0 && std::abs(m.factor - 1.0) > kTranslationFactor) largest = std::max(largest, std::abs(m.factor));
      }
    }
  }
  return largest - 1.0;
}

TEST(StepMap, OfTheLatticeHasThePlaneWavesAsItsModes) {
  const Assembly a = test::hexagonal_assembly({.columns = kCells, .rows = kCells, .radius = kRadius, .periodic_x = true, .periodic_y = true});
  for (const double lambda : {0.0, 0.5}) {
    const double critical = 2.0 / largest_frequency(a, linear_contact(lambda), {});
    for (const DeformationParameters& d :
         {DeformationParameters{}, strains(Scheme::implicit, Correction::full, 2.0), strains(Scheme::implicit, Correction::normal, 0.5),
          strains(Scheme::lagged, Correction::normal, 0.25), strains(Scheme::lagged, Correction::full, 0.5), strains(Scheme::lagged, Correction::full, 0.25, 2),
          strains(Scheme::lagged, Correction::normal_only_stress, 0.3, 3, 0.8)}) {
      const HexagonalBloch bloch({kRadius, test::kDensity, 1.0, 0.0}, linear_contact(lambda), d);
      for (const double fraction : {0.3, 1.05}) {
        const double growth = std::abs(leading_mode(a, linear_contact(lambda), d, fraction * critical).factor) - 1.0, waves = wave_growth(bloch, fraction * critical);
        // Eigenvalues of a matrix of norm 4 and of its blocks; the lattice's are degenerate: round-off to the power 1/2.
        EXPECT_NEAR(growth, waves, 1e-7) << lambda << " " << static_cast<int>(d.scheme) << static_cast<int>(d.correction) << " " << fraction;
      }
    }
  }
}

TEST(StepMap, OfARandomPackingGrowsBeyondTheCriticalStep) {
  const Packing p = packings::random_jammed({.length = 1e-3, .width = 1e-3, .discs = 24, .seed = 1});
  const Assembly a = make_assembly(p, bonds_within_gap(p, 0.3 * mean_radius(p)), 1.0, test::kDensity, RattlerRule::peel);
  for (const double lambda : {0.0, 0.5}) {
    for (const DeformationParameters& d : {DeformationParameters{}, strains(Scheme::implicit, Correction::full, 1.0), strains(Scheme::lagged, Correction::full, 0.25),
                                           strains(Scheme::lagged, Correction::normal_only_stress, 0.25)}) {
      // The critical step is right to 1e-5 or better; 0.1 % beyond it the fastest motion grows by 2 sqrt(2e-3) = 9 % a step,
      // for lagged strains in proportion to the excess.
      const double step = critical_step(a, linear_contact(lambda), d, {}).step.value();
      EXPECT_LT(std::abs(leading_mode(a, linear_contact(lambda), d, 0.999 * step).factor), 1.0 + 1e-9) << lambda;
      EXPECT_GT(std::abs(leading_mode(a, linear_contact(lambda), d, 1.001 * step).factor), 1.0 + 1e-4) << lambda;
    }
  }
}

/// Random discs, periodic in y, the right edge held.
struct SmallStrip {
  explicit SmallStrip(std::uint64_t seed) {
    Packing p = packings::random_jammed({.length = 1e-3, .width = 1e-3, .discs = 14, .seed = seed});
    const Bonds bonds = cut_at_edges(p, bonds_within_gap(p, 0.4 * mean_radius(p)), true, false);
    p.period.x = 0.0;
    a = make_assembly(p, bonds, 1.0, test::kDensity, RattlerRule::peel);
    for (auto* mask : {&held.x, &held.y, &held.theta}) mask->assign(a.size(), 0);
    for (const int d : edge_discs(p, Edge::right, mean_radius(p))) held.x[d] = held.y[d] = held.theta[d] = 1;
  }
  Assembly a;
  HeldDofs held;
};

/// The growth of a step is that of the step as it is written down, and says the same of stability as the critical step where
/// that decides: for corrections with an energy, unless an even number of evaluations overshoots.
TEST(StepGrowth, IsThatOfTheStepWrittenDown) {
  const SmallStrip strip(3);
  int grows = 0, fed = 0;
  for (const double lambda : {0.0, 0.6}) {
    const ContactParameters contact = linear_contact(lambda);
    const double critical = 2.0 / largest_frequency(strip.a, contact, strip.held);
    for (const Correction c : {Correction::normal, Correction::full, Correction::normal_only_stress}) {
      for (int evaluations = 1; evaluations <= 4; ++evaluations) {
        for (const double relaxation : {1.0, 0.5}) {
          for (const auto& [fraction, softness] : {std::pair(0.2, 0.1), std::pair(0.2, 0.8), std::pair(0.95, 0.3)}) {
            const DeformationParameters d = strains(Scheme::lagged, c, softness, evaluations, relaxation);
            const double dt = fraction * critical, growth = step_growth(strip.a, contact, d, strip.held, dt);
            EXPECT_NEAR(growth, test::amplification({strip.a, contact, d}, strip.held, dt), 1e-10 * (1.0 + growth))
                << lambda << " " << static_cast<int>(c) << " " << evaluations << " " << relaxation << " " << fraction;
            const CriticalStep limit = critical_step(strip.a, contact, d, strip.held);
            grows += growth > kGrowthRoundOff, fed += limit.bound == StepBound::feeding && growth <= kGrowthRoundOff;
            if ((c == Correction::normal && lambda > 0.0) || limit.bound == StepBound::feeding) continue;
            EXPECT_EQ(growth > kGrowthRoundOff, !(limit.step && dt <= *limit.step)) << growth << " " << lambda << static_cast<int>(c) << evaluations << relaxation << fraction;
          }
        }
      }
    }
  }
  EXPECT_GT(grows, 20);
  EXPECT_GT(fed, 0);  // overshooting strains are no motion yet
}

TEST(StepGrowth, OfImplicitStrainsAndRigidDiscs) {
  const SmallStrip strip(3);
  for (const double lambda : {0.0, 1.0}) {
    for (DeformationParameters d : {DeformationParameters{}, strains(Scheme::implicit, Correction::normal, 1.0), strains(Scheme::implicit, Correction::full, 1.0)}) {
      d.tolerance = 1e-10;
      const double step = critical_step(strip.a, linear_contact(lambda), d, {}).step.value();
      for (const double fraction : {0.5, 1.01}) {
        const double growth = step_growth(strip.a, linear_contact(lambda), d, {}, fraction * step);
        EXPECT_NEAR(growth, std::abs(leading_mode(strip.a, linear_contact(lambda), d, fraction * step).factor) - 1.0, 1e-8) << lambda;
        const bool may_flutter = d.active() && d.correction == Correction::normal && lambda > 0.0;
        if (!may_flutter || fraction > 1.0) {
          EXPECT_EQ(growth > kGrowthRoundOff, fraction > 1.0) << lambda << fraction;
        }
      }
    }
  }
}

/// With an even number of evaluations some strains are overshot long before a motion grows.
TEST(SoftnessFactor, OfEvenEvaluationsIsWhereTheStepBeginsToGrow) {
  const SmallStrip strip(5);
  const ContactParameters contact = linear_contact(0.4);
  const double dt = 0.2 * 2.0 / largest_frequency(strip.a, contact, strip.held);
  int wider = 0;
  for (const Correction c : {Correction::full, Correction::normal_only_stress}) {
    for (const int evaluations : {2, 4}) {
      for (const double relaxation : {0.5, 0.7}) {
        const DeformationParameters d = strains(Scheme::lagged, c, 0.1, evaluations, relaxation);
        const SoftnessFactor factor = stable_softness_factor(strip.a, contact, d, strip.held, dt).value();
        EXPECT_EQ(factor.at_least, factor.at_most);
        const auto growth = [&](double share) {
          return test::amplification({strip.a, contact, strains(Scheme::lagged, c, share * factor.at_least * 0.1, evaluations, relaxation)}, strip.held, dt);
        };
        EXPECT_LE(growth(0.998), kGrowthRoundOff) << evaluations << relaxation;
        EXPECT_GT(growth(1.002), kGrowthRoundOff) << evaluations << relaxation;
        wider += factor.at_least > 1.02 * (1.0 - relaxation) / relaxation / fixed_point_radius(strip.a, contact, d);
      }
    }
  }
  EXPECT_GE(wider, 4);
}

/// Where there are too many discs for that, the bounds say how much is not known.
TEST(SoftnessFactor, OfEvenEvaluationsOfManyDiscsLiesBetweenTwoBounds) {
  const Assembly a = test::hexagonal_assembly({.columns = 12, .rows = 8, .radius = kRadius, .periodic_x = true, .periodic_y = true});
  const DeformationParameters d = strains(Scheme::lagged, Correction::full, 0.1, 2, 0.5);
  const double dt = 0.2 * 2.0 / largest_frequency(a, linear_contact(0.4), {});
  const SoftnessFactor factor = stable_softness_factor(a, linear_contact(0.4), d, {}, dt).value();
  EXPECT_NEAR(factor.at_least * fixed_point_radius(a, linear_contact(0.4), d), 1.0, 1e-6);
  EXPECT_GT(factor.at_most, 1.5 * factor.at_least);
  const HexagonalBloch bloch({kRadius, test::kDensity, 1.0, 0.0}, linear_contact(0.4), strains(Scheme::lagged, Correction::full, 0.099 * factor.at_least, 2, 0.5));
  EXPECT_LE(bloch.worst_wave(dt).growth, 1e-9);
  EXPECT_FALSE(stable_softness_factor(a, linear_contact(0.4), strains(Scheme::lagged, Correction::full, 0.1, 2), {}, dt));
}

}  // namespace
}  // namespace ddem
