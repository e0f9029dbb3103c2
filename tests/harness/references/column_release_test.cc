#include "harness/references/column_release.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "harness/references/bessel.h"

namespace ddem::references {
namespace {

TEST(Bessel, KnownValues) {
  // Abramowitz and Stegun, tables 9.1 and 9.4, and DLMF: 15 digits.
  EXPECT_NEAR(bessel_j(0, 1.0)[0], 0.765197686557966552, 1e-15);
  EXPECT_NEAR(bessel_j(1, 1.0)[1], 0.440050585744933516, 1e-15);
  EXPECT_NEAR(bessel_j(2, 10.0)[2], 0.254630313685120623, 1e-15);
  EXPECT_NEAR(bessel_j(0, 2.404825557695773)[0], 0.0, 1e-15);  // its first zero
  EXPECT_NEAR(bessel_j(10, 10.0)[10], 0.207486106633358858, 1e-15);
  EXPECT_NEAR(bessel_j(100, 100.0)[100], 0.0963666732958615597, 1e-15);
  EXPECT_NEAR(bessel_j(100, 1.0)[100] / 8.43182878962688e-189, 1.0, 1e-13);
  const std::vector<double> at_zero = bessel_j(3, 0.0);
  EXPECT_EQ(at_zero[0], 1.0);
  EXPECT_EQ(at_zero[3], 0.0);
  EXPECT_THROW(bessel_j(-1, 1.0), std::invalid_argument);
  EXPECT_THROW(bessel_j(1, -1.0), std::invalid_argument);
  EXPECT_THROW(bessel_j(1, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST(Bessel, SumRuleThatTheNormalisationDoesNotUse) {
  // J_0^2 + 2 sum J_n^2 = 1; from tiny to large arguments.
  for (const double x : {1e-200, 1e-8, 0.3, 7.0, 300.0, 1234.5, 1e5}) {
    const std::vector<double> j = bessel_j(static_cast<int>(x + 20.0 * std::cbrt(x)) + 60, x);
    double sum = -j[0] * j[0];
    for (const double value : j) sum += 2.0 * value * value;
    EXPECT_NEAR(sum, 1.0, 1e-13) << x;
  }
}

TEST(Bessel, AgreesWithTheStandardLibrary) {
  // libstdc++ is good to about 1e-12 for arguments below 1000.
  for (const double x : {0.5, 3.0, 42.0, 400.0}) {
    const std::vector<double> j = bessel_j(120, x);
    for (int n = 0; n <= 120; n += 7) EXPECT_NEAR(j[n], std::cyl_bessel_j(n, x), 1e-11) << n << ' ' << x;
  }
}

TEST(ColumnRelease, SolvesTheChainWithAFreeEnd) {
  // u_j'' = (u_{j-1} - 2 u_j + u_{j+1})/4 in tau (omega_max = 1 there: tau = 2 t sqrt(k/m)), u_{-1} = u_0:
  // central differences in tau of step 1e-3 leave h^2/12 u'''' < 1e-7 and round-off 4e-16/h^2 < 4e-10.
  constexpr double h = 1e-3;
  for (const double tau : {0.1, 3.0, 25.0}) {
    const std::vector<double> u = column_release(40, tau);
    const std::vector<double> before = column_release(40, tau - h), after = column_release(40, tau + h);
    for (std::size_t j = 0; j + 1 < u.size(); ++j) {
      const double left = j == 0 ? u[0] : u[j - 1];
      const double acceleration = (before[j] - 2.0 * u[j] + after[j]) / (h * h);
      EXPECT_NEAR(acceleration, 0.25 * (left - 2.0 * u[j] + u[j + 1]), 4e-7) << j << ' ' << tau;
    }
  }
  const std::vector<double> start = column_release(5, 0.0);
  EXPECT_EQ(start, (std::vector<double>{1.0, 0.0, 0.0, 0.0, 0.0}));
}

TEST(ColumnRelease, KeepsItsMomentum) {
  // A free chain's centre of mass stays: the sum of all displacements is the released one.
  double sum = 0.0;
  for (const double u : column_release(200, 150.0)) sum += u;
  EXPECT_NEAR(sum, 1.0, 1e-13);
}

TEST(ColumnRelease, RatesAreTheLatticesLongWaveSpeeds) {
  // A chain with omega_max = tau/t and spacing sqrt(3) r has the speed omega_max sqrt(3) r/2; the lattice
  // (K = A/4, G = A/8 at k_t = 0, A = 2 sqrt(3) k_n, density m/(2 sqrt(3) r^2)) sqrt(G/rho), sqrt((K +
  // G)/rho).
  const double k = 1e10, m = 3e-5, r = 1.1e-4, rho = m / (2.0 * std::numbers::sqrt3 * r * r);
  const double G = 2.0 * std::numbers::sqrt3 * k / 8.0, K = 2.0 * G;
  const double half_spacing = 0.5 * std::numbers::sqrt3 * r;
  EXPECT_NEAR(column_shear_rate(k, m) * half_spacing / std::sqrt(G / rho), 1.0, 1e-14);
  EXPECT_NEAR(column_p_rate(k, m) * half_spacing / std::sqrt((K + G) / rho), 1.0, 1e-14);
}

TEST(ChainDispersion, LongWaves) {
  EXPECT_EQ(chain_phase_speed(0.0), 1.0);
  // 1 - q^2/24 + q^4/1920; measured on rows along y: 0.125 (k r)^2 with q = sqrt(3) k r.
  const double k_r = 0.01;
  EXPECT_NEAR(chain_phase_speed(std::numbers::sqrt3 * k_r), 1.0 - 0.125 * k_r * k_r, 1e-10);
  EXPECT_NEAR(chain_phase_speed(std::numbers::pi), 2.0 / std::numbers::pi, 1e-15);
  EXPECT_THROW(chain_phase_speed(3.2), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::references
