// Three speeds from one set of signals: synthetic pulses at the probes, with reflections, noise and nothing at all.

#include "harness/run/measure_wave.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "harness/references/dalembert.h"
#include "harness/run/bar_reference.h"

namespace ddem::harness {
namespace {

constexpr double kSpeed = 2500.0, kLength = 16.5e-3, kDuration = 8e-3 / kSpeed, kDt = kDuration / 400.0, kAmplitude = 1e-8;

ProbeLayout layout() {
  return nominal_pairs({5, true}, kLength, 2e-3);
}

WaveContext context() {
  WaveContext c;
  c.speed = kSpeed, c.length = kLength;
  c.source_duration = kDuration, c.source_amplitude = kAmplitude, c.pulse_half_width = 0.5 * kDuration;
  return c;
}

/// A driven strip whose true speed is `speed`, exactly, with its reflections at both ends.
std::vector<std::vector<double>> signals(double speed, double end = 2.6 * kLength / kSpeed) {
  std::vector<std::vector<double>> out;
  for (const Probe& p : layout().probes) {
    std::vector<double>& u = out.emplace_back();
    for (double t = 0.0; t < end; t += kDt) {
      u.push_back(kAmplitude * references::driven_strip({kLength, speed, references::End::fixed, references::End::free},
                                                        [](double time) { return references::sin2_motion(time, kDuration); }, p.x, t));
    }
  }
  return out;
}

double mean(const WaveSpeed& w) {
  return w.speed.value().mean;
}

/// d'Alembert: no dispersion, so all three agree with the truth, whether the expectation is right or 2 % off (the pulse is
/// then shorter or longer than its window). Picks of 400 samples a pulse err by 1e-5 of it, 2e-5 of a pair's delay; the
/// free end's reflection doubles what it meets, and would be seen.
TEST(MeasureWave, ThreeSpeedsOfAPulseWithoutDispersion) {
  for (const double speed : {kSpeed, 0.98 * kSpeed, 1.02 * kSpeed}) {
    const WaveMeasurement m = measure_wave(signals(speed), kDt, layout(), context());
    EXPECT_EQ(m.speed.good_pairs, 5u);
    EXPECT_EQ(m.by_centroid.value().good_pairs, 5u);
    EXPECT_EQ(m.by_correlation.good_pairs, 5u);
    EXPECT_NEAR(mean(m.speed) / speed, 1.0, 3e-5);
    EXPECT_NEAR(mean(*m.by_centroid) / speed, 1.0, 3e-5);
    // Of the farthest probes the end of a slow pulse lies behind the window.
    EXPECT_NEAR(mean(m.by_correlation) / speed, 1.0, speed < kSpeed ? 1e-3 : 3e-5);
  }
}

TEST(MeasureWave, AReleasedColumnHasNoCentroid) {
  WaveContext c = context();
  c.pulse_half_width = 0.0;
  const WaveMeasurement m = measure_wave(signals(kSpeed), kDt, layout(), c);
  EXPECT_FALSE(m.by_centroid.has_value());
  EXPECT_TRUE(m.speed.speed.ok());
  EXPECT_TRUE(m.by_correlation.speed.ok());
}

/// A false alarm would be a speed; each of the three must say why there is none.
TEST(MeasureWave, SilenceAndRecordingsThatEndTooEarlyGiveNoSpeed) {
  const std::vector<std::vector<double>> silence(10, std::vector<double>(1200, 0.0));
  for (const auto& recorded : {silence, signals(kSpeed, 0.3 * kLength / kSpeed)}) {
    const WaveMeasurement m = measure_wave(recorded, kDt, layout(), context());
    EXPECT_FALSE(m.speed.speed.ok());
    EXPECT_FALSE(m.by_centroid.value().speed.ok());
    EXPECT_FALSE(m.by_correlation.speed.ok());
  }
}

/// The S0 reference of a strip without contraction is the pulse itself, and one with contraction is slow: the more so its
/// top, since short waves lag behind.
TEST(S0Measurement, IsTheBarSpeedWithoutContraction) {
  const WaveMeasurement plain = s0_measurement({kSpeed, 2e-3, 0.0}, layout(), context());
  EXPECT_NEAR(mean(plain.speed) / kSpeed, 1.0, 1e-4);
  EXPECT_NEAR(mean(*plain.by_centroid) / kSpeed, 1.0, 1e-4);
  // A contraction below 0 counts as none.
  EXPECT_EQ(mean(s0_measurement({kSpeed, 2e-3, -0.1}, layout(), context()).speed), mean(plain.speed));
  const WaveMeasurement bar = s0_measurement({kSpeed, 2e-3, 0.3}, layout(), context());
  EXPECT_LT(mean(bar.speed), 0.99 * kSpeed);
  EXPECT_GT(mean(bar.speed), 0.96 * kSpeed);
  EXPECT_LT(mean(bar.speed), mean(bar.by_correlation));
  EXPECT_LT(mean(bar.by_correlation), mean(*bar.by_centroid));
  WaveContext released = context();
  released.source_duration = 0.0;
  EXPECT_THROW(s0_measurement({kSpeed, 2e-3, 0.3}, layout(), released), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::harness
