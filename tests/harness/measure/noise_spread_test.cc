// What noise does to sums of samples, and tops and feet of noisy pulses.

#include "harness/measure/noise_spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "coloured_noise.h"
#include "harness/measure/local_line.h"

namespace ddem::harness {
namespace {

using synthetic::Record;
using synthetic::sample;
using synthetic::sin2;
using synthetic::with_noise;

TEST(ProjectedNoise, OfWhiteNoiseIsTheRootOfTheSquaredWeights) {
  const Record noise = with_noise(sample([](double) { return 0.0; }, 40000), 0.3, 1);
  const std::vector<double> slopes = slope_weights(7);
  double squares = 0.0;
  for (const double w : slopes) squares += w * w;
  // 40000/15 independent pieces: 1/sqrt(5300) = 1.4 %; five of those.
  EXPECT_NEAR(projected_noise(noise.values, slopes) / (0.3 * std::sqrt(squares)), 1.0, 0.07);
  EXPECT_NEAR(projected_noise(noise.values, value_weights(50)) / (0.3 / std::sqrt(101.0)), 1.0, 0.2);
  EXPECT_EQ(projected_noise({}, slopes), 0.0);
  // Slow noise moves a mean by its whole height.
  const std::vector<double> slow(100, 0.3);
  EXPECT_NEAR(projected_noise(slow, value_weights(5)), 0.3, 1e-12);
}

TEST(CorrelationLength, OfNoiseOfKnownColour) {
  // y_n = a y_(n-1) + white: 1 + 2 (a + a^2 + ..) = (1 + a)/(1 - a). The sum of correlations of 20000 samples up to the first that
  // is not positive is known to a tenth or so.
  synthetic::Noise random(3);
  for (const double a : {0.0, 0.5, 0.9, 0.97}) {
    const double expected = (1.0 + a) / (1.0 - a);
    EXPECT_NEAR(correlation_length(synthetic::autoregressive(random, 20000, a, 0.0)) / expected, 1.0, 0.2) << a;
  }
  EXPECT_EQ(correlation_length({}), 1.0);
}

/// The density of Student's t, integrated numerically: an oracle for the tables.
double student_cumulative(double t, double dof) {
  const double constant = std::exp(std::lgamma(0.5 * (dof + 1.0)) - std::lgamma(0.5 * dof)) / std::sqrt(dof * std::numbers::pi);
  // t = tan(x): the tail of one degree of freedom is long.
  double sum = 0.0;
  constexpr int steps = 200000;
  const double end = std::atan(t);
  for (int k = 0; k < steps; ++k) {
    const double x = end * (k + 0.5) / steps, s = std::tan(x);
    sum += constant * std::pow(1.0 + s * s / dof, -0.5 * (dof + 1.0)) * (1.0 + s * s) * end / steps;
  }
  return 0.5 + sum;
}

TEST(Student, TablesAreItsQuantiles) {
  for (int dof = 1; dof <= 10; ++dof) {
    EXPECT_NEAR(student_cumulative(student_widening(dof) * 1.96, dof), 0.975, 2e-5) << dof;
    EXPECT_NEAR(student_cumulative(student_threshold(dof), dof), 0.999, 2e-6) << dof;
  }
  for (const double dof : {12.0, 30.0, 200.0}) EXPECT_NEAR(student_cumulative(student_widening(dof) * 1.96, dof), 0.975, 1e-3) << dof;
  EXPECT_EQ(student_widening(0.1), student_widening(1.0));
  EXPECT_EQ(student_threshold(0.9), std::numeric_limits<double>::infinity());
}

TEST(SmoothTop, IsBelowTheSamplingStep) {
  for (const double width : {4.0, 8.0, 30.0}) {
    const auto half = std::max<std::ptrdiff_t>(1, std::lround(0.3 * width));
    for (int shift = 0; shift < 20; ++shift) {
      const double peak = 200.0 + shift / 20.0;
      const Record r = sample([&](double t) { return sin2(t, peak, 2.0 * width); }, 400);
      const auto top = smooth_top(r.values, 201.0, width, half);
      ASSERT_TRUE(top);
      // 0.41 dt (dt/width)^2, as a parabola through three samples.
      EXPECT_NEAR(top->index, peak, 0.41 / (width * width)) << width;
      EXPECT_LT(top->curvature, 0.0);
    }
  }
  EXPECT_FALSE(smooth_top(std::vector<double>(100, 1.0), 50.0, 20.0, 3));
}

TEST(TangentFoot, OfASquaredSineIsKnown) {
  // sin^2(pi t/T): steepest at T/4, value 1/2, slope pi/T: the tangent meets zero at T/4 - T/(2 pi) after the foot.
  for (const double width : {4.0, 4.5, 5.0, 6.0, 8.0, 12.0, 20.0, 30.0, 100.0}) {
    const double duration = 2.0 * width;
    const auto half = std::max<std::ptrdiff_t>(1, std::lround(0.25 * width));
    double least = 1e9, most = -1e9;
    for (int shift = 0; shift < 20; ++shift) {
      const double peak = 300.0 + shift / 20.0;
      const Record r = sample([&](double t) { return sin2(t, peak, duration); }, 700);
      const auto foot = tangent_foot(r.values, peak, duration, half);
      ASSERT_TRUE(foot);
      const double exact = peak - 0.5 * duration + duration * (0.25 - 0.5 / std::numbers::pi);
      least = std::min(least, foot->index - exact), most = std::max(most, foot->index - exact);
      // Smoothing makes the slope smaller, and the foot earlier, by the same everywhere.
      EXPECT_NEAR(foot->index, exact, 0.06 * width + 0.2) << width;
    }
    // Where the samples lie matters less: what counts for a delay.
    EXPECT_LT(0.5 * (most - least), 1.2 / (width * width) * (1.0 + 16.0 / (width * width)) + 1e-3) << width;
  }
  EXPECT_FALSE(tangent_foot(std::vector<double>(100, 1.0), 50.0, 20.0, 3));
}

}  // namespace
}  // namespace ddem::harness
