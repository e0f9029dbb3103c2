// What comes before a wave: where it ends, and what is taken away with it.

#include "harness/measure/quiet_part.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coloured_noise.h"

namespace ddem::harness {
namespace {

using synthetic::Record;
using synthetic::sample;
using synthetic::sin2;
using synthetic::with_noise;

TEST(ChangePoint, IsWhereALineWithNoiseEnds) {
  for (unsigned trial = 0; trial < 50; ++trial) {
    const Record r =
        with_noise(sample([](double t) { return 3.0 + 0.01 * t + (t >= 200.0 ? 0.05 * (t - 200.0) : 0.0); }, 240), 0.02, trial);
    EXPECT_NEAR(static_cast<double>(change_point(r.values, 8)), 201.0, 4.0);
  }
  EXPECT_EQ(change_point(std::vector<double>(10, 1.0), 8), 0u);
}

TEST(Level, TakesOffsetAndTrendOfTheQuietPartAway) {
  const auto wave = [](double t) { return sin2(t, 500.0, 80.0); };
  const Record r = sample([&](double t) { return wave(t) + 7.0 - 0.004 * t; }, 1000);
  const Outcome<Levelled> levelled = level(r.values, {});
  ASSERT_TRUE(levelled.ok()) << levelled.error().reason;
  const Levelled& l = levelled.value();
  EXPECT_NEAR(l.offset, 7.0, 1e-9);
  EXPECT_NEAR(l.trend, -0.004, 1e-11);
  // Before the pulse's foot at 460, and not long before.
  EXPECT_LE(l.quiet, 461u);
  EXPECT_GT(l.quiet, 440u);
  EXPECT_LT(l.noise, 1e-6);
  for (std::size_t n = 0; n < r.values.size(); ++n) EXPECT_NEAR(l.values[n], wave(static_cast<double>(n)), 1e-6);
  EXPECT_NEAR(static_cast<double>(l.crest.index), 500.0, 1.0);
  EXPECT_NEAR(l.crest.width, 40.0, 3.0);
  EXPECT_EQ(l.crest.sign, 1.0);
}

TEST(Level, MeasuresTheNoise) {
  for (unsigned trial = 0; trial < 20; ++trial) {
    const Record r = with_noise(sample([](double t) { return -sin2(t, 700.0, 80.0) + 2.0; }, 1000), 0.05, trial);
    const Outcome<Levelled> l = level(r.values, {});
    ASSERT_TRUE(l.ok()) << l.error().reason;
    // Of 600 samples: 1/sqrt(1200) = 3 %; five of those.
    EXPECT_NEAR(l.value().noise / 0.05, 1.0, 0.15);
    EXPECT_EQ(l.value().crest.sign, -1.0);
    EXPECT_NEAR(static_cast<double>(l.value().crest.index), 700.0, 8.0);
  }
}

TEST(Level, TakesTheFirstHighCrestForTheWave) {
  // An echo twice as high, and a precursor of a fifth.
  const Record r = with_noise(
      sample([](double t) { return sin2(t, 500.0, 80.0) + 1.9 * sin2(t, 800.0, 80.0) + 0.2 * sin2(t, 350.0, 80.0); }, 1000), 0.005, 1);
  const Outcome<Levelled> l = level(r.values, {});
  ASSERT_TRUE(l.ok()) << l.error().reason;
  EXPECT_NEAR(static_cast<double>(l.value().crest.index), 500.0, 5.0);
  EXPECT_LE(l.value().quiet, 330u) << "the precursor is not quiet";
  EXPECT_NEAR(l.value().noise, 0.005, 0.002);
}

TEST(Level, RefusesWhatHasNoQuietPart) {
  const auto refused = [](const Record& r, Failure failure) {
    const Outcome<Levelled> l = level(r.values, {});
    ASSERT_FALSE(l.ok());
    EXPECT_EQ(name(l.error().failure), name(failure)) << l.error().reason;
  };
  refused(sample([](double) { return 2.0; }, 500), Failure::flat);
  refused(sample([](double t) { return sin2(t, 40.0, 60.0); }, 500), Failure::no_reference);
  refused(sample([](double t) { return sin2(t, 20.0, 20.0); }, 50), Failure::no_reference);
  Record broken = sample([](double t) { return sin2(t, 300.0, 60.0); }, 500);
  broken.values[7] = std::numeric_limits<double>::quiet_NaN();
  refused(broken, Failure::non_finite);
}

}  // namespace
}  // namespace ddem::harness
