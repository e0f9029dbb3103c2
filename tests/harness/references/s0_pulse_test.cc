// The S0 pulse of a driven strip, and the share of S0 in it.

#include "harness/references/s0_pulse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "harness/references/dalembert.h"
#include "harness/references/rayleigh_lamb.h"

namespace ddem::references {
namespace {

TEST(S0Share, IsAllOfALongWaveAndNothingOfAShortOne) {
  for (const double nu : {0.1, 0.3, 0.45}) {
    const auto share = [&](double k_w) { return lamb_s0_share(k_w, nu, lamb_s0(k_w, nu).phase); };
    // Long waves: the mode's shape departs from the plane section by (nu k W)^2, its stress too.
    EXPECT_NEAR(share(0.01), 1.0, 1e-5) << nu;
    EXPECT_NEAR(share(0.5), 1.0, 0.01 * nu) << nu;
    // A surface wave has little in common with a plane end.
    EXPECT_LT(std::abs(share(12.0)), 0.1) << nu;
  }
  EXPECT_EQ(lamb_s0_share(3.0, 0.0, 1.0), 1.0);
}

/// In the Lame mode, kW = pi, u_x = cos(pi y/W) and u_y = -sin(pi y/W) with s_xy = 0 and s_xx = -2 mu k cos: the share is
/// mean(cos)^2/mean(cos^2) = (2/pi)^2/(1/2) = 8/pi^2, whatever nu.
TEST(S0Share, OfTheLameMode) {
  for (const double nu : {0.05, 0.3, 0.6}) {
    // The quadrature is exact to round-off: 1e-16 of each of its 40 points, and of the phase speed.
    EXPECT_NEAR(lamb_s0_share(std::numbers::pi, nu, lamb_s0(std::numbers::pi, nu).phase),
                8.0 / (std::numbers::pi * std::numbers::pi), 1e-14);
  }
}

TEST(S0Share, RefusesWhatItDoesNotCover) {
  EXPECT_THROW(lamb_s0_share(101.0, 0.3, 0.6), std::invalid_argument);
  EXPECT_THROW(lamb_s0_share(0.0, 0.3, 1.0), std::invalid_argument);
  EXPECT_THROW(lamb_s0_share(1.0, 1.0, 1.0), std::invalid_argument);
}

/// Without contraction there is no dispersion: d'Alembert. The spectrum 2/(pi z (z^2 - 1)) is faded out from eight
/// oscillations on and ends with kW = 8, here z = 8 * 3000/2e-3 * 2.5e-6/(2 pi) = 4.8: what is missing adds up to
/// int_4.8 = 1.4 % if all of it had one sign.
TEST(S0PulseTest, WithoutContractionIsDAlembert) {
  const S0Pulse pulse({3000.0, 2e-3, 0.0}, 2.5e-6, 0.02, 1e-5);
  for (const double x : {0.001, 0.005, 0.012}) {
    const std::vector<double> u = pulse.signal(x, 1e-7, 100);
    for (std::size_t n = 0; n < u.size(); ++n) {
      EXPECT_NEAR(u[n], sin2_motion(1e-7 * static_cast<double>(n) - x / 3000.0, 2.5e-6), 0.014);
    }
    EXPECT_NEAR(pulse.signal(x, x / 3000.0 + 1.25e-6, 2).back(), 1.0, 0.014);
  }
}

/// A pulse of 400 widths: to first order each frequency is late by x/c nu^2 (kW)^2/24, which to the cosine of its single
/// oscillation, k = 2 pi/400 W, is 9.3e-7 (nu = 0.3) of x/c, and nothing to its mean. The zero of the slope moves by that; what the
/// spectrum lacks beyond eight oscillations rings at the top by a tenth of it.
TEST(S0PulseTest, LongPulsesAreLateByTheirLateralInertia) {
  const double c = 3000.0, width = 1e-3, nu = 0.3, duration = 400.0 * width / c, x = 2.0;
  const S0Pulse pulse({c, width, nu}, duration, x, x / c + duration);
  const double expected = x / c + 0.5 * duration, h = expected / 110.0;  // 0.05 of the duration
  const std::vector<double> u = pulse.signal(x, h, 112);
  const double slope = u[111] - u[109];
  const double bend = u[111] - 2.0 * u[110] + u[109];
  const double late = -0.5 * h * slope / bend;
  const double kw = 2.0 * std::numbers::pi / 400.0;
  EXPECT_NEAR(late / (x / c * nu * nu * kw * kw / 24.0), 1.0, 0.1);
}

TEST(S0PulseTest, RefusesWhatIsNoStrip) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(S0Pulse({0.0, 2e-3, 0.3}, 1e-6, 0.01, 1e-5), std::invalid_argument);
  EXPECT_THROW(S0Pulse({3000.0, nan, 0.3}, 1e-6, 0.01, 1e-5), std::invalid_argument);
  EXPECT_THROW(S0Pulse({3000.0, 2e-3, -0.1}, 1e-6, 0.01, 1e-5), std::invalid_argument);
  EXPECT_THROW(S0Pulse({3000.0, 2e-3, 0.3}, 0.0, 0.01, 1e-5), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::references
