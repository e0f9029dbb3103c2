// What stands in the way of a measurement before anything is looked at, and what is refused of what was.

#include "harness/run/measurability.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/harness/measure/synthetic.h"
#include "tests/verification/recordings.h"

namespace ddem::harness {
namespace {

using namespace recordings;

/// A gaussian released in a strip with free ends, its echoes by images of the source.
WaveContext released_at(double centre, double width, double amplitude) {
  WaveContext c;
  c.speed = kSpeed, c.length = kLength;
  c.source_centre = centre, c.source_reach = 3.0 * width, c.source_amplitude = amplitude;
  c.pulse_half_width = 3.0 * width / kSpeed, c.pulse_width = std::sqrt(8.0 * std::log(2.0)) * width / kSpeed;
  return c;
}

Recording gaussian_waves(const ProbeLayout& probes, double centre, double width, double amplitude, double dt) {
  Recording out;
  for (const Probe& p : probes.probes) {
    std::vector<double>& u = out.emplace_back();
    for (double t = 0.0; t < 2.2 * kLength / kSpeed; t += dt) {
      double sum = 0.0;
      for (int k = -2; k <= 2; ++k) {
        for (const double image : {2.0 * k * kLength + centre, 2.0 * k * kLength - centre}) {
          sum += synthetic::gaussian(p.x - image, kSpeed * t, width) + synthetic::gaussian(p.x - image, -kSpeed * t, width);
        }
      }
      u.push_back(0.5 * amplitude * sum);
    }
  }
  return out;
}

/// Wherever it starts and however wide it is: what is measured is the speed, of either sign, or nothing. Overlapping tops move
/// each other by g'(4 widths) of a width at most, 1.3e-3 of it, and sampling by 0.1 %.
TEST(Sources, AnywhereAndOfAnyWidthGiveTheSpeedOrAReason) {
  synthetic::Noise random(5);
  int numbers = 0, refusals = 0, leftward = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double centre = trial % 4 == 0 ? 0.0 : kLength * (1.4 * random.uniform() - 0.2);
    const double width = 1e-4 * std::pow(60.0, random.uniform()), dt = 5e-9 * std::pow(40.0, random.uniform());
    const ProbeLayout probes = layout(5);
    const WaveMeasurement m = measure_wave(gaussian_waves(probes, centre, width, kAmplitude, dt), dt, probes, released_at(centre, width, kAmplitude));
    const WaveMeasurement minus = measure_wave(gaussian_waves(probes, centre, width, -kAmplitude, dt), dt, probes, released_at(centre, width, -kAmplitude));
    ASSERT_EQ(m.speed.speed.ok(), minus.speed.speed.ok());
    for (const WaveSpeed* w : {&m.speed, &*m.by_centroid, &m.by_correlation}) {
      if (w->speed.ok()) {
        EXPECT_NEAR(w->speed.value().mean / kSpeed, 1.0, 2e-3) << centre << ", " << width << ", " << dt;
      }
    }
    if (!m.speed.speed.ok()) {
      ++refusals;
      continue;
    }
    ++numbers;
    EXPECT_EQ(m.speed.speed.value().mean, minus.speed.speed.value().mean);
    for (const PairSpeed& pair : m.speed.pairs) leftward += pair.speed.ok() && pair.from > pair.to;
  }
  EXPECT_GT(numbers, 60);
  EXPECT_GT(refusals, 60);
  EXPECT_GT(leftward, 20);
}

/// Pulses up to twice the strip, driven from its left end, with the echo of a held right end.
TEST(Sources, DrivenForAnyTimeGiveTheSpeedOrAReason) {
  int numbers = 0;
  for (double duration = 0.02; duration < 2.5; duration *= 1.15) {
    WaveContext c = driven();
    c.source_duration = duration * kLength / kSpeed;
    c.pulse_half_width = c.pulse_width = 0.5 * c.source_duration;
    const ProbeLayout probes = layout(5);
    Recording out;
    for (const Probe& p : probes.probes) {
      std::vector<double>& u = out.emplace_back();
      for (double t = 0.0; t < 4.0 * kLength / kSpeed; t += kDt) {
        u.push_back(kAmplitude * references::driven_strip({kLength, kSpeed, references::End::fixed, references::End::fixed},
                                                          [&](double time) { return references::sin2_motion(time, c.source_duration); }, p.x, t));
      }
    }
    const WaveMeasurement m = measure_wave(out, kDt, probes, c);
    if (!m.speed.speed.ok()) continue;
    EXPECT_NEAR(m.speed.speed.value().mean / kSpeed, 1.0, 2e-3) << duration;
    ++numbers;
  }
  EXPECT_GE(numbers, 15);
}

Failure failure_of(const WaveMeasurement& m) {
  EXPECT_FALSE(any_number(m));
  return m.speed.pairs.front().speed.error().failure;
}

/// Each rule alone, from a recording that gives a number without it; no way of finding a delay gets round it.
TEST(Rules, OneAtATime) {
  const ProbeLayout probes = layout(5);
  const Recording clean = waves(probes);
  ASSERT_TRUE(measure_wave(clean, kDt, probes, driven()).speed.speed.ok());
  const auto with = [&](auto&& change) {
    WaveContext c = driven();
    change(c);
    return failure_of(measure_wave(clean, kDt, probes, c));
  };
  EXPECT_EQ(with([](WaveContext& c) { c.obstacle = FailedMeasurement{Failure::growing, "it grows"}; }), Failure::growing);
  EXPECT_EQ(with([](WaveContext& c) { c.source_reach = 5e-3; }), Failure::beside_source);
  EXPECT_EQ(with([](WaveContext& c) { c.source_duration *= 4.0; }), Failure::beside_source) << "its echo comes first";
  EXPECT_EQ(with([](WaveContext& c) { c.march_step = c.pulse_width / 3.9; }), Failure::undersampled);
  EXPECT_EQ(with([](WaveContext& c) { c.source_amplitude /= 3.1; }), Failure::too_high);
  EXPECT_EQ(with([](WaveContext& c) { c.source_amplitude *= -1.0; }), Failure::below_noise) << "the wrong sign";
  EXPECT_EQ(with([](WaveContext& c) { c.pulse_width *= 2.2; }), Failure::not_first) << "too narrow for its source";
  for (const Outcome<PhaseVelocity>& v : phase_velocities(clean, kDt, probes, driven())) EXPECT_TRUE(v.ok());
  WaveContext grows = driven();
  grows.obstacle = FailedMeasurement{Failure::growing, "it grows"};
  for (const Outcome<PhaseVelocity>& v : phase_velocities(clean, kDt, probes, grows)) EXPECT_FALSE(v.ok());
}

/// Signals of probes that are not where they are said to be: delays of no wave, or of as many waves as there are pairs.
TEST(Rules, PairsMustSeeOneWave) {
  const ProbeLayout probes = layout(5);
  ProbeLayout elsewhere = probes;
  for (const ProbePair& pair : probes.pairs) elsewhere.probes[pair.to].x = elsewhere.probes[pair.from].x + 0.4 * pair.distance;
  EXPECT_EQ(failure_of(measure_wave(waves(elsewhere), kDt, probes, driven())), Failure::not_causal);
  elsewhere = probes;
  const std::array shares = {0.6, 1.7, 0.6, 1.7, 1.0};
  for (std::size_t k = 0; k < 5; ++k) {
    const ProbePair& pair = probes.pairs[k];
    elsewhere.probes[pair.to].x = elsewhere.probes[pair.from].x + shares[k] * pair.distance;
  }
  const WaveMeasurement m = measure_wave(waves(elsewhere), kDt, probes, driven());
  ASSERT_FALSE(m.speed.speed.ok());
  EXPECT_EQ(m.speed.speed.error().failure, Failure::inconsistent) << m.speed.speed.error().reason;
}

/// Higher coda before the top, and all of it in one signal, is no pulse; a forerunner of a tenth of the pulse is left alone.
TEST(Rules, NothingComesBeforeThePulse) {
  const ProbeLayout probes = layout(1);
  for (const double share : {0.1, 0.7}) {
    Recording out = waves(probes);
    const auto first = static_cast<std::size_t>(0.3 * (probes.probes[1].x / kSpeed) / kDt);
    for (std::size_t n = 0; n < out[1].size(); ++n) out[1][n] += share * kAmplitude * std::exp(-0.5 * std::pow((static_cast<double>(n) - static_cast<double>(first)) / 12.0, 2));
    EXPECT_EQ(measure_wave(out, kDt, probes, driven()).speed.speed.ok(), share < 0.5) << share;
  }
}

/// A pair 6.6 mm apart, 2.64 us: of a short pulse four samples at half its height bind, 25 ns, of a long one the error of its top,
/// 0.82 dt^3/width^2 = 1e-3 of the delay, 202 ns.
TEST(Rules, BoundsOfSamplesAndEnds) {
  const ProbeLayout probes = layout(1);
  const auto refused = [&](const WaveContext& c, double dt) { return obstacle(probes, path_of(probes, probes.pairs[0], c), c, dt).has_value(); };
  WaveContext c = driven();
  c.pulse_width = 1e-7;
  EXPECT_FALSE(refused(c, 2.4e-8));
  EXPECT_TRUE(refused(c, 2.6e-8));
  c.pulse_width = 1.6e-6;
  EXPECT_FALSE(refused(c, 1.9e-7));
  EXPECT_TRUE(refused(c, 2.1e-7));
  for (const double from_end : {0.0, 1.1e-3}) EXPECT_FALSE(refused(released_at(from_end, 5e-4, kAmplitude), 1e-9)) << from_end;
  for (const double centre : {-1e-3, 2e-4, 9e-4, kLength - 9e-4, kLength, 2.0 * kLength}) {
    EXPECT_TRUE(refused(released_at(centre, 5e-4, kAmplitude), 1e-9)) << centre;
  }
}

/// The step that a drive needs: its sampled impulse against the bound of its error.
TEST(DriveSteps, ErrorOfTheImpulseIsWithinItsBound) {
  for (double steps = 2.05; steps < 60.0; steps *= 1.01) {
    double sum = 0.0;
    for (int n = 1; n < steps; ++n) sum += references::sin2_motion(n, steps);
    EXPECT_LE(std::abs(sum / (0.5 * steps) - 1.0), drive_error(steps, 1.0)) << steps;
    EXPECT_GT(longest_drive_step(steps), 1.0);
  }
}

}  // namespace
}  // namespace ddem::harness
