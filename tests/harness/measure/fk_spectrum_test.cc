// Dispersion from frequency-wavenumber spectra: synthetic waves, noise, bad input.

#include "harness/measure/fk_spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace ddem::harness {
namespace {

using Lines = std::vector<std::vector<double>>;

constexpr std::size_t kReceivers = 64, kSamples = 1000;
constexpr double kSpacing = 0.5, kDt = 0.1;

double dispersion(double k) { return 2.0 * std::sin(0.5 * k * kSpacing); }

/// A wave of each of some wavenumbers, to the right and (half as high) to the left.
Lines waves(const std::vector<int>& harmonics) {
  Lines u(kReceivers, std::vector<double>(kSamples, 0.0));
  for (const int m : harmonics) {
    const double k = 2.0 * std::numbers::pi * m / (kReceivers * kSpacing), omega = dispersion(k);
    for (std::size_t x = 0; x < kReceivers; ++x) {
      for (std::size_t n = 0; n < kSamples; ++n) {
        const double kx = k * kSpacing * static_cast<double>(x), wt = omega * kDt * static_cast<double>(n);
        u[x][n] += std::cos(kx - wt + m) + 0.5 * std::cos(kx + wt);
      }
    }
  }
  return u;
}

TEST(FkSpectrum, FindsTheDispersionRelation) {
  const std::vector<int> harmonics{5, 12, 20, 31};
  const auto ridge = main_ridge(fk_spectrum(waves(harmonics), kSpacing, kDt));
  for (const int m : harmonics) {
    const double k = 2.0 * std::numbers::pi * m / (kReceivers * kSpacing);
    const auto point = std::find_if(ridge.begin(), ridge.end(), [&](const RidgePoint& p) { return std::abs(p.wavenumber - k) < 1e-9; });
    ASSERT_NE(point, ridge.end()) << m;
    // A fiftieth of the resolved interval 2 pi / duration.
    EXPECT_NEAR(point->frequency, dispersion(k), 0.02 * 2.0 * std::numbers::pi / (kSamples * kDt)) << m;
  }
}

TEST(FkSpectrum, FindsALowCrestNearItsBranch) {
  // Waves of one wavenumber and two frequencies: the lower crest is found where it is asked for.
  const double k = 2.0 * std::numbers::pi * 12 / (kReceivers * kSpacing), high = dispersion(k), low = 0.6 * high;
  Lines u = waves({12});
  for (std::size_t x = 0; x < kReceivers; ++x) {
    for (std::size_t n = 0; n < kSamples; ++n) u[x][n] += 0.2 * std::cos(k * kSpacing * static_cast<double>(x) - low * kDt * static_cast<double>(n));
  }
  const FkSpectrum s = fk_spectrum(u, kSpacing, kDt);
  const double resolved = 2.0 * std::numbers::pi / (kSamples * kDt);
  const auto crest = crest_near(s, 12, 1.02 * low, 0.05);
  ASSERT_TRUE(crest.has_value());
  EXPECT_NEAR(crest->frequency, low, 0.02 * resolved);
  EXPECT_NEAR(crest_near(s, 12, high, 0.05).value().frequency, high, 0.02 * resolved);
}

TEST(FkSpectrum, AxesReachTheNyquistLimits) {
  const FkSpectrum s = fk_spectrum(waves({5}), kSpacing, kDt);
  EXPECT_NEAR(s.wavenumber.back(), std::numbers::pi / kSpacing, 1e-12);
  EXPECT_NEAR(s.frequency.back(), std::numbers::pi / kDt, 1e-9);
  EXPECT_EQ(s.amplitude.rows(), static_cast<Eigen::Index>(s.wavenumber.size()));
  EXPECT_EQ(s.amplitude.cols(), static_cast<Eigen::Index>(s.frequency.size()));
}

TEST(FkSpectrum, NoiseAndSilenceHaveNoRidge) {
  Lines noise(kReceivers, std::vector<double>(kSamples));
  std::mt19937_64 generator(3);
  for (auto& line : noise) {
    for (double& u : line) u = static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1.0;
  }
  EXPECT_TRUE(main_ridge(fk_spectrum(noise, kSpacing, kDt)).empty());
  EXPECT_TRUE(main_ridge(fk_spectrum(Lines(kReceivers, std::vector<double>(kSamples, 3.0)), kSpacing, kDt)).empty());
}

TEST(FkSpectrum, RefusesWhatIsNoSpectrum) {
  Lines good = waves({5});
  EXPECT_THROW(fk_spectrum({}, kSpacing, kDt), std::invalid_argument);
  EXPECT_THROW(fk_spectrum(std::span(good).first(7), kSpacing, kDt), std::invalid_argument);
  EXPECT_THROW(fk_spectrum(good, 0.0, kDt), std::invalid_argument);
  EXPECT_THROW(fk_spectrum(good, kSpacing, NAN), std::invalid_argument);
  good[3].pop_back();
  EXPECT_THROW(fk_spectrum(good, kSpacing, kDt), std::invalid_argument);
  good[3].push_back(HUGE_VAL);
  EXPECT_THROW(fk_spectrum(good, kSpacing, kDt), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::harness
