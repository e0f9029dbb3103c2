// A filter against its closed form: gain, and no delay.

#include "harness/measure/band_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "harness/measure/picker.h"
#include "synthetic.h"

namespace ddem::harness {
namespace {

using synthetic::gaussian;
using synthetic::Record;
using synthetic::sample;

constexpr double kDt = 1e-7;
constexpr Band kBand{50e3, 800e3};

/// Butterworth's squared magnitude 1/(1 + (f/f_c)^(2n)), n = 2, of the analogue filter: the bilinear transform leaves it as it is at
/// frequencies far below 1/(2 dt), so that it does not come from the code's own formula.
double analogue_gain(double f) {
  return 1.0 / (1.0 + std::pow(f / kBand.high, 4)) / (1.0 + std::pow(kBand.low / f, 4));
}

/// Amplitude and phase of a tone in the middle of a record, by its projection on 40 periods.
std::complex<double> response(double frequency) {
  const auto samples = static_cast<std::size_t>(200.0 / (frequency * kDt));
  const Record tone = sample([&](double t) { return std::cos(2.0 * std::numbers::pi * frequency * t); }, samples, kDt);
  const std::vector<double> out = band_pass(tone.values, kDt, kBand);
  std::complex<double> sum = 0.0;
  const auto first = static_cast<std::size_t>(80.0 / (frequency * kDt)), last = static_cast<std::size_t>(120.0 / (frequency * kDt));
  for (std::size_t n = first; n < last; ++n)
    sum += out[n] * std::polar(2.0, -2.0 * std::numbers::pi * frequency * static_cast<double>(n) * kDt);
  return sum / static_cast<double>(last - first);
}

TEST(BandPass, HasTheGainOfButterworthAndNoPhase) {
  for (const double f : {10e3, 50e3, 100e3, 200e3, 400e3}) {
    const std::complex<double> r = response(f);
    // Warping: tan(x)/x - 1 = x^2/3, x = pi 800e3 dt = 0.25 at the upper edge, of the fourth power of a ratio that is 1/16 at most.
    EXPECT_NEAR(std::abs(r) / analogue_gain(f), 1.0, 0.01) << f;
    EXPECT_NEAR(std::arg(r), 0.0, 0.005) << f;
  }
  for (const double f : {10e3, 50e3, 300e3, 800e3, 2e6}) EXPECT_NEAR(std::abs(response(f)) / band_pass_gain(f, kDt, kBand), 1.0, 0.01) << f;
  EXPECT_NEAR(band_pass_gain(800e3, kDt, {0.0, 800e3}), 0.5, 1e-12);
}

TEST(BandPass, LeavesCrestsWhereTheyAre) {
  for (int shift = 0; shift < 10; ++shift) {
    const double peak = 500.0 + 0.1 * shift;
    const Record pulse = sample([&](double t) { return gaussian(t, peak, 20.0); }, 1000);
    for (const Band band : {Band{0.0, 0.02}, Band{0.001, 0.0}, Band{0.001, 0.02}}) {
      const std::vector<double> out = band_pass(pulse.values, 1.0, band);
      const Pick pick = pick_peak({out, 1.0, 0.0}, {450.0, 550.0}, {.expected_amplitude = 1.0});
      ASSERT_TRUE(pick.ok()) << pick.error().reason;
      EXPECT_NEAR(pick.value().time, peak, 0.01);
    }
  }
}

TEST(BandPass, TakesOffsetsAndTrendsAwayAndLeavesNothingAtTheEnds) {
  const Record slope = sample([](double t) { return 5.0 + 0.01 * t; }, 2000);
  for (const double v : band_pass(slope.values, 1.0, {0.01, 0.1})) EXPECT_NEAR(v, 0.0, 1e-3);
  const std::vector<double> low = band_pass(slope.values, 1.0, {0.0, 0.1});
  for (std::size_t n = 0; n < low.size(); ++n) EXPECT_NEAR(low[n], slope.values[n], 1e-5);
}

TEST(BandPass, RefusesBandsWithoutSense) {
  const std::vector<double> x(100, 1.0);
  for (const Band band : {Band{0.0, 0.0}, Band{0.2, 0.1}, Band{0.0, 0.5}, Band{0.6, 0.0}, Band{-0.1, 0.2}, Band{0.1, std::nan("")}})
    EXPECT_THROW(band_pass(x, 1.0, band), std::invalid_argument) << band.low << " " << band.high;
  EXPECT_THROW(band_pass(x, 0.0, {0.0, 0.1}), std::invalid_argument);
  EXPECT_TRUE(band_pass({}, 1.0, {0.0, 0.1}).empty());
}

}  // namespace
}  // namespace ddem::harness
