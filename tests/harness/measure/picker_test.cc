// Arrivals of synthetic pulses whose peak is known.

#include "harness/measure/picker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "synthetic.h"

namespace ddem::harness {
namespace {

using synthetic::gaussian;
using synthetic::Record;
using synthetic::sample;
using synthetic::sin2;
using synthetic::with_noise;

double picked_time(const Pick& pick) {
  EXPECT_TRUE(pick.ok()) << (pick.ok() ? "" : pick.error().reason);
  return pick.ok() ? pick.value().time : std::nan("");
}

// cos^2 x = 1 - x^2 + x^4/3. The run of samples over the top 6 % (|x| <= w, w^2 = 0.0625) is centred within
// half a step of the peak; with d that offset, the fitted vertex is off by d (0.114 w^2) = 0.007 d <= 0.0036
// steps for many samples, and by d h^2/3 for three samples h apart, w <= h: 0.0104 steps at h = w. Below
// three samples the neighbours' parabola spans 2 h: d h^2/3, h < 2 w: 0.042 steps.
TEST(PickPeak, FindsASmoothPulseBelowTheSamplingStep) {
  struct Case {
    double duration;  // in steps
    double tolerance;
  };
  for (const Case& c : {Case{400.0, 0.0036}, Case{100.0, 0.0036}, Case{30.0, 0.0105}, Case{14.0, 0.042}}) {
    for (int shift = 0; shift < 40; ++shift) {
      const double peak = 600.0 + shift / 40.0;
      const Record record = sample([&](double t) { return sin2(t, peak, c.duration); }, 1200);
      const Pick pick = pick_peak(record, {300.0, 1000.0});
      EXPECT_NEAR(picked_time(pick), peak, c.tolerance) << c.duration;
      // The least-squares parabola overshoots by a fraction of the fourth-order term, w^4/3 = 0.0013; three
      // points at most by h^4/3 of a coarse pulse.
      EXPECT_NEAR(pick.value().amplitude, 1.0, c.duration > 50 ? 0.0013 : 0.003);
    }
  }
}

TEST(PickPeak, PickOnTheGridWouldBeWorse) {
  // The same pulses picked at their largest sample miss by up to half a step: the tolerance above can fail.
  const double peak = 600.5;
  const Record record = sample([&](double t) { return sin2(t, peak - 0.05, 400.0); }, 1200);
  const Pick pick = pick_peak(record, {300.0, 1000.0});
  EXPECT_GT(std::abs(std::round(picked_time(pick)) - (peak - 0.05)), 0.4);
}

TEST(PickPeak, IsInvariantUnderScaleSignAndUnits) {
  const auto pulse = [](double t) { return gaussian(t, 250.37, 25.0) * (1.0 + 0.002 * (t - 250.37)); };
  const double reference = picked_time(pick_peak(sample(pulse, 500), {150.0, 400.0}));
  for (const double scale : {1e-12, 1e-6, 3.0, 1e9}) {
    const Record up = sample([&](double t) { return scale * pulse(t); }, 500);
    EXPECT_NEAR(picked_time(pick_peak(up, {150.0, 400.0})), reference, 1e-9);
    const Record down = sample([&](double t) { return -scale * pulse(t); }, 500);
    const Pick negative = pick_peak(down, {150.0, 400.0}, {.polarity = Polarity::negative});
    EXPECT_NEAR(picked_time(negative), reference, 1e-9);
    EXPECT_LT(negative.value().amplitude, 0.0);
  }
  // Nanoseconds, and a start other than zero.
  const Record shifted = sample([&](double t) { return pulse((t - 2e-6) / 1e-9); }, 500, 1e-9, 2e-6);
  EXPECT_NEAR(picked_time(pick_peak(shifted, {2e-6 + 150e-9, 2e-6 + 400e-9})), 2e-6 + reference * 1e-9,
              1e-17);
}

TEST(PickPeak, LooksAtTheExpectedSignOnly) {
  const Record record =
      sample([](double t) { return gaussian(t, 300.0, 20.0) - 2.0 * gaussian(t, 450.0, 20.0); }, 700);
  EXPECT_NEAR(picked_time(pick_peak(record, {150.0, 600.0})), 300.0, 0.004);
  EXPECT_NEAR(picked_time(pick_peak(record, {150.0, 600.0}, {.polarity = Polarity::negative})), 450.0, 0.004);
}

TEST(PickPeak, ReflectionOutsideTheCausalWindowDoesNotMatter) {
  // A fixed or free end sends back a pulse that doubles the displacement on its way: higher than the arrival.
  const Record record =
      sample([](double t) { return gaussian(t, 300.25, 20.0) + 1.8 * gaussian(t, 520.0, 20.0); }, 800);
  EXPECT_NEAR(picked_time(pick_peak(record, {200.0, 400.0})), 300.25, 0.004);
  // Without the window's end it is the reflection that is found.
  EXPECT_NEAR(picked_time(pick_peak(record, {200.0, 700.0})), 520.0, 0.004);
}

TEST(PickPeak, NoiseMovesThePickByItsPredictedSpread) {
  // A quadratic fitted over n samples of noise sigma has a slope in the middle that is uncertain by
  // sigma sqrt(12/n^3); on A (1 - (t/a)^2), a = duration/pi, the vertex moves by a^2/2 times that. The run is
  // widened by the noise: it reaches to 0.06 + 6 sigma below the highest sample, which itself stands about
  // 2.5 sigma above the pulse, so its half width is a sqrt(0.06 + 3.5 sigma).
  constexpr double duration = 400.0, peak = 1000.3, sigma = 0.02;
  const double a = duration / std::numbers::pi;
  const double n = 2.0 * a * std::sqrt(0.06 + 3.5 * sigma);
  const double predicted = std::sqrt(12.0 / (n * n * n)) * sigma * a * a / 2.0;  // 0.64 steps
  const Record clean = sample([&](double t) { return sin2(t, peak, duration); }, 2000);
  double mean = 0.0, squares = 0.0;
  constexpr int trials = 200;
  for (unsigned trial = 0; trial < trials; ++trial) {
    const double error = picked_time(pick_peak(with_noise(clean, sigma, trial), {600.0, 1500.0})) - peak;
    mean += error / trials;
    squares += error * error / trials;
  }
  // Bias: five standard errors of the mean. Spread: the run's ends depend on the noise, hence a factor
  // of 1.5.
  EXPECT_LT(std::abs(mean), 5.0 * predicted / std::sqrt(trials));
  EXPECT_LT(std::sqrt(squares), 1.5 * predicted);
  EXPECT_GT(std::sqrt(squares), predicted / 1.5);
}

TEST(PickPeak, FindsPulsesWellAboveTheNoise) {
  // Misses: the pulse is 10 noise levels high, the threshold 6; a miss needs noise of -4 levels at the top.
  const Record clean = sample([](double t) { return sin2(t, 600.0, 300.0); }, 1000);
  int found = 0;
  for (unsigned trial = 0; trial < 200; ++trial)
    found += pick_peak(with_noise(clean, 0.1, 1000 + trial), {400.0, 900.0}).ok();
  EXPECT_EQ(found, 200);
}

TEST(PickPeak, DispersedPulseIsOffByItsSkewness) {
  // A Gaussian that has run through a medium omega = k - b k^3 trails an oscillating tail, as the column
  // release and the S0 wave do: u = sum_k exp(-k^2 s^2/2) cos(k t' - b x k^3). `order` derivatives of it:
  const auto pulse = [](double t, int order) {
    double u = 0.0;
    for (int m = 0; m < 400; ++m) {
      const double k = (m + 0.5) * 0.001;
      const double phase = k * (t - 400.0) - 3000.0 * k * k * k + order * std::numbers::pi / 2.0;
      u += std::exp(-0.5 * 144.0 * k * k) * std::pow(k, order) * std::cos(phase);
    }
    return u;
  };
  double reference = 415.0;  // of the peak, by Newton's method
  for (int n = 0; n < 20; ++n) reference -= pulse(reference, 1) / pulse(reference, 2);
  ASSERT_NEAR(reference, 418.085, 1e-3);
  // Least squares on A - c z^2 + d z^3 over |z| <= w, c w^2 = 0.06 A, moves the vertex by 0.3 (d/c) w^2. The
  // next terms are smaller by d w/c = 0.1 or so.
  const double amplitude = pulse(reference, 0), c = -pulse(reference, 2) / 2.0, d = pulse(reference, 3) / 6.0;
  const double skewness_shift = 0.3 * d / c * 0.06 * amplitude / c;
  const Record record = sample([&](double t) { return pulse(t, 0); }, 800);
  const Pick pick = pick_peak(record, {330.0, 700.0}, {.expected_amplitude = amplitude});
  EXPECT_NEAR(picked_time(pick), reference + skewness_shift, 0.3 * std::abs(skewness_shift));
  EXPECT_LT(std::abs(skewness_shift), 0.5);
}

TEST(PickCentroid, OfASymmetricPulseIsItsPeak) {
  for (int shift = 0; shift < 20; ++shift) {
    const double peak = 500.0 + shift / 20.0;
    const Record record = sample([&](double t) { return sin2(t, peak, 200.0); }, 1000);
    const Pick pick = pick_centroid(record, {300.0, 800.0}, 100.0);
    // The window is centred on the measured peak, which is off by at most 0.0036 steps; where the pulse ends,
    // sin^2 is quadratic, so cutting it there costs nothing.
    EXPECT_NEAR(picked_time(pick), peak, 1e-3);
  }
}

TEST(PickCentroid, OfASkewPulseIsTheFirstMoment) {
  // A triangle that rises over 50 and falls over 150: centroid at (0 + 50 + 200)/3 after its foot. The
  // corner's parabola misses the peak by a few steps, which moves the window, not the centroid: the signal is
  // zero there.
  const Record record = sample(
      [](double t) {
        const double s = t - 400.0;
        return s < 50.0 ? std::max(0.0, s / 50.0) : std::max(0.0, (200.0 - s) / 150.0);
      },
      1000);
  const Pick pick = pick_centroid(record, {300.0, 800.0}, 180.0);
  EXPECT_NEAR(picked_time(pick), 400.0 + 250.0 / 3.0, 1e-3);
}

TEST(PickCentroid, NoiseMovesThePickByItsPredictedSpread) {
  // Noise sigma in the first moment over +-h, h half the duration: sigma sqrt(2 h^3/3) over the area of the pulse,
  // duration/2: sigma sqrt(duration/3) = 0.23 steps, a third of the peak's spread at the same noise. That the window
  // follows the noisy peak costs nothing: the pulse is zero at its ends.
  constexpr double duration = 400.0, peak = 1000.3, sigma = 0.02;
  const double predicted = sigma * std::sqrt(duration / 3.0);
  const Record clean = sample([&](double t) { return sin2(t, peak, duration); }, 2000);
  double mean = 0.0, squares = 0.0;
  constexpr int trials = 200;
  for (unsigned trial = 0; trial < trials; ++trial) {
    const double error = picked_time(pick_centroid(with_noise(clean, sigma, trial), {600.0, 1500.0}, 0.5 * duration)) - peak;
    mean += error / trials;
    squares += error * error / trials;
  }
  // Five standard errors of the mean; of the spread itself 5 %, five of them.
  EXPECT_LT(std::abs(mean), 5.0 * predicted / std::sqrt(trials));
  EXPECT_NEAR(std::sqrt(squares) / predicted, 1.0, 0.25);
}

TEST(PickCentroid, AReflectionBehindItsWindowDoesNotMatter) {
  const auto pulse = [](double t) { return sin2(t, 300.25, 100.0); };
  const Record clean = sample(pulse, 800);
  const Record echo = sample([&](double t) { return pulse(t) + 1.8 * sin2(t, 420.0, 100.0); }, 800);
  const double expected = picked_time(pick_centroid(clean, {200.0, 360.0}, 50.0));
  EXPECT_NEAR(picked_time(pick_centroid(echo, {200.0, 360.0}, 50.0)), expected, 1e-9);
  // Of a wider window it is a part: this can fail.
  EXPECT_GT(picked_time(pick_centroid(echo, {200.0, 360.0}, 120.0)), expected + 1.0);
}

TEST(PickCentroid, DispersionMovesThePeakAndNotTheCentroid) {
  // The medium of the test above with a fifth of its dispersion: infinitely long waves arrive at 400, and the first moment
  // with them; the top of a gaussian of width 12 comes some steps later. What the window of +-180 cuts off at the end is
  // late by 3 * 600 k^2 > 180, k > 0.31, exp(-72 k^2) = 1e-3 of the spectrum: an oscillation of that height over the last
  // 1/k = 3 steps, 180 steps away: 180 * 3 * 1e-3/12 = 0.05 steps.
  const Record record = sample(
      [](double t) {
        double u = 0.0;
        for (double k = 0.0005; k < 0.5; k += 0.001) u += std::exp(-72.0 * k * k) * std::cos(k * (t - 400.0) - 600.0 * k * k * k);
        return u;
      },
      800);
  EXPECT_GT(picked_time(pick_peak(record, {330.0, 700.0}, {.expected_amplitude = 50.0})), 404.0);
  EXPECT_NEAR(picked_time(pick_centroid(record, {330.0, 700.0}, 180.0, {.expected_amplitude = 50.0})), 400.0, 0.05);
}

TEST(PickCentroid, FalseAlarmsAndMisses) {
  const Record silence = sample([](double) { return 0.0; }, 1000);
  const Record clean = sample([](double t) { return sin2(t, 600.0, 200.0); }, 1000);
  for (unsigned trial = 0; trial < 200; ++trial) {
    EXPECT_FALSE(pick_centroid(with_noise(silence, 0.1, trial), {400.0, 850.0}, 100.0).ok());
    EXPECT_TRUE(pick_centroid(with_noise(clean, 0.1, 1000 + trial), {400.0, 850.0}, 100.0).ok());
  }
}

TEST(PickCentroid, WindowMustLieInsideTheSignal) {
  const Record record = sample([](double t) { return sin2(t, 100.0, 60.0); }, 140);
  EXPECT_TRUE(pick_centroid(record, {50.0, 130.0}, 39.0).ok());
  const Pick pick = pick_centroid(record, {50.0, 130.0}, 45.0);
  ASSERT_FALSE(pick.ok());
  EXPECT_EQ(pick.error().failure, Failure::at_edge);
}

}  // namespace
}  // namespace ddem::harness
