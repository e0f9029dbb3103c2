#include "harness/measure/correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "synthetic.h"

namespace ddem::harness {
namespace {

using synthetic::gaussian;
using synthetic::Record;
using synthetic::sample;
using synthetic::with_noise;

Record pulse(double peak, std::size_t count = 600) {
  return sample([=](double t) { return gaussian(t, peak, 15.0) * (1.0 + 0.01 * (t - peak)); }, count);
}

TEST(CorrelationDelay, FindsAKnownDelayBelowTheSamplingStep) {
  // The correlation is a smooth even function about the delay, of standard width 15 sqrt(2) steps: the
  // parabola over its top 6 % is off by 0.007 of the run's offset, which is at most half a step (see
  // picker_test.cc; the fourth-order term of a Gaussian, 1/2 of x^4 with the top written 1 - x^2, is 1.5
  // times that of cos^2).
  for (int shift = 0; shift < 20; ++shift) {
    const double delay = 200.0 + shift / 20.0;
    const Outcome<double> measured = correlation_delay(pulse(150.0), pulse(150.0 + delay), {0.0, 400.0});
    ASSERT_TRUE(measured.ok()) << measured.error().reason;
    EXPECT_NEAR(measured.value(), delay, 0.0055);
  }
}

TEST(CorrelationDelay, SignScaleOrderLengthAndStart) {
  const Outcome<double> back = correlation_delay(pulse(350.25), pulse(150.0), {-400.0, 0.0});
  ASSERT_TRUE(back.ok());
  EXPECT_NEAR(back.value(), -200.25, 0.0055);

  Record small = pulse(350.25, 450);
  for (double& v : small.values) v *= 1e-200;  // whose squares underflow
  const Outcome<double> scaled = correlation_delay(pulse(150.0), small, {0.0, 400.0});
  ASSERT_TRUE(scaled.ok());
  EXPECT_NEAR(scaled.value(), 200.25, 0.0055);

  const Record late = sample([](double t) { return gaussian(t, 1350.25, 15.0); }, 400, 1.0, 1200.0);
  const Record early = sample([](double t) { return gaussian(t, 150.0, 15.0); }, 600);
  const Outcome<double> start = correlation_delay(early, late, {1000.0, 1300.0});
  ASSERT_TRUE(start.ok());
  EXPECT_NEAR(start.value(), 1200.25, 0.0055);
}

TEST(CorrelationDelay, SurvivesNoise) {
  // Matched-filter bound: sd = sigma / sqrt(sum f'^2); for a Gaussian of width s sum f'^2 = sqrt(pi)/(2 s),
  // with noise in both signals sqrt(2) more: 0.05 * sqrt(2) * sqrt(30/1.772) = 0.29 steps. Five of them.
  for (unsigned trial = 0; trial < 50; ++trial) {
    const Record from = with_noise(pulse(150.0), 0.05, 2 * trial);
    const Record to = with_noise(pulse(350.5), 0.05, 2 * trial + 1);
    const Outcome<double> measured = correlation_delay(from, to, {100.0, 300.0});
    ASSERT_TRUE(measured.ok()) << measured.error().reason;
    EXPECT_NEAR(measured.value(), 200.5, 1.5);
  }
}

TEST(CorrelationDelay, ReflectionIsCutOffBySlice) {
  const Record from = pulse(150.0, 900);
  const Record to =
      sample([](double t) { return gaussian(t, 300.0, 15.0) + 2.0 * gaussian(t, 600.0, 15.0); }, 900);
  const Outcome<double> whole = correlation_delay(from, to, {0.0, 700.0});
  ASSERT_TRUE(whole.ok());
  EXPECT_NEAR(whole.value(), 450.0, 3.0);
  const Outcome<double> causal = correlation_delay(from, slice(to, {0.0, 450.0}), {0.0, 700.0});
  ASSERT_TRUE(causal.ok());
  EXPECT_NEAR(causal.value(), 150.0, 3.0);  // the two pulses differ in skewness
}

TEST(CorrelationDelay, OfADispersedPulseIsThatOfItsSteepParts) {
  // Each frequency is late by tau (1 + b z^2), z its share of the gaussian's 1/width. The top of int |A|^2 cos(w (t_z - t))
  // lies, to first order in b, where int |A|^2 w^2 (t_z - t) = 0: at tau (1 + b <z^4>/<z^2>) = tau (1 + 3 b/2) for |A|^2 =
  // exp(-z^2). Next order: (b tau/width)^2 = 4e-4 of what b does; the pick errs by 0.0055 (above).
  constexpr double width = 15.0, delay = 200.0, b = 0.0015;
  const auto dispersed = [&](double tau, double factor) {
    return sample(
        [=](double t) {
          double u = 0.5;
          for (double z = 0.05; z < 6.0; z += 0.05) u += std::exp(-0.5 * z * z) * std::cos(z * (t - 150.0 - tau * (1.0 + factor * z * z)) / width);
          return u;
        },
        600);
  };
  const Outcome<double> measured = correlation_delay(dispersed(0.0, b), dispersed(delay, b), {0.0, 400.0});
  ASSERT_TRUE(measured.ok()) << measured.error().reason;
  EXPECT_NEAR(measured.value(), delay * (1.0 + 1.5 * b), 0.02);
}

TEST(CorrelationDelay, FalseAlarmsAndMisses) {
  // The coefficient of independent noise in 600 samples has a standard deviation of 0.04, and reaches 0.5 never. A pulse with
  // noise of a tenth of its height: coefficient E/(E + 600 * 0.01), E = sqrt(pi) 15, is 0.8.
  const Record silence = sample([](double) { return 0.0; }, 600);
  for (unsigned trial = 0; trial < 200; ++trial) {
    const Record a = with_noise(silence, 1.0, 4 * trial), c = with_noise(silence, 1.0, 4 * trial + 1);
    EXPECT_FALSE(correlation_delay(a, c, {-300.0, 300.0}).ok());
    EXPECT_FALSE(correlation_delay(pulse(150.0), c, {-300.0, 300.0}).ok());
    const Record from = with_noise(pulse(150.0), 0.1, 4 * trial + 2), to = with_noise(pulse(350.0), 0.1, 4 * trial + 3);
    EXPECT_TRUE(correlation_delay(from, to, {100.0, 300.0}).ok());
  }
}

void expect_refused(const Outcome<double>& delay, Failure failure) {
  ASSERT_FALSE(delay.ok());
  EXPECT_EQ(name(delay.error().failure), name(failure)) << delay.error().reason;
}

TEST(CorrelationDelay, Refuses) {
  const Record silence = sample([](double) { return 0.0; }, 600);
  // The coefficient of independent noise has a standard deviation of 1/sqrt(600) = 0.04.
  expect_refused(correlation_delay(with_noise(silence, 1.0, 1), with_noise(silence, 1.0, 2), {-300.0, 300.0}),
                 Failure::below_noise);
  expect_refused(correlation_delay(pulse(150.0), silence, {0.0, 400.0}), Failure::flat);
  expect_refused(correlation_delay(pulse(150.0), pulse(350.0), {0.0, 195.0}), Failure::at_edge);
  expect_refused(correlation_delay(pulse(150.0), pulse(350.0), {2000.0, 3000.0}), Failure::empty_window);
  const Record twice =
      sample([](double t) { return gaussian(t, 200.0, 15.0) + gaussian(t, 400.0, 15.0); }, 600);
  expect_refused(correlation_delay(pulse(100.0), twice, {0.0, 500.0}), Failure::ambiguous);
  Record broken = pulse(350.0);
  broken.values[3] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(correlation_delay(pulse(150.0), broken, {0.0, 400.0}), Failure::non_finite);
  const Record coarse = sample([](double t) { return gaussian(t, 200.0, 15.0); }, 300, 2.0);
  EXPECT_THROW(correlation_delay(pulse(150.0), coarse, {0.0, 400.0}), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::harness
