// Phase velocity of pulses whose dispersion is known.

#include "harness/measure/phase_velocity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "synthetic.h"

namespace ddem::harness {
namespace {

using synthetic::gaussian;
using synthetic::Record;
using synthetic::sample;
using synthetic::with_noise;

constexpr double kDt = 2e-9, kSpeed = 3000.0, kWidth = 2e-7;  // s, m/s, standard width of the pulse
constexpr double kPeak = 2e-6;                                // at the first probe
constexpr double kDistance = 6e-3;
constexpr std::size_t kSamples = 4000;

/// 1/c(w) = (1 + b (w width)^2)/c_0: slower the higher, like the S0 wave and a lattice.
double speed_at(double frequency, double b) {
  const double z = 2.0 * std::numbers::pi * frequency * kWidth;
  return kSpeed / (1.0 + b * z * z);
}

/// A gaussian exp(-t^2/(2 width^2)) after `distance` in that medium: int_0^inf exp(-z^2/2) cos(z (t - t_0)/width) dz times
/// sqrt(2/pi), z = w width, each frequency delayed by its own phase. The sum repeats after 2 pi width/dz = 25 us, and what
/// z > 6 would add is 1e-8.
Record dispersed(double distance, double b, double peak = kPeak) {
  return sample(
      [=](double t) {
        constexpr double dz = 0.05;
        double u = 0.5;
        for (double z = dz; z < 6.0; z += dz) {
          const double delay = distance / kSpeed * (1.0 + b * z * z);
          u += std::exp(-0.5 * z * z) * std::cos(z * (t - peak - delay) / kWidth);
        }
        return std::sqrt(2.0 / std::numbers::pi) * dz * u;
      },
      kSamples, kDt);
}

const Window kFrom{1e-6, 3e-6}, kTo{2e-6, 7.5e-6};

/// Largest relative error over the band.
double largest_error(const PhaseVelocity& v, double b) {
  double largest = 0.0;
  for (std::size_t n = 0; n < v.frequency.size(); ++n) largest = std::max(largest, std::abs(v.speed[n] / speed_at(v.frequency[n], b) - 1.0));
  return largest;
}

TEST(PhaseVelocityOfAPulse, IsThatOfTheMedium) {
  // The first pulse is cut 5 standard widths before and after its peak, exp(-12.5) = 4e-6, the second 10 before (dispersion
  // widens its front) and 17.5 after, where what travels at 1/(1 + 3 b z^2) has z > 4.4, exp(-z^2/2) = 6e-5. At the end of
  // the band, where a tenth of the spectrum is left, such a cut weighs ten times as much, in a phase of 20 rad.
  for (const double b : {0.0, 0.01, 0.03}) {
    const Record from = dispersed(0.0, b), to = dispersed(kDistance, b);
    const auto v = phase_velocity({from, kFrom}, {to, kTo}, kDistance);
    ASSERT_TRUE(v.ok()) << v.error().reason;
    EXPECT_LT(largest_error(v.value(), b), 3e-5) << b;
    // The band: from a period in the window to where exp(-z^2/2) = 0.1 of that at the first frequency, z = 2.1 to 2.2.
    const double z = 2.0 * std::numbers::pi * kWidth;
    EXPECT_NEAR(v.value().frequency.front(), 0.5e6, 0.1e6);
    EXPECT_GT(v.value().frequency.back() * z, 2.0);
    EXPECT_LT(v.value().frequency.back() * z, 2.4);
    EXPECT_EQ(v.value().frequency.size(), v.value().speed.size());
  }
  // It can fail: at b = 0.03 the band's end is 14 % slow.
  EXPECT_LT(speed_at(2.1 / (2.0 * std::numbers::pi * kWidth), 0.03), 0.9 * kSpeed);
}

TEST(PhaseVelocityOfAPulse, DoesNotDependOnScaleSignOrStart) {
  const Record from = dispersed(0.0, 0.02);
  Record to = dispersed(kDistance, 0.02);
  for (double& v : to.values) v *= 1e-12;
  const auto small = phase_velocity({from, kFrom}, {to, kTo}, kDistance);
  ASSERT_TRUE(small.ok()) << small.error().reason;
  EXPECT_LT(largest_error(small.value(), 0.02), 3e-5);
  // A recording that starts later, and a window that does not begin at a sample.
  const Record late{{to.values.begin() + 1000, to.values.end()}, kDt, 1000 * kDt};
  const auto shifted = phase_velocity({from, kFrom}, {late, {2e-6 + 0.3 * kDt, 7.5e-6}}, kDistance);
  ASSERT_TRUE(shifted.ok());
  EXPECT_LT(largest_error(shifted.value(), 0.02), 3e-5);
}

TEST(PhaseVelocityOfAPulse, AReflectionOutsideTheWindowDoesNotMatter) {
  const Record from = dispersed(0.0, 0.02), clean = dispersed(kDistance, 0.02), back = dispersed(2.1 * kDistance, 0.02);
  Record to = clean;
  for (std::size_t n = 0; n < to.values.size(); ++n) to.values[n] += 1.8 * back.values[n];
  // The reflection's peak stands at 6.2 us: 4 widths and its slow part outside, 1e-3 of it inside, faded out.
  const auto v = phase_velocity({from, kFrom}, {to, {3e-6, 5.2e-6}}, kDistance);
  ASSERT_TRUE(v.ok()) << v.error().reason;
  EXPECT_LT(largest_error(v.value(), 0.02), 2e-3);
  // Inside the window it ruins the measurement: two pulses interfere.
  const auto ruined = phase_velocity({from, kFrom}, {to, {3e-6, 7.9e-6}}, kDistance);
  EXPECT_TRUE(!ruined.ok() || largest_error(ruined.value(), 0.02) > 0.05);
}

TEST(PhaseVelocityOfAPulse, NoiseMovesItByItsPredictedSpread) {
  // White noise sigma in N samples has the spectrum sigma sqrt(N); a gaussian's is exp(-z^2/2) width sqrt(2 pi)/dt. In
  // either signal the ratio's half is in phase: relative spread of the speed sigma sqrt(N/2 + N'/2) dt exp(z^2/2)/(width
  // sqrt(2 pi))/(w distance/c). At z = 1, sigma = 0.01, N = 1000, N' = 2750.
  constexpr double sigma = 0.01, b = 0.0, z = 1.0;
  const double frequency = z / (2.0 * std::numbers::pi * kWidth);
  const double phase = sigma * std::sqrt(0.5 * (1000 + 2750)) * kDt * std::exp(0.5 * z * z) / (kWidth * std::sqrt(2.0 * std::numbers::pi));
  const double predicted = phase / (2.0 * std::numbers::pi * frequency * kDistance / kSpeed);
  const Record from = dispersed(0.0, b), to = dispersed(kDistance, b);
  constexpr unsigned trials = 100;
  double squares = 0.0;
  for (unsigned trial = 0; trial < trials; ++trial) {
    const Record a = with_noise(from, sigma, 2 * trial), c = with_noise(to, sigma, 2 * trial + 1);
    const auto v = phase_velocity({a, kFrom}, {c, kTo}, kDistance, {.noise = sigma});
    ASSERT_TRUE(v.ok()) << v.error().reason;  // a miss
    std::size_t n = 0;
    while (n + 1 < v.value().frequency.size() && v.value().frequency[n] < frequency) ++n;
    const double error = v.value().speed[n] / kSpeed - 1.0;
    squares += error * error / trials;
  }
  // The spread of a spread from 100 trials is 7 %; the taper takes 5 % of the noise away.
  EXPECT_LT(std::sqrt(squares), 1.3 * predicted);
  EXPECT_GT(std::sqrt(squares), predicted / 1.3);
}

TEST(PhaseVelocityOfAPulse, TheBandEndsWhereTheNoiseBegins) {
  // z where exp(-z^2/2) falls to six times the noise, 6 sigma sqrt(2750) dt/(width sqrt(2 pi)): 0.0251 for sigma = 0.02,
  // z = 2.71; 0.126 for sigma = 0.1, z = 2.04. Noise of a sixth of what is left there moves either by 1/(6 z), twice that
  // is allowed.
  const auto end_of_band = [&](double sigma) {
    const Record a = with_noise(dispersed(0.0, 0.0), sigma, 1), c = with_noise(dispersed(kDistance, 0.0), sigma, 2);
    const auto v = phase_velocity({a, kFrom}, {c, kTo}, kDistance, {.least_share = 0.02, .noise = sigma});
    return v.ok() ? v.value().frequency.back() * 2.0 * std::numbers::pi * kWidth : 0.0;
  };
  EXPECT_NEAR(end_of_band(0.02), 2.71, 2.0 / (6.0 * 2.71));
  EXPECT_NEAR(end_of_band(0.1), 2.04, 2.0 / (6.0 * 2.04));
}

void expect_refused(const Outcome<PhaseVelocity>& v, Failure failure) {
  ASSERT_FALSE(v.ok());
  EXPECT_EQ(name(v.error().failure), name(failure)) << v.error().reason;
}

TEST(PhaseVelocityRefuses, NoiseWithoutAPulse) {
  const Record silence = sample([](double) { return 0.0; }, kSamples, kDt);
  const Record pulse = dispersed(0.0, 0.0);
  for (unsigned trial = 0; trial < 200; ++trial) {
    const Record a = with_noise(silence, 1.0, 2 * trial), b = with_noise(silence, 1.0, 2 * trial + 1);
    EXPECT_FALSE(phase_velocity({a, kFrom}, {b, kTo}, kDistance, {.noise = 1.0}).ok());
    EXPECT_FALSE(phase_velocity({pulse, kFrom}, {b, kTo}, kDistance, {.noise = 1.0}).ok());
  }
  expect_refused(phase_velocity({pulse, kFrom}, {silence, kTo}, kDistance), Failure::flat);
}

TEST(PhaseVelocityRefuses, WhatIsNoDelayOrNoBand) {
  const Record from = dispersed(0.0, 0.0), to = dispersed(kDistance, 0.0);
  expect_refused(phase_velocity({to, kTo}, {from, kFrom}, kDistance), Failure::not_causal);
  // A band of one frequency: a tone that fills the window.
  const auto tone = [](double t) { return std::cos(2.0 * std::numbers::pi * 8e6 * t) * (t > 1e-6); };
  const Record wave = sample(tone, kSamples, kDt);
  EXPECT_FALSE(phase_velocity({wave, kFrom}, {wave, {1.01e-6, 3.01e-6}}, kDistance).ok());
  expect_refused(phase_velocity({from, {1e-6, 1e-6 + kDt}}, {to, kTo}, kDistance), Failure::empty_window);
  Record broken = to;
  broken.values[2000] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(phase_velocity({from, kFrom}, {broken, kTo}, kDistance), Failure::non_finite);
}

TEST(PhaseVelocityThrows, OnWrongUse) {
  const Record from = dispersed(0.0, 0.0), to = dispersed(kDistance, 0.0);
  EXPECT_THROW(phase_velocity({from, kFrom}, {to, kTo}, 0.0), std::invalid_argument);
  EXPECT_THROW(phase_velocity({from, {3e-6, 1e-6}}, {to, kTo}, kDistance), std::invalid_argument);
  EXPECT_THROW(phase_velocity({from, kFrom}, {to, kTo}, kDistance, {.least_share = 1.0}), std::invalid_argument);
  EXPECT_THROW(phase_velocity({from, kFrom}, {to, kTo}, kDistance, {.noise = -1.0}), std::invalid_argument);
  const Record coarse{to.values, 2 * kDt, 0.0};
  EXPECT_THROW(phase_velocity({from, kFrom}, {coarse, kTo}, kDistance), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::harness
