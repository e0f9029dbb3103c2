// What verdicts and tables are made of, on made-up results with known answers.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "harness/studies/paper_protocol/paper_protocol_figures.h"
#include "harness/studies/waves/pickers.h"
#include "harness/studies/waves/waveforms.h"

namespace ddem::harness {
namespace {

WaveOutcome wave(std::int64_t seed, Protocol protocol, StripWave which, std::optional<double> speed) {
  WaveOutcome w;
  w.c = {StripPacking::random, seed, Model::dem, 0.5, protocol, which};
  w.speed = speed;
  return w;
}

StripCampaign one_ratio() {
  StripCampaign s;
  s.models = {Model::dem};
  s.stiffness_ratios = {0.5};
  s.seeds = {1, 2};
  return s;
}

TEST(CampaignMeans, AreOverTheSeedsThatGaveOne) {
  StripResults r;
  r.campaign = one_ratio();
  r.waves = {wave(1, Protocol::long_wave, StripWave::shear, 990.0), wave(2, Protocol::long_wave, StripWave::shear, std::nullopt)};
  for (WaveOutcome& w : r.waves) w.section_speed = 1000.0;
  const StripCase key{StripPacking::random, 0, Model::dem, 0.5, Protocol::long_wave, StripWave::shear};
  const auto error = [](const WaveOutcome& w) { return relative_error(w.speed, w.section_speed); };
  EXPECT_NEAR(mean_over_seeds(r, key, 1, error).value(), -0.01, 1e-12);
  EXPECT_FALSE(mean_over_seeds(r, key, 2, error));
  r.waves[1].speed = 1020.0;
  EXPECT_NEAR(mean_over_seeds(r, key, 2, error).value(), 0.005, 1e-12);
  EXPECT_FALSE(mean_over_seeds(r, {key.packing, 0, Model::implicit_full, 0.5, key.protocol, key.wave}, 1, error));
  ASSERT_EQ(picker_table(r).rows.size(), 1u);
}

/// An isotropic material, nu = 0.25, whose strip is 4 % slow; waves 1 % fast in one packing and not measured in the other.
TEST(PaperPoisson, AddsUpFromTheMaterialToTheProtocol) {
  StripResults r;
  r.campaign = one_ratio();
  const double k = 5e9, g = 3e9, rho = 1700.0;  // nu = (K - G)/(K + G)
  const double shear = std::sqrt(g / rho), p = std::sqrt((k + g) / rho), bar = std::sqrt(4.0 * k * g / (k + g) / rho);
  for (const std::int64_t seed : {1, 2}) {
    StaticOutcome s;
    s.key = {StripPacking::random, seed, Model::dem, 0.5};
    s.speeds = {0.96 * bar, shear, p};
    s.moduli.bulk_density = s.moduli.moving_density = rho;
    s.moduli.solid_fraction = 0.85;
    s.moduli.stiffness = PlaneStiffness{{k + g, k - g, 0.0}, {k - g, k + g, 0.0}, {0.0, 0.0, g}};
    r.statics.push_back(s);
    const auto measured = [&](double speed) { return seed == 1 ? std::optional(1.01 * speed) : std::nullopt; };
    r.waves.push_back(wave(seed, Protocol::paper, StripWave::bar, measured(0.96 * bar)));
    r.waves.push_back(wave(seed, Protocol::paper, StripWave::shear, shear));
  }
  const PaperPoisson steps = paper_poisson(r, Model::dem, 0.5);
  EXPECT_NEAR(steps.bulk, 0.25, 1e-12);
  EXPECT_NEAR(steps.bulk_bar, 0.25, 1e-12);
  EXPECT_NEAR(steps.strip, 1.25 * 0.96 * 0.96 - 1.0, 1e-12);
  EXPECT_EQ(steps.seeds, 1u);
  EXPECT_NEAR(steps.measured, 1.25 * std::pow(0.96 * 1.01, 2) - 1.0, 1e-12);
  EXPECT_NEAR(steps.waves, steps.measured - steps.strip, 1e-12);
  // Discs of the mean area: 682 pi r^2 = 0.85 * 16.5 mm * 2 mm.
  EXPECT_NEAR(682.0 * std::numbers::pi * std::pow(steps.radius_over_width * 2e-3, 2), 0.85 * 16.5e-3 * 2e-3, 1e-12);
  EXPECT_TRUE(std::isnan(paper_poisson(r, Model::lagged_full, 0.5).bulk));
  EXPECT_NO_THROW(reports::require_valid(paper_poisson_figure(r)));
  EXPECT_EQ(paper_poisson_table(r).rows.size(), 1u);
}

/// Two recordings that agree until the echo and have nothing in common afterwards.
TEST(WaveformCorrelation, StopsBeforeTheEcho) {
  StripResults r;
  r.campaign = one_ratio();
  WaveOutcome dem = wave(1, Protocol::long_wave, StripWave::shear, 1000.0);
  FemOutcome fem;
  fem.key = {StripPacking::random, 1, Model::dem, 0.5};
  const double dt = 1e-8;
  PickedSignal particles, continuum;
  for (int n = 0; n < 200; ++n) {
    const double pulse = n < 100 ? std::pow(std::sin(std::numbers::pi * n / 100.0), 2) : 0.0;
    particles.values.push_back(pulse - (n > 120 ? 1.0 : 0.0));
    continuum.values.push_back(pulse + (n > 120 ? 1.0 : 0.0));
  }
  particles.window_end = continuum.window_end = 110 * dt;
  dem.recording = {dt, {particles}};
  fem.recording = {dt, {continuum}};
  r.waves = {dem};
  r.fem = {fem};
  EXPECT_NEAR(waveform_correlation(r, fem.key, StripWave::shear).value(), 1.0, 1e-12);
  r.waves[0].recording.signals[0].window_end = 1.0;
  EXPECT_LT(waveform_correlation(r, fem.key, StripWave::shear).value(), 0.5);
  EXPECT_FALSE(waveform_correlation(r, fem.key, StripWave::p));
}

}  // namespace
}  // namespace ddem::harness
