// Chebyshev weights: the residual polynomial on the whole spectrum, from the recurrence itself, against its bound.

#include "dem/simulation/chebyshev.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddem {
namespace {

/// Relative error of the effective stiffness of a mode with eigenvalue t: 1 - t p(t) against 1 / (1 + t).
double stiffness_error(const std::vector<ChebyshevWeights>& weights, double t) {
  double change = weights.front().first, x = change;
  for (std::size_t k = 1; k < weights.size(); ++k) {
    change = weights[k].change * change + weights[k].residual * (1.0 - (1.0 + t) * x);
    x += change;
  }
  return std::abs((1.0 - t * x) * (1.0 + t) - 1.0);
}

double worst_error(const std::vector<ChebyshevWeights>& weights, double rho) {
  double worst = 0.0;
  for (int k = 0; k <= 1000; ++k) worst = std::max(worst, stiffness_error(weights, rho * k / 1000.0));
  return worst;
}

TEST(Chebyshev, MeetsTheToleranceWithNoTermTooMany) {
  for (const double rho : {0.01, 0.334, 1.0, 7.0, 134.0}) {
    for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
      std::vector<ChebyshevWeights> weights = chebyshev_weights(rho, tolerance);
      // Round-off of the recurrence grows with the stiffness ratio.
      EXPECT_LE(worst_error(weights, rho), tolerance + 1e-13 * (1.0 + rho)) << rho << " " << tolerance;
      if (weights.size() == 1) continue;
      weights.pop_back();
      EXPECT_GT(worst_error(weights, rho), tolerance) << rho << " " << tolerance;
    }
  }
}

TEST(Chebyshev, FewIterationsForUsualDiscs) {
  // k_n/E_p = 0.25, nu_p = 0.3 on the lattice: rho = 0.334; 1e-4 of the stiffness.
  EXPECT_EQ(chebyshev_weights(0.334, 1e-4).size(), 4u);
}

TEST(Chebyshev, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(chebyshev_weights(-1.0, 1e-4), std::invalid_argument);
  EXPECT_THROW(chebyshev_weights(std::numeric_limits<double>::quiet_NaN(), 1e-4), std::invalid_argument);
  EXPECT_THROW(chebyshev_weights(1.0, 0.0), std::invalid_argument);
  EXPECT_THROW(chebyshev_weights(1.0, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace ddem
