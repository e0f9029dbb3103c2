// The polynomial of the implicit strains: its error on the whole spectrum, from the iteration itself, against the bound.

#include "dem/simulation/strain_polynomial.h"

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

TEST(StrainPolynomial, MeetsTheToleranceWithNoTermTooMany) {
  for (const double rho : {0.01, 0.334, 1.0, 7.0, 134.0}) {
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (const double tolerance : {1e-8, 1e-4, 1e-2}) {
      const std::vector<double> weights = strain_relaxations(rho, tolerance);
      const Errors e = errors_of(weights, rho);
      // Round-off grows with the stiffness ratio.
      EXPECT_LE(e.stiffness, tolerance + 1e-13 * (1.0 + rho)) << rho << " " << tolerance;
      // The order of the zeros: sorted ones would lose all sixteen digits at 134, these lose one or two.
      EXPECT_LT(e.growth, 50.0) << rho << " " << tolerance;
      // One term less is one factor of the convergence, (sqrt(kappa) - 1)/(sqrt(kappa) + 1), short of it.
      const double root = std::sqrt(1.0 + rho), factor = (root - 1.0) / (root + 1.0);
      if (weights.size() > 1) {
        EXPECT_GT(e.stiffness, 0.5 * factor * tolerance) << rho << " " << tolerance;
      }
      EXPECT_LE(weights.size(), before);
      before = weights.size();
    }
  }
}

TEST(StrainPolynomial, FewTermsForUsualDiscs) {
  // k_n/E_p = 0.25, nu_p = 0.3 on the lattice: rho = 0.334. A polynomial that bounds r instead of t r takes four terms.
  EXPECT_EQ(strain_relaxations(0.334, 1e-4).size(), 3u);
  EXPECT_EQ(strain_relaxations(0.0, 1e-4), std::vector<double>{1.0});
}

TEST(StrainPolynomial, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(strain_relaxations(-1.0, 1e-4), std::invalid_argument);
  EXPECT_THROW(strain_relaxations(std::numeric_limits<double>::quiet_NaN(), 1e-4), std::invalid_argument);
  EXPECT_THROW(strain_relaxations(1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(strain_relaxations(1.0, 0.5), std::invalid_argument);
  EXPECT_THROW(strain_relaxations(1e9, 1e-8), std::invalid_argument);
}

}  // namespace
}  // namespace ddem
