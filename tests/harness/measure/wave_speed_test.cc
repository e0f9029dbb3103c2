#include "harness/measure/wave_speed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace ddem::harness {
namespace {

const FailedMeasurement miss{Failure::below_noise, "nothing there"};

TEST(WaveSpeed, MeanAndSampleStandardDeviation) {
  // Speeds 1, 2, 3, 4, 5: mean 3, sample variance 10/4.
  std::vector<PairDelay> pairs;
  for (int n = 1; n <= 5; ++n) pairs.push_back({n, n + 10, 0.01, 0.01 / n});
  const WaveSpeed result = wave_speed(pairs);
  EXPECT_EQ(result.good_pairs, 5U);
  EXPECT_NEAR(result.speed.value().mean, 3.0, 1e-14);
  EXPECT_NEAR(result.speed.value().stddev.value(), std::sqrt(2.5), 1e-14);
  EXPECT_NEAR(result.pairs[3].speed.value(), 4.0, 1e-14);
  EXPECT_EQ(result.pairs[3].to, 14);
}

TEST(WaveSpeed, FailedPairsMakeNoNumberUnlessFewerWillDo) {
  const std::vector<PairDelay> pairs{
      {0, 1, 1.0, 0.5}, {2, 3, 1.0, miss}, {4, 5, 1.0, 0.25}, {6, 7, 1.0, -0.1}};
  const WaveSpeed strict = wave_speed(pairs);
  EXPECT_EQ(strict.good_pairs, 2U);
  ASSERT_FALSE(strict.speed.ok());
  EXPECT_EQ(strict.speed.error().failure, Failure::too_few_picks);
  const std::string& reason = strict.speed.error().reason;
  EXPECT_NE(reason.find("2 of 4"), std::string::npos) << reason;
  EXPECT_NE(reason.find("pair 2-3: below_noise (nothing there)"), std::string::npos) << reason;
  EXPECT_NE(reason.find("pair 6-7: not_causal"), std::string::npos) << reason;
  EXPECT_THROW(strict.speed.value(), std::logic_error);

  const WaveSpeed lenient = wave_speed(pairs, 2);
  EXPECT_DOUBLE_EQ(lenient.speed.value().mean, 3.0);
  EXPECT_FALSE(lenient.pairs[1].speed.ok());
}

TEST(WaveSpeed, ASinglePairHasNoStandardDeviation) {
  const std::vector<PairDelay> pairs{{0, 1, 3.0, 1.5}};
  const WaveSpeed result = wave_speed(pairs);
  EXPECT_DOUBLE_EQ(result.speed.value().mean, 2.0);
  EXPECT_FALSE(result.speed.value().stddev.has_value());
}

TEST(WaveSpeed, NonFiniteDelaysNeverBecomeSpeeds) {
  for (const double bad :
       {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::denorm_min()}) {
    const std::vector<PairDelay> pairs{{0, 1, 3.0, bad}};
    EXPECT_FALSE(wave_speed(pairs).speed.ok()) << bad;
  }
}

TEST(WaveSpeed, WrongUse) {
  const std::vector<PairDelay> pairs{{0, 1, 0.0, 1.5}};
  EXPECT_THROW(wave_speed(pairs), std::invalid_argument);
  EXPECT_THROW(wave_speed({}), std::invalid_argument);
  const std::vector<PairDelay> good{{0, 1, 1.0, 1.5}};
  EXPECT_THROW(wave_speed(good, 0), std::invalid_argument);
}

TEST(DelayBetween, SaysWhichPickFailed) {
  EXPECT_DOUBLE_EQ(delay_between(Arrival{1.0, 1.0}, Arrival{3.5, 0.9}).value(), 2.5);
  const Outcome<double> second = delay_between(Arrival{1.0, 1.0}, miss);
  EXPECT_EQ(second.error().failure, Failure::below_noise);
  EXPECT_EQ(second.error().reason, "second probe: nothing there");
  EXPECT_EQ(delay_between(miss, Arrival{1.0, 1.0}).error().reason, "first probe: nothing there");
}

}  // namespace
}  // namespace ddem::harness
