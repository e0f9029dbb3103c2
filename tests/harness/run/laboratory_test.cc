// What a laboratory's signals give, and what they must be refused for.

#include "harness/run/laboratory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/harness/run/laboratory_signals.h"

namespace ddem::harness {
namespace {

using namespace laboratory_test;
using testing::HasSubstr;

const Outcome<MeanSpeed>& speed(const LaboratoryResult& r, Mark mark) {
  return r.speed[static_cast<std::size_t>(mark)];
}

void expect_speed(const LaboratoryResult& r, Mark mark, double expected, double relative) {
  const auto& v = speed(r, mark);
  ASSERT_TRUE(v.ok()) << name(mark) << ": " << v.error().reason;
  EXPECT_NEAR(v.value().mean / expected, 1.0, relative) << name(mark);
}

void expect_refused(const LaboratoryResult& r, const std::string& reason) {
  for (const Mark mark : kMarks) {
    ASSERT_FALSE(speed(r, mark).ok()) << name(mark);
    EXPECT_THAT(speed(r, mark).error().reason, HasSubstr(reason)) << name(mark);
  }
  EXPECT_FALSE(r.pairs.front().phase_velocity.ok());
  for (const SensorReading& s : r.sensors) EXPECT_FALSE(s.peak.ok() || s.first_break.ok() || s.centroid.ok());
}

std::string notes(const LaboratoryResult& r) {
  std::string all;
  for (const std::string& note : r.notes) all += note + "\n";
  return all;
}

TEST(Laboratory, MeasuresACleanPulseInEveryWay) {
  const LaboratoryRecording clean = recording_of({}, 1);
  const LaboratoryResult r = measure_recording(clean, {});
  // The sampling error is at most 0.41 (1/30)^2 = 5e-4 samples a pick, in a delay of 200.
  for (const Mark mark : kMarks) expect_speed(r, mark, kSpeed, 5e-5);
  EXPECT_NEAR(r.sensors[0].peak.value().value, 400.3 * kDt, 1e-3 * kDt);
  EXPECT_NEAR(r.sensors[0].centroid.value().value, 400.3 * kDt, 2e-3 * kDt);
  EXPECT_NEAR(r.sensors[1].width, 30.0 * kDt, 2.0 * kDt);
  // T/4 - T/(2 pi) after the pulse's foot, T = 60, and at most 6 % of the width earlier (see the test of tangents).
  EXPECT_NEAR(r.sensors[0].first_break.value().value / kDt, 370.3 + 60.0 * (0.25 - 0.5 / std::numbers::pi), 1.8);
  ASSERT_TRUE(r.pairs[0].phase_velocity.ok()) << r.pairs[0].phase_velocity.error().reason;
  for (const double v : r.pairs[0].phase_velocity.value().speed) EXPECT_NEAR(v / kSpeed, 1.0, 1e-3);
  EXPECT_TRUE(r.notes.empty()) << notes(r);
  EXPECT_FALSE(speed(r, Mark::peak).value().scatter) << "a single pair";
  EXPECT_TRUE(r.modulus.empty());
}

TEST(Laboratory, ASpeedThatNoSolidHasIsTold) {
  for (const double factor : {1e-6, 1e3}) {  // seconds for microseconds, metres for millimetres
    LaboratoryRecording wrong = recording_of({}, 1);
    for (LaboratorySensor& sensor : wrong.sensors) sensor.position *= factor;
    EXPECT_THAT(notes(measure_recording(wrong, {})), HasSubstr("is a unit missing?")) << factor;
  }
}

TEST(Laboratory, DoesNotDependOnUnitsStartOrOrder) {
  Shot shot;
  shot.noise = 0.02;
  const LaboratoryRecording one = recording_of(shot, 3);
  LaboratoryRecording other = one;
  other.t0 = 5e-3;
  for (LaboratorySensor& s : other.sensors) {
    s.position += 7.0;
    for (double& v : s.values) v *= 1e-12;
  }
  std::swap(other.sensors[0], other.sensors[1]);
  const LaboratoryResult a = measure_recording(one, {}), b = measure_recording(other, {});
  for (const Mark mark : kMarks) expect_speed(b, mark, speed(a, mark).value().mean, 1e-8);
  EXPECT_NEAR(b.sensors[1].peak.value().value - 5e-3, a.sensors[0].peak.value().value, 1e-12);
}

TEST(Laboratory, SaysWhatItRemoved) {
  Shot shot;
  shot.noise = 0.01, shot.offset = 0.5, shot.trend = 1.0, shot.second = -0.8;
  const LaboratoryResult r = measure_recording(recording_of(shot, 5), {});
  for (const Mark mark : kMarks) expect_speed(r, mark, kSpeed, 0.01);
  EXPECT_THAT(notes(r), HasSubstr("a: removed an offset of 0."));
  EXPECT_THAT(notes(r), HasSubstr("and a trend of "));
  EXPECT_THAT(notes(r), HasSubstr("b: its wave has the other sign than that of a"));
  EXPECT_TRUE(r.sensors[1].reversed);
  EXPECT_NEAR(r.sensors[0].trend, 1.0 / (1000.0 * kDt), 0.05 / (1000.0 * kDt));
}

TEST(Laboratory, APolarityThatIsSaidIsKept) {
  Shot shot;
  shot.noise = 0.01, shot.second = -0.8;
  LaboratoryOptions positive;
  positive.polarity = Polarity::positive;
  const LaboratoryResult r = measure_recording(recording_of(shot, 5), positive);
  expect_refused(r, "b: its wave is negative, not positive as was said");
}

TEST(Laboratory, ModuliAreDensityTimesSquaredSpeed) {
  Shot shot;
  shot.noise = 0.02;
  for (const auto& [wave, symbol] : {std::pair{LaboratoryWave::p, "M"}, {LaboratoryWave::shear, "G"}, {LaboratoryWave::bar, "E"}}) {
    LaboratoryOptions o;
    o.density = 2400.0, o.wave = wave;
    const LaboratoryResult r = measure_recording(recording_of(shot, 3), o);
    const double c = speed(r, Mark::peak).value().mean;
    EXPECT_NEAR(r.modulus[0].value().value / (2400.0 * c * c), 1.0, 1e-12);
    EXPECT_NEAR(r.modulus[0].value().stddev / r.modulus[0].value().value, 2.0 * speed(r, Mark::peak).value().stddev / c, 1e-12);
    EXPECT_EQ(modulus_symbol(wave), symbol);
  }
}

TEST(Laboratory, PairsOfMoreSensorsAgree) {
  LaboratoryRecording r{0.0, kDt, kDt, {}};
  synthetic::Noise random(9);
  Shot shot;
  shot.samples = 1600, shot.noise = 0.02;
  for (const double delay : {0.0, 200.0, 500.0, 900.0})
    r.sensors.push_back(
        {"s" + std::to_string(r.sensors.size()), kSpeed * delay * kDt, signal_of(shot, 400.3 + delay, 1.0 - delay / 2000.0, random)});
  const LaboratoryResult result = measure_recording(r, {});
  ASSERT_EQ(result.pairs.size(), 5u);  // 01 12 23 02 03
  EXPECT_EQ(result.pairs[3].from, 0u);
  EXPECT_EQ(result.pairs[4].to, 3u);
  for (const Mark mark : kMarks) {
    expect_speed(result, mark, kSpeed, 0.01);
    EXPECT_EQ(speed(result, mark).value().pairs, 5u);
    EXPECT_GT(speed(result, mark).value().scatter.value(), 0.0);
  }
  // One dead sensor: 3 pairs are left of 5. Of two, one.
  r.sensors[1].values.assign(1600, 0.3);
  const LaboratoryResult dead = measure_recording(r, {});
  EXPECT_FALSE(dead.sensors[1].peak.ok());
  EXPECT_THAT(dead.sensors[1].peak.error().reason, HasSubstr("the signal is constant"));
  expect_speed(dead, Mark::peak, kSpeed, 0.01);
  EXPECT_EQ(speed(dead, Mark::peak).value().pairs, 3u);
  r.sensors[2].values.assign(1600, 0.3);
  const LaboratoryResult two = measure_recording(r, {});
  ASSERT_FALSE(speed(two, Mark::peak).ok());
  EXPECT_THAT(speed(two, Mark::peak).error().reason, HasSubstr("1 of 5 pairs give a speed"));
  EXPECT_THAT(speed(two, Mark::peak).error().reason, HasSubstr("s1 to s2: s1: the signal is constant"));
}

TEST(Laboratory, AFilterTakesSlowNoiseAway) {
  Shot shot;
  shot.noise = 0.02;
  LaboratoryRecording r = recording_of(shot, 4);
  for (LaboratorySensor& s : r.sensors) {
    for (std::size_t n = 0; n < s.values.size(); ++n) s.values[n] += 2.0 * std::sin(0.004 * static_cast<double>(n));
  }
  LaboratoryOptions o;
  o.band = Band{50e3, 1e6};
  const LaboratoryResult filtered = measure_recording(r, o);
  expect_speed(filtered, Mark::peak, kSpeed, 0.01);
  expect_speed(filtered, Mark::correlation, kSpeed, 0.01);
  EXPECT_THAT(notes(filtered), HasSubstr("filtered without delay: above 50 kHz, below 1000 kHz"));
}

TEST(Laboratory, SaysThatAWaveChangesItsShape) {
  // Twice as wide at the farther sensor, and skew: every mark is another, and no noise explains it.
  LaboratoryRecording r = recording_of({}, 1);
  for (std::size_t n = 0; n < r.sensors[1].values.size(); ++n) {
    const double t = (static_cast<double>(n) - 560.0) / 15.0;
    r.sensors[1].values[n] = t > 0.0 ? t * t * std::exp(-t) : 0.0;
  }
  EXPECT_THAT(notes(measure_recording(r, {})),
              HasSubstr("% apart, and noise does not explain that: the wave changes its shape on its way"));
  Shot noisy;
  noisy.noise = 0.05;
  for (unsigned trial = 0; trial < 50; ++trial)
    EXPECT_THAT(notes(measure_recording(recording_of(noisy, trial), {})), testing::Not(HasSubstr("apart")));
}

TEST(LaboratoryRefuses, NoWave) {
  Shot shot;
  shot.noise = 0.3;
  LaboratoryRecording r = recording_of(shot, 4);
  expect_refused(measure_recording(r, {}), "record from earlier on");  // noise of 30 %: the highest crest is somewhere
  for (LaboratorySensor& s : r.sensors) s.values.assign(1000, 1.0);
  expect_refused(measure_recording(r, {}), "the signal is constant; is the sensor connected?");
  LaboratoryOptions filter;
  filter.band = Band{50e3, 1e6};
  expect_refused(measure_recording(r, filter), "the signal is constant; is the sensor connected?");
  for (LaboratorySensor& s : r.sensors) {
    for (std::size_t n = 0; n < 1000; ++n) s.values[n] = 0.1 + 0.3 * static_cast<double>(n);
  }
  expect_refused(measure_recording(r, {}), "a straight line");
  expect_refused(measure_recording(r, filter), "a straight line");
  r.sensors[0].values[5] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(measure_recording(r, {}), "not finite");
}

TEST(LaboratoryRefuses, AWaveInOneSensorOnly) {
  Shot shot;
  shot.noise = 0.02, shot.second = 0.0;
  expect_refused(measure_recording(recording_of(shot, 4), {}), "b: ");
}

TEST(LaboratoryRefuses, AWaveThatPassesTheFartherSensorFirst) {
  LaboratoryRecording r = recording_of({}, 4);
  std::swap(r.sensors[0].values, r.sensors[1].values);
  expect_refused(measure_recording(r, {}), "the wave passes the farther sensor 20 us before the nearer one: swap the columns");
}

TEST(LaboratoryRefuses, ADelayWithinItsNoise) {
  Shot shot;
  shot.noise = 0.05, shot.delay = 0.3;
  expect_refused(measure_recording(recording_of(shot, 4), {}), "put the sensors further apart");
  // What both sensors see at once is no wave that passes: pick-up of the pulser.
  LaboratoryRecording same = recording_of({}, 4);
  same.sensors[1].values = same.sensors[0].values;
  expect_refused(measure_recording(same, {}), "put the sensors further apart");
}

TEST(LaboratoryRefuses, TooFewSamples) {
  Shot shot;
  shot.width = 3.0, shot.first = 200.3, shot.delay = 60.0;
  const LaboratoryResult r = measure_recording(recording_of(shot, 4), {});
  expect_refused(r, "and 4 are needed; take samples every ");
  // Fine samples that were made of coarse ones are coarse.
  LaboratoryRecording gaps = recording_of({}, 4);
  gaps.widest_gap = 12.0 * kDt;
  expect_refused(measure_recording(gaps, {}), "and 4 are needed");
}

TEST(LaboratoryRefuses, ClippedTopsAndKeepsTheRest) {
  for (const double noise : {0.0, 0.01, 0.05}) {
    Shot shot;
    shot.noise = noise;
    LaboratoryRecording r = recording_of(shot, 4);
    for (LaboratorySensor& s : r.sensors) {
      for (double& v : s.values) v = std::min(v, 0.7);
    }
    const LaboratoryResult result = measure_recording(r, {});
    EXPECT_FALSE(speed(result, Mark::peak).ok());
    EXPECT_THAT(speed(result, Mark::peak).error().reason, HasSubstr("clipped"));
    EXPECT_FALSE(speed(result, Mark::centroid).ok());
    expect_speed(result, Mark::first_break, kSpeed, 0.02);
    expect_speed(result, Mark::correlation, kSpeed, 0.02);
    EXPECT_THAT(notes(result), HasSubstr("a: the wave is clipped"));
    EXPECT_FALSE(result.pairs[0].phase_velocity.ok());
  }
}

TEST(LaboratoryRefuses, NoTopThatFewDigitsFlatten) {
  // 8 bits: eleven samples or so of a pulse of 200 share the top, and nothing is cut off.
  for (const double noise : {0.0, 0.02}) {
    Shot shot;
    shot.width = 100.0, shot.first = 600.3, shot.delay = 300.0, shot.samples = 1400, shot.noise = noise;
    LaboratoryRecording r = recording_of(shot, 4);
    for (LaboratorySensor& s : r.sensors) {
      for (double& v : s.values) v = std::round(100.0 * v) / 100.0;
    }
    expect_speed(measure_recording(r, {}), Mark::peak, kSpeed, 0.02);
  }
}

TEST(LaboratoryRefuses, AnEarlierArrivalForTheFirstBreakOnly) {
  Shot shot;
  shot.noise = 0.005, shot.precursor = 0.12;
  const LaboratoryResult r = measure_recording(recording_of(shot, 4), {});
  ASSERT_FALSE(speed(r, Mark::first_break).ok());
  EXPECT_THAT(speed(r, Mark::first_break).error().reason, HasSubstr("which of them breaks first is open"));
  for (const Mark mark : {Mark::peak, Mark::centroid, Mark::correlation}) expect_speed(r, mark, kSpeed, 0.01);
}

TEST(LaboratoryRefuses, TwoWavesThatAnswerAlikeToOne) {
  // Which of two equal pulses at the farther sensor is the one that passed the nearer?
  Shot shot;
  shot.noise = 0.01;
  LaboratoryRecording r = recording_of(shot, 4);
  for (std::size_t n = 0; n < r.sensors[1].values.size(); ++n)
    r.sensors[1].values[n] += synthetic::sin2(static_cast<double>(n), 690.3, 60.0);
  expect_refused(measure_recording(r, {}), "at two delays");
}

TEST(LaboratoryRefuses, APlateauForThePeakOnly) {
  LaboratoryRecording r = recording_of({}, 4);
  for (LaboratorySensor& s : r.sensors) {
    const std::size_t top = static_cast<std::size_t>(std::max_element(s.values.begin(), s.values.end()) - s.values.begin());
    for (std::size_t n = top; n < s.values.size(); ++n) s.values[n] = s.values[top];  // a step: displacement that stays
  }
  const LaboratoryResult result = measure_recording(r, {});
  EXPECT_FALSE(speed(result, Mark::peak).ok());
  EXPECT_FALSE(speed(result, Mark::centroid).ok());
  expect_speed(result, Mark::first_break, kSpeed, 1e-3);
}

TEST(LaboratoryRefuses, SomethingShorterThanTheSource) {
  LaboratoryOptions o;
  o.source_duration = 300.0 * kDt;
  expect_refused(measure_recording(recording_of({}, 4), o), "it is something else");
  o.source_duration = 60.0 * kDt;
  expect_speed(measure_recording(recording_of({}, 4), o), Mark::centroid, kSpeed, 1e-4);
}

TEST(LaboratoryThrows, OnWrongUse) {
  LaboratoryRecording r = recording_of({}, 1);
  LaboratoryOptions density;
  density.density = 2400.0;
  EXPECT_THROW(measure_recording(r, density), std::invalid_argument);
  r.sensors[1].position = 0.0;
  EXPECT_THROW(measure_recording(r, {}), std::invalid_argument);
  r = recording_of({}, 1);
  r.sensors[1].values.pop_back();
  EXPECT_THROW(measure_recording(r, {}), std::invalid_argument);
  r = recording_of({}, 1);
  r.sensors.pop_back();
  EXPECT_THROW(measure_recording(r, {}), std::invalid_argument);
  r = recording_of({}, 1);
  r.dt = 0.0;
  EXPECT_THROW(measure_recording(r, {}), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::harness
