// Exact plane waves of the hexagonal lattice against closed forms: speeds of long waves (theory section 2), the first-order
// formula of the lag's damping, and the limits of the lagged scheme (theory section 3).

#include "dem/spectra/bloch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/spectra/spectra.h"
#include "harness/references/effective_moduli.h"
#include "harness/references/lattice_stability.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using references::ContactModel;
using test::kNormalStiffness;

constexpr double kRadius = 1e-4;

HexagonalLattice lattice(double row_angle = 0.0) { return {kRadius, test::kDensity, 1.0, row_angle}; }

ContactParameters contact(double lambda) { return {kNormalStiffness, lambda, Kinematics::linear}; }

DeformationParameters bloch_strains(Scheme scheme, Correction c, double softness = 0.25, double nu = 0.3) {
  return {scheme, c, kNormalStiffness / softness, nu, Plane::stress};
}

struct Named {
  ContactModel model;
  DeformationParameters deformation;
};

std::vector<Named> models(Scheme scheme) {
  return {{ContactModel::dem, {}},
          {ContactModel::ddem_normal, bloch_strains(scheme, Correction::normal)},
          {ContactModel::ddem_full, bloch_strains(scheme, Correction::full)},
          {ContactModel::ddem_normal_only_stress, bloch_strains(scheme, Correction::normal_only_stress)}};
}

references::PlaneModuli closed_form(const Named& m, double lambda) {
  references::Disc disc;
  if (m.deformation.active()) disc.material = {m.deformation.young_modulus, m.deformation.poisson_ratio};
  return references::effective_moduli(m.model, references::hexagonal_fabric(), {kNormalStiffness, lambda}, disc);
}

TEST(BlochFrequencies, LongWavesHaveTheClosedFormSpeeds) {
  const double density = test::kDensity * references::hexagonal_fabric().solid_fraction;
  for (const double lambda : {0.0, 0.3, 1.0}) {
    for (const Named& m : models(Scheme::implicit)) {
      const references::PlaneModuli moduli = closed_form(m, lambda);
      const double s = std::sqrt(moduli.shear / density), p = std::sqrt((moduli.bulk + moduli.shear) / density);
      const HexagonalBloch bloch(lattice(0.2), contact(lambda), m.deformation);
      for (const double angle : {0.0, 0.4, 1.3}) {
        // The speed's relative error is -A (k r)^2, A below 0.2 (theory section 5): 2e-7 at k r = 1e-3.
        const double k = 1e-3 / kRadius;
        const auto omega = bloch.frequencies({k * std::cos(angle), k * std::sin(angle)});
        ASSERT_EQ(omega.size(), lambda == 0.0 ? 2u : 3u);
        EXPECT_NEAR(omega[0].real() / (k * s), 1.0, 2e-7);
        EXPECT_NEAR(omega[1].real() / (k * p), 1.0, 2e-7);
        EXPECT_NEAR(omega[0].imag(), 0.0, 1e-9 * k * s);
      }
    }
  }
}

TEST(BlochFrequencies, DispersionAlongTheRows) {
  // By hand, from the sum over bonds of 4 k_n sin^2(k.d/2) n n: along the rows omega_s^2 = 6 (k_n/m) sin^2(k r/2) and
  // omega_p^2 = (k_n/m)(4 sin^2(k r) + 2 sin^2(k r/2)), across to them omega_s^2 = 2 (k_n/m) sin^2(sqrt(3) k r/2).
  const double mass = test::kDensity * std::numbers::pi * kRadius * kRadius;
  const HexagonalBloch bloch(lattice(), contact(0.0), {});
  for (const double kr : {0.1, 0.7, 1.5}) {
    const auto along = bloch.frequencies({kr / kRadius, 0.0}), across = bloch.frequencies({0.0, kr / kRadius});
    const double unit = kNormalStiffness / mass, half = std::sin(0.5 * kr), whole = std::sin(kr);
    const double s = std::sqrt(6.0 * unit) * half, p = std::sqrt(unit * (4.0 * whole * whole + 2.0 * half * half));
    EXPECT_NEAR(along[0].real() / std::min(s, p), 1.0, 1e-12);
    EXPECT_NEAR(along[1].real() / std::max(s, p), 1.0, 1e-12);
    EXPECT_NEAR(across[0].real() / (std::sqrt(2.0 * unit) * std::sin(0.5 * std::sqrt(3.0) * kr)), 1.0, 1e-12);
  }
}

TEST(BlochBranches, KnowTheirPolarisation) {
  // Along a row, mirror symmetry splits longitudinal waves from shear and rotation.
  const HexagonalBloch bloch(lattice(), contact(0.5), bloch_strains(Scheme::implicit, Correction::full));
  const WaveVector k{0.3 / kRadius, 0.0};
  const auto branches = bloch.branches(k);
  const auto frequencies = bloch.frequencies(k);
  ASSERT_EQ(branches.size(), 3u);
  for (std::size_t b = 0; b < 3; ++b) EXPECT_NEAR(branches[b].frequency.real() / frequencies[b].real(), 1.0, 1e-10);
  EXPECT_GT(std::norm(branches[0].motion[1]), 0.9);
  EXPECT_NEAR(std::norm(branches[1].motion[0]), 1.0, 1e-10);
  EXPECT_GT(std::norm(branches[2].motion[2]), 0.9);
}

constexpr int kCells = 12;

Assembly periodic_cell() {
  return test::hexagonal_assembly({.columns = kCells, .rows = kCells, .radius = kRadius, .periodic_x = true, .periodic_y = true});
}

/// The waves that fit periodic_cell().
std::vector<WaveVector> waves_of_the_cell() {
  std::vector<WaveVector> waves;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const double unit = 2.0 * std::numbers::pi / (kCells * kRadius);
      waves.push_back({0.5 * unit * i, unit * j / std::sqrt(3.0)});
    }
  }
  return waves;
}

TEST(BlochFrequencies, ThoseOfAPeriodicLattice) {
  const Assembly a = periodic_cell();
  for (const double lambda : {0.0, 0.5}) {
    const HexagonalBloch bloch(lattice(), contact(lambda), {});
    double largest = 0.0;
    for (const WaveVector& k : waves_of_the_cell()) largest = std::max(largest, bloch.frequencies(k).back().real());
    // largest_frequency is right to 1e-6.
    EXPECT_NEAR(largest_frequency(a, contact(lambda), {}) / largest, 1.0, 2e-6);
    // The infinite lattice has more waves; the largest stable step is right to 1e-4.
    const auto step = bloch.largest_stable_step();
    ASSERT_TRUE(step.has_value());
    EXPECT_LT(*step, 2.0 / largest * (1.0 + 1e-4));
    EXPECT_GT(*step, 2.0 / largest * 0.99);
  }
}

TEST(BlochMultipliers, OfDemAndImplicitStrainsLieOnTheUnitCircle) {
  for (const Named& m : models(Scheme::implicit)) {
    if (m.model == ContactModel::ddem_normal) continue;  // has no energy
    const HexagonalBloch bloch(lattice(), contact(0.5), m.deformation);
    // omega_max of DEM bounds the implicit one. Round-off of a square root of a number near 1.
    const double dt = 0.95 * HexagonalBloch(lattice(), contact(0.5), {}).largest_stable_step().value();
    EXPECT_NEAR(bloch.worst_wave(dt).growth, 0.0, 1e-12);
  }
}

/// theory section 3: |z| - 1 = -(omega dt)(omega tau)/2, tau = dt b r^(s-1)/(1 - r^s), r = 1 - w - w b. For a shear wave
/// of the lattice, whose strain is uniform in the long-wave limit, b is A c/(4 phi 2G_p), c = 1 + lambda for F.
double first_order(double omega_dt, double b, int s, double w) {
  const double r = 1.0 - w - w * b;
  return -0.5 * omega_dt * omega_dt * b * std::pow(r, s - 1) / (1.0 - std::pow(r, s));
}

TEST(BlochMultipliers, FirstOrderFormulaOfTheLag) {
  const double lambda = 0.5, softness = 0.25, nu = 0.3;
  const double b = 3.0 / std::numbers::pi * (1.0 + nu) * softness * (1.0 + lambda);
  for (const auto& [s, w] : {std::pair{1, 1.0}, {2, 1.0}, {3, 1.0}, {1, 0.5}, {2, 0.5}, {4, 0.7}}) {
    DeformationParameters d = bloch_strains(Scheme::lagged, Correction::full, softness, nu);
    d.evaluations = s;
    d.relaxation = w;
    const HexagonalBloch bloch(lattice(), contact(lambda), d);
    const WaveVector k{0.02 / kRadius, 0.0};
    const double omega = bloch.frequencies(k)[0].real();
    // The formula's relative error is of first order in omega dt (with a factor of tau / dt and the like below 10), and
    // of second order in k r: halving dt from 1e-3 must bring |z| - 1 to it within 1e-2.
    const double step = 1e-3 / omega;
    const double exact = std::abs(bloch.multiplier_of(k, step, omega)) - 1.0;
    EXPECT_NEAR(exact / first_order(1e-3, b, s, w), 1.0, 1e-2) << s << " evaluations, relaxation " << w;
    EXPECT_EQ(exact > 0.0, s % 2 == 0 && w > 0.6) << s << " evaluations, relaxation " << w;
  }
}

TEST(BlochMultipliers, LaggedSchemeIsStableBelowTheFixedPointLimit) {
  for (const double lambda : {0.0, 0.5}) {
    for (const Named& m : models(Scheme::lagged)) {
      if (m.model == ContactModel::dem || (m.model == ContactModel::ddem_normal && lambda > 1.0 / 3.0)) continue;
      const double limit = references::hexagonal_fixed_point_limit(m.model, 0.3, lambda);
      const double critical = HexagonalBloch(lattice(), contact(lambda), {}).largest_stable_step().value();
      const auto growth = [&](double softness) {
        const HexagonalBloch bloch(lattice(), contact(lambda), bloch_strains(Scheme::lagged, m.deformation.correction, softness));
        return bloch.worst_wave(0.02 * critical).growth;
      };
      EXPECT_LT(growth(0.97 * limit), 1e-9);
      EXPECT_GT(growth(1.03 * limit), 1e-2);
    }
  }
}

TEST(BlochMultipliers, PublishedCorrectionIsUnstableAboveOneThird) {
  for (const double fraction : {0.1, 0.5}) {
    for (const double softness : {0.05, 0.25}) {
      const auto growth = [&](double lambda) {
        const double critical = HexagonalBloch(lattice(), contact(lambda), {}).largest_stable_step().value();
        return HexagonalBloch(lattice(), contact(lambda), bloch_strains(Scheme::lagged, Correction::normal, softness))
            .worst_wave(fraction * critical)
            .growth;
      };
      EXPECT_LT(growth(0.32), 1e-9) << softness;
      EXPECT_GT(growth(0.35), 1e-7) << softness;
    }
  }
}

TEST(BlochInput, IsChecked) {
  EXPECT_THROW(HexagonalBloch({0.0, 2000.0, 1.0, 0.0}, contact(0.0), {}), std::invalid_argument);
  EXPECT_THROW(HexagonalBloch(lattice(), {0.0, 0.0, Kinematics::linear}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace ddem
