#include "harness/measure/elastic_constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "synthetic.h"

namespace ddem::harness {
namespace {

// Plane elasticity with E = 30 GPa, nu = 0.25, rho = 2000: G = E/(2(1+nu)), K = E/(2(1-nu)).
constexpr double E = 30e9, nu = 0.25, rho = 2000.0;
const double c_bar = std::sqrt(E / rho);
const double c_s = std::sqrt(E / (2.0 * (1.0 + nu)) / rho);
const double c_p = std::sqrt((E / (2.0 * (1.0 - nu)) + E / (2.0 * (1.0 + nu))) / rho);

TEST(ElasticConstants, InvertTheWaveSpeeds) {
  EXPECT_NEAR(young_modulus_from_bar(rho, {c_bar, 0.0}).value, E, 1e-5);
  EXPECT_NEAR(shear_modulus_from_shear(rho, {c_s, 0.0}).value, E / 2.5, 1e-5);
  EXPECT_NEAR(p_modulus_from_p(rho, {c_p, 0.0}).value, E / 1.5 + E / 2.5, 1e-5);
  EXPECT_NEAR(poisson_ratio_from_bar_and_shear({c_bar, 0.0}, {c_s, 0.0}).value, nu, 1e-14);
  EXPECT_NEAR(poisson_ratio_from_p_and_shear({c_p, 0.0}, {c_s, 0.0}).value, nu, 1e-14);
}

TEST(ElasticConstants, PropagateStandardDeviations) {
  // Against a Monte-Carlo sample: relative errors of 0.2 and 0.3 %, 20000 draws, so the sample's standard
  // deviation is known to 1/sqrt(40000) = 0.5 %; five of those, plus second-order terms of the order of the
  // errors.
  const Uncertain bar{c_bar, 0.002 * c_bar}, shear{c_s, 0.003 * c_s}, p{c_p, 0.002 * c_p};
  synthetic::Noise noise(5);
  constexpr int draws = 20000;
  double sum[4] = {}, squares[4] = {};
  for (int n = 0; n < draws; ++n) {
    const double b = bar.value + bar.stddev * noise(), s = shear.value + shear.stddev * noise();
    const double l = p.value + p.stddev * noise();
    const double drawn[4] = {rho * b * b / E, rho * s * s / E, b * b / (2.0 * s * s) - 1.0,
                             1.0 - 2.0 * s * s / (l * l)};
    for (int q = 0; q < 4; ++q) {
      sum[q] += drawn[q] / draws;
      squares[q] += drawn[q] * drawn[q] / draws;
    }
  }
  const double predicted[4] = {
      young_modulus_from_bar(rho, bar).stddev / E, shear_modulus_from_shear(rho, shear).stddev / E,
      poisson_ratio_from_bar_and_shear(bar, shear).stddev, poisson_ratio_from_p_and_shear(p, shear).stddev};
  for (int q = 0; q < 4; ++q)
    EXPECT_NEAR(std::sqrt(squares[q] - sum[q] * sum[q]) / predicted[q], 1.0, 0.03) << q;
}

TEST(ElasticConstants, RefuseWhatIsNotASpeed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(young_modulus_from_bar(rho, {nan, 0.0}), std::invalid_argument);
  EXPECT_THROW(young_modulus_from_bar(0.0, {c_bar, 0.0}), std::invalid_argument);
  EXPECT_THROW(shear_modulus_from_shear(rho, {-1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(poisson_ratio_from_bar_and_shear({c_bar, 0.0}, {0.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(poisson_ratio_from_bar_and_shear({c_bar, nan}, {c_s, 0.0}), std::invalid_argument);
  EXPECT_THROW(poisson_ratio_from_p_and_shear({c_p, -1.0}, {c_s, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::harness
