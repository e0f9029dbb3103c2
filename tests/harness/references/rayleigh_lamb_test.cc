// The S0 branch against 40-digit roots of the Rayleigh-Lamb equation.

#include "harness/references/rayleigh_lamb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/support/oracles.h"

namespace ddem::references {
namespace {

struct Deviation {
  double phase = 0.0, group = 0.0;
  int rows = 0;
};

/// Largest relative difference from an oracle's rows, computed for `nu`.
Deviation deviation_from(const std::string& file, double nu) {
  std::ifstream in(std::string(test::kOracles) + "/lamb_s0/" + file);
  Deviation largest;
  std::string line;
  while (std::getline(in, line)) {
    double k_w, f_w, phase, group;
    char comma;
    std::istringstream row(line);
    if (!(row >> k_w >> comma >> f_w >> comma >> phase >> comma >> group)) continue;  // comments, header
    const LambSpeeds speeds = lamb_s0(k_w, nu);
    largest.phase = std::max(largest.phase, std::abs(speeds.phase / phase - 1.0));
    largest.group = std::max(largest.group, std::abs(speeds.group / group - 1.0));
    ++largest.rows;
  }
  return largest;
}

TEST(LambS0, AgreesWithTheOracle) {
  // Table of 16 digits; bisection to the last bit of a function whose round-off is a few units.
  for (const auto& [file, nu] :
       {std::pair{"s0_planestress_nu0.00.csv", 0.0}, std::pair{"s0_planestress_nu0.30.csv", 0.3},
        std::pair{"s0_planestress_nu0.45.csv", 0.45}}) {
    const Deviation deviation = deviation_from(file, nu);
    EXPECT_EQ(deviation.rows, 422) << file;
    EXPECT_LT(deviation.phase, 1e-13) << file;
    EXPECT_LT(deviation.group, 1e-12) << file;
  }
  // The comparison can fail: Poisson's ratio off by 1e-6 shows.
  EXPECT_GT(deviation_from("s0_planestress_nu0.30.csv", 0.300001).phase, 1e-7);
}

TEST(LambS0, LongWavesAreTheBarWave) {
  // c/c_bar = 1 - nu^2 (kW)^2/24 in the plane (Rayleigh's lateral inertia: nu^2 k^2 <y^2>/2, <y^2> = W^2/12).
  for (const double nu : {0.1, 0.3, 0.9}) {
    const double k_w = 1e-3;
    EXPECT_NEAR(lamb_s0(k_w, nu).phase, 1.0 - nu * nu * k_w * k_w / 24.0, 1e-11);
    EXPECT_NEAR(lamb_s0(k_w, nu).group, 1.0 - nu * nu * k_w * k_w / 8.0, 1e-11);
  }
}

TEST(LambS0, PassesTheLameModeAndEndsAsTheRayleighWave) {
  for (const double nu : {0.05, 0.3, 0.6}) {
    // k h = pi/2: c = sqrt(2) c_s exactly.
    EXPECT_NEAR(lamb_s0(std::numbers::pi, nu).phase, 1.0 / std::sqrt(1.0 + nu), 1e-14);
    // k -> infinity: (2 - x)^2 = 4 sqrt((1 - x)(1 - x (1 - nu)/2)), x = (c/c_s)^2.
    const LambSpeeds speeds = lamb_s0(1000.0, nu);
    const double x = speeds.phase * speeds.phase * 2.0 * (1.0 + nu);
    EXPECT_NEAR((2.0 - x) * (2.0 - x), 4.0 * std::sqrt((1.0 - x) * (1.0 - 0.5 * x * (1.0 - nu))), 1e-12);
    EXPECT_NEAR(speeds.group, speeds.phase, 1e-10);
  }
}

TEST(LambS0, IsOneContinuousBranchAndItsGroupSpeedIsItsSlope) {
  // Central difference of w(k): step 1e-4 leaves h^2/6 w''' (w''' of a few for small nu, where S0 turns
  // sharply) and round-off 1e-16/1e-4.
  for (const double nu : {0.1, 0.3, 0.7, 0.95})
    for (double k_w = 0.05; k_w < 40.0; k_w += 0.17) {
      constexpr double h = 1e-4;
      const double slope =
          ((k_w + h) * lamb_s0(k_w + h, nu).phase - (k_w - h) * lamb_s0(k_w - h, nu).phase) / (2.0 * h);
      EXPECT_NEAR(lamb_s0(k_w, nu).group, slope, 1e-6) << k_w << ' ' << nu;
    }
}

TEST(LambS0, RefusesWhatItDoesNotCover) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(lamb_s0(0.0, 0.3), std::invalid_argument);
  EXPECT_THROW(lamb_s0(nan, 0.3), std::invalid_argument);
  EXPECT_THROW(lamb_s0(1e9, 0.3), std::invalid_argument);
  EXPECT_THROW(lamb_s0(1.0, -0.1), std::invalid_argument);
  EXPECT_THROW(lamb_s0(1.0, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::references
