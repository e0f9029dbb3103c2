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

}  // namespace
}  // namespace ddem
