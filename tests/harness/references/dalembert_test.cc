#include "harness/references/dalembert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace ddem::references {
namespace {

constexpr double L = 16.5e-3, c = 1500.0;

TEST(ReleasedStrip, StandingModesOfAllEnds) {
  // cos or sin modes that fit the ends move as cos(k c t).
  struct Case {
    End left, right;
    double wave_number;
  };
  const double pi_L = std::numbers::pi / L;
  for (const Case& mode :
       {Case{End::free, End::free, 3.0 * pi_L}, Case{End::free, End::fixed, 2.5 * pi_L},
        Case{End::fixed, End::fixed, 2.0 * pi_L}, Case{End::fixed, End::free, 1.5 * pi_L}}) {
    const auto profile = [&](double x) {
      return mode.left == End::free ? std::cos(mode.wave_number * x) : std::sin(mode.wave_number * x);
    };
    const Strip strip{L, c, mode.left, mode.right};
    for (const double x : {0.0, 0.2 * L, 0.77 * L, L})
      for (const double t : {0.0, 1e-6, 1.3e-5, 9.7e-5, -2.2e-5})
        // Arguments k c t of up to 80 carry a round-off of 1e-14.
        EXPECT_NEAR(released_strip(strip, profile, x, t), profile(x) * std::cos(mode.wave_number * c * t),
                    1e-12);
  }
}

TEST(ReleasedStrip, PulseFromAFreeEndTravelsAtFullHeight) {
  // Half of the profile and the half that the free end sends back make one pulse of full width; a fixed end
  // reverses it, a free end doubles it for the moment.
  const auto profile = [](double x) { return cosine_profile(x, 2e-3); };
  const Strip fixed{L, c, End::free, End::fixed};
  EXPECT_NEAR(released_strip(fixed, profile, 8e-3, 8e-3 / c), 0.5, 1e-12);
  EXPECT_NEAR(released_strip(fixed, profile, 8e-3, (8e-3 + 1e-3) / c), 0.25, 1e-12);
  EXPECT_NEAR(released_strip(fixed, profile, 8e-3, (2 * L - 8e-3) / c), -0.5, 1e-12);
  EXPECT_NEAR(released_strip(fixed, profile, L, L / c), 0.0, 1e-12);
  const Strip free{L, c, End::free, End::free};
  EXPECT_NEAR(released_strip(free, profile, L, L / c), 1.0, 1e-12);
}

TEST(DrivenStrip, ArrivesReflectsAndKeepsItsDrivenEnd) {
  constexpr double duration = 3e-6;
  const auto motion = [](double t) { return sin2_motion(t, duration); };
  const double x = 0.4 * L, half = 0.5 * duration;
  for (const End right : {End::free, End::fixed}) {
    const double r = right == End::free ? 1.0 : -1.0;
    const Strip strip{L, c, End::free, right};
    EXPECT_EQ(driven_strip(strip, motion, x, 0.99 * x / c), 0.0);
    EXPECT_NEAR(driven_strip(strip, motion, x, x / c + half), 1.0, 1e-12);
    EXPECT_NEAR(driven_strip(strip, motion, x, (2.0 * L - x) / c + half), r, 1e-12);
    EXPECT_NEAR(driven_strip(strip, motion, x, (2.0 * L + x) / c + half), -r, 1e-12);
    EXPECT_NEAR(driven_strip(strip, motion, x, (4.0 * L - x) / c + half), -1.0, 1e-12);
    EXPECT_NEAR(driven_strip(strip, motion, L, L / c + half), 1.0 + r, 1e-12);
    for (const double t : {0.7e-6, 2e-6, 1e-5, 2.3e-5, 5e-5})
      EXPECT_NEAR(driven_strip(strip, motion, 0.0, t), motion(t), 1e-12);
  }
}

TEST(DrivenStrip, SatisfiesTheWaveEquationAndTheFreeEnd) {
  // Central differences with steps of 1/1000 of the pulse leave (pi h)^2/3 relative to the second derivative.
  constexpr double duration = 3e-6, h = duration / 1000.0;
  const auto u = [](double x, double t) {
    return driven_strip(
        {L, c, End::free, End::free}, [](double s) { return sin2_motion(s, duration); }, x, t);
  };
  const double x = 0.9 * L, t = L / c + 0.3 * duration;
  const double in_time = u(x, t - h) - 2.0 * u(x, t) + u(x, t + h);
  const double in_space = u(x - c * h, t) - 2.0 * u(x, t) + u(x + c * h, t);
  EXPECT_NEAR(in_time, in_space, 1e-10);
  EXPECT_GT(std::abs(in_time), 1e-6);
  // Free end: u_x = 0, so the first difference is -(c h)^2/2 u_xx = -h^2/2 u_tt, to third order in h (3e-8).
  const double at_end = u(L, t - h) - 2.0 * u(L, t) + u(L, t + h);
  EXPECT_NEAR(u(L - c * h, t) - u(L, t), 0.5 * at_end, 1e-7);
  EXPECT_GT(std::abs(at_end), 1e-6);
}

TEST(Profiles, Shapes) {
  EXPECT_EQ(cosine_profile(0.0, 2.0), 1.0);
  EXPECT_NEAR(cosine_profile(1.0, 2.0), 0.5, 1e-15);
  EXPECT_EQ(cosine_profile(2.0, 2.0), 0.0);
  EXPECT_NEAR(gaussian_profile(3.0, 1.0, 2.0), std::exp(-0.5), 1e-15);
  EXPECT_NEAR(sin2_motion(0.25, 1.0), 0.5, 1e-15);
  EXPECT_EQ(sin2_motion(1.5, 1.0), 0.0);
}

TEST(Strip, RefusesWhatIsOutside) {
  const auto zero = [](double) { return 0.0; };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(released_strip({L, c}, zero, -1e-9, 0.0), std::invalid_argument);
  EXPECT_THROW(released_strip({L, c}, zero, nan, 0.0), std::invalid_argument);
  EXPECT_THROW(released_strip({L, 0.0}, zero, 0.0, 0.0), std::invalid_argument);
  EXPECT_THROW(driven_strip({0.0, c}, zero, 0.0, 0.0), std::invalid_argument);
  EXPECT_THROW(driven_strip({L, c}, zero, 0.0, nan), std::invalid_argument);
  EXPECT_THROW(driven_strip({L, c}, zero, 0.0, 1e300), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::references
