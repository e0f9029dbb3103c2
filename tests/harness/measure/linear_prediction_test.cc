// Growth read from synthetic signals with known factors.

#include "harness/measure/linear_prediction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

namespace ddem::harness {
namespace {

using Complex = std::complex<double>;
using Signals = std::vector<std::vector<double>>;

/// Signals of `receivers` receivers: the real part of each motion, with phases of its own.
Signals motions(const std::vector<Complex>& factors, std::size_t receivers, std::size_t samples) {
  Signals s(receivers, std::vector<double>(samples, 0.0));
  for (std::size_t r = 0; r < receivers; ++r) {
    for (std::size_t m = 0; m < factors.size(); ++m) {
      const Complex shape = std::polar(1.0, 1.7 * static_cast<double>(r * (m + 1)) + static_cast<double>(m));
      for (std::size_t n = 0; n < samples; ++n) s[r][n] += (shape * std::pow(factors[m], static_cast<double>(n))).real();
    }
  }
  return s;
}

TEST(LinearPrediction, FindsWhatGrowsMost) {
  const Signals s = motions({std::polar(1.001, 0.4), std::polar(0.998, 0.9), std::polar(0.97, 2.0)}, 5, 60);
  const Prediction p = predict_linearly(s, 0, 60, 1e-10);
  // Round-off 1e-16 times the conditioning of six columns that differ by turns of 0.4 to 2 rad, 1e3 or so.
  EXPECT_NEAR(p.largest(), 1.001, 1e-11);
  EXPECT_EQ(p.factors.size(), 6u);
  EXPECT_LT(p.residual, 1e-10);
}

TEST(LinearPrediction, OfOneRealMotionIsOfFirstOrder) {
  const Prediction p = predict_linearly(motions({Complex(-1.7)}, 3, 8), 2, 8, 1e-10);
  ASSERT_EQ(p.factors.size(), 1u);
  EXPECT_NEAR(p.factors[0].real(), -1.7, 1e-13);
}

TEST(LinearPrediction, LeavesOutRootsWithoutAMotion) {
  // Noise of 1e-7 keeps the residual above what is asked for, and higher orders have roots that stand for nothing.
  Signals s = motions({std::polar(0.99, 0.3)}, 6, 60);
  unsigned state = 1;
  for (auto& signal : s) {
    for (double& v : signal) state = state * 1664525u + 1013904223u, v += 1e-7 * (static_cast<double>(state) / 4294967296.0 - 0.5);
  }
  const Prediction p = predict_linearly(s, 0, 60, 1e-12);
  // 360 equations with a noise of 3e-8: 3e-8/sqrt(360), times 60 for the lever of a decay over the window.
  EXPECT_NEAR(p.largest(), 0.99, 1e-7);
  EXPECT_EQ(p.factors.size(), 2u);
}

// Five factors ask for a recurrence of six, of which one root is no motion.
TEST(LinearPrediction, LeavesOutTheRootThatCompletesAnOrder) {
  const std::vector<Complex> factors = {std::polar(1.01, 0.3), std::polar(0.97, 1.1), Complex(0.9)};
  const Prediction p = predict_linearly(motions(factors, 4, 40), 0, 40, 1e-10);
  ASSERT_EQ(p.factors.size(), 5u);
  for (const Complex& expected : factors) {
    double nearest = 1.0;
    for (const Complex& z : p.factors) nearest = std::min(nearest, std::abs(z - expected));
    EXPECT_LT(nearest, 1e-10);
  }
}

// Shares on both sides of 1e-4 of the largest, of motions that oscillate at every angle.
TEST(LinearPrediction, KeepsAMotionByItsShare) {
  for (const double angle : {0.2, 0.7, 1.5, 2.6}) {
    for (const double share : {1.1e-4, 0.9e-4}) {
      Signals s = motions({Complex(0.99)}, 1, 40);
      for (std::vector<double>& signal : s) {
        const double size = std::abs(signal[0]);  // that of the largest motion, which is real
        // A pair of conjugate factors, each of half the amplitude.
        for (std::size_t n = 0; n < signal.size(); ++n) signal[n] += 2.0 * share * size * std::cos(angle * static_cast<double>(n));
      }
      const Prediction p = predict_linearly(s, 0, 40, 1e-12);
      EXPECT_EQ(p.factors.size(), share > 1e-4 ? 3u : 1u) << angle << ' ' << share;
    }
  }
}

TEST(LinearPrediction, OfNothingHasNoFactors) {
  EXPECT_TRUE(predict_linearly(Signals(2, std::vector<double>(20, 0.0)), 0, 20, 1e-8).factors.empty());
  EXPECT_TRUE(predict_linearly(motions({Complex(1.0)}, 2, 20), 5, 6, 1e-8).factors.empty());
  EXPECT_EQ(Prediction{}.largest(), 0.0);
}

TEST(LinearPrediction, ChecksItsSignals) {
  EXPECT_THROW(predict_linearly(Signals(2, std::vector<double>(10, 1.0)), 0, 11, 1e-8), std::invalid_argument);
  Signals bad(2, std::vector<double>(10, 1.0));
  bad[1][3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(predict_linearly(bad, 0, 10, 1e-8), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::harness
