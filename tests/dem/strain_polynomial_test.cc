// The polynomial of the implicit strains: its error on the whole spectrum, from the iteration itself, against the bound.

#include "dem/spectra/strain_polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddem {
namespace {

struct Errors {
  double stiffness = 0.0;  ///< largest relative error of the stiffness of a mode
  double growth = 0.0;     ///< largest residual on the way
};

/// Effective stiffness 1 - t p(t) of the mode with eigenvalue t against 1 / (1 + t).
Errors errors_of(const std::vector<double>& weights, double rho) {
  Errors e;
  for (int k = 0; k <= 4000; ++k) {
    const double t = rho * k / 4000.0;
    double x = 0.0;
    for (const double w : weights) {
      x += w * (1.0 - (1.0 + t) * x);
      e.growth = std::max(e.growth, std::abs(1.0 - (1.0 + t) * x));
    }
    e.stiffness = std::max(e.stiffness, std::abs((1.0 - t * x) * (1.0 + t) - 1.0));
  }
  return e;
}

/// Nothing known of long waves.
StrainSpectrum spectrum(double rho) { return {rho, {}}; }

TEST(StrainPolynomial, MeetsTheToleranceWithNoTermTooMany) {
  for (const double rho : {0.01, 0.334, 1.0, 7.0, 134.0}) {
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (const double tolerance : {1e-8, 1e-4, 1e-2}) {
      const std::vector<double> weights = strain_relaxations(spectrum(rho), tolerance);
      const Errors e = errors_of(weights, rho);
      // Round-off grows with the stiffness ratio.
      EXPECT_LE(e.stiffness, tolerance + 1e-13 * (1.0 + rho)) << rho << " " << tolerance;
      // The order of the zeros: sorted ones would lose all sixteen digits at 134, these lose one or two.
      EXPECT_LT(e.growth, 50.0) << rho << " " << tolerance;
      // One term less is one factor of the convergence, (sqrt(kappa) - 1)/(sqrt(kappa) + 1), short of it.
      const double root = std::sqrt(1.0 + rho), factor = (root - 1.0) / (root + 1.0);
      if (weights.size() > 2) {
        EXPECT_GT(e.stiffness, 0.5 * factor * tolerance) << rho << " " << tolerance;
      }
      EXPECT_LE(weights.size(), before);
      before = weights.size();
    }
  }
}

TEST(StrainPolynomial, FewTermsForUsualDiscs) {
  // k_n/E_p = 0.25, nu_p = 0.3 on the lattice: rho = 0.334. A polynomial that bounds r instead of t r takes four terms.
  EXPECT_EQ(strain_relaxations(spectrum(0.334), 1e-4).size(), 3u);
  EXPECT_EQ(strain_relaxations(spectrum(0.0), 1e-4), (std::vector<double>{1.0, 1.0}));
}

TEST(StrainPolynomial, ExactForTheModesOfALattice) {
  // Dilation excites one mode, shear another: two terms, and no error in the moduli.
  const double dilation = 0.334, shear = 0.466;
  const StrainSpectrum lattice{shear, {{{dilation}, {0.3}}, {{shear}, {0.5}}, {{shear}, {0.5}}}};
  const std::vector<double> weights = strain_relaxations(lattice, 1e-4);
  ASSERT_EQ(weights.size(), 2u);
  EXPECT_NEAR(std::min(weights[0], weights[1]), 1.0 / (1.0 + shear), 1e-13);
  EXPECT_NEAR(std::max(weights[0], weights[1]), 1.0 / (1.0 + dilation), 1e-13);
  EXPECT_LE(errors_of(weights, shear).stiffness, 0.01);
  // A tighter tolerance binds the other motions to a hundred times itself, which two terms do not keep.
  EXPECT_GT(strain_relaxations(lattice, 1e-6).size(), 2u);
  EXPECT_LE(errors_of(strain_relaxations(lattice, 1e-6), shear).stiffness, 1e-4);
}

TEST(StrainPolynomial, SoftDiscsKeepTheirShortWavesStable) {
  // k_n/E_p = 10: zeros at the two modes alone would make other motions wrong by more than their own stiffness.
  const StrainSpectrum lattice{18.6, {{{13.4}, {3.0}}, {{18.6}, {5.0}}, {{18.6}, {5.0}}}};
  EXPECT_LE(errors_of(strain_relaxations(lattice, 1e-4), 18.6).stiffness, 1e-4 + 1e-13);
}

TEST(StrainPolynomial, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(strain_relaxations(spectrum(-1.0), 1e-4), std::invalid_argument);
  EXPECT_THROW(strain_relaxations(spectrum(std::numeric_limits<double>::quiet_NaN()), 1e-4), std::invalid_argument);
  EXPECT_THROW(strain_relaxations(spectrum(1.0), 0.0), std::invalid_argument);
  EXPECT_THROW(strain_relaxations(spectrum(1.0), 0.5), std::invalid_argument);
  EXPECT_THROW(strain_relaxations(spectrum(1e9), 1e-8), std::invalid_argument);
}

}  // namespace
}  // namespace ddem
