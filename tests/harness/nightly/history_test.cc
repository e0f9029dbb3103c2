// Trends over nights: made-up nights, with noise, steps, drifts, slow machines.

#include "harness/nightly/history.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "harness/io/errors.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness::nightly {
namespace {

using reports::State;

/// One metric with the target 100 and the band 90 .. 110.
Night night(int day, double value, double seconds = 60.0, std::int64_t steps = 1000) {
  reports::Criterion c{
      .metric = "speed", .actual = value, .target = 100.0, .lower = 90.0, .upper = 110.0, .unit = "m/s"};
  c.state = value >= 90.0 && value <= 110.0 ? State::pass : State::fail;
  Night n{fmt::format("2026-{:02}-{:02}T02:00:00Z", 1 + day / 28, 1 + day % 28),
          {"t", seconds, {{"version", "1"}}, {{.case_id = "a", .state = c.state, .criteria = {c}}}},
          {}};
  n.work = {10, 20, steps, 3, {1, 2}};
  return n;
}

template <class Value>
std::vector<Night> nights(int count, const Value& value) {
  std::vector<Night> all;
  for (int k = 0; k < count; ++k) all.push_back(night(k, value(k)));
  return all;
}

bool regressed(const std::vector<Night>& all, const std::string& metric = "speed") {
  for (const Trend& t : trends_of(all)) {
    if (t.metric == metric) return t.regressed;
  }
  ADD_FAILURE() << "no trend of " << metric;
  return false;
}

TEST(History, AStepIsFoundAtOnce) {
  for (const int count : {3, 5, 21, 101, 150}) {
    EXPECT_TRUE(regressed(nights(count, [&](int k) { return k + 1 == count ? 103.0 : 102.0; }))) << count;
    EXPECT_FALSE(regressed(nights(count, [](int) { return 102.0; }))) << count;
    EXPECT_FALSE(regressed(nights(count, [&](int k) { return k + 1 == count ? 101.0 : 102.0; })))
        << count << ": better";
  }
}

/// A thousandth of the band a night: 0.01 each, which no short window tells from nothing (1 % of the half
/// width is 0.1); twenty nights do, whose median is ten nights old.
TEST(History, SlowDriftsAreFoundByTheLongWindows) {
  const auto drift = nights(101, [](int k) { return 102.0 + 0.011 * k; });
  for (const Trend& t : trends_of(drift)) {
    if (t.metric != "speed") continue;
    EXPECT_TRUE(t.regressed);
    EXPECT_LT(t.change[0], t.scatter[0]);
    EXPECT_NEAR(t.change[2], 0.011 * 50.5, 1e-9);
  }
}

/// Gaussian noise of one per cent of the band: at three standard deviations, of the worse side, less than one
/// night in a hundred is a false alarm of a window with a well-known scatter; four nights know it badly.
TEST(History, NoiseRarelyAlarms) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(103.0, 0.5);
  int alarms = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const auto all = nights(101, [&](int) { return noise(random); });
    const std::vector<Trend> trends = trends_of(all);
    alarms += trends[0].change[1] > trends[0].scatter[1] || trends[0].change[2] > trends[0].scatter[2];
  }
  EXPECT_LE(alarms, 5);
  int found = 0;
  for (int trial = 0; trial < 100; ++trial)
    found += regressed(nights(30, [&](int k) { return noise(random) + (k == 29 ? 4.0 : 0.0); }));
  EXPECT_GE(found, 95);  // a change of eight standard deviations
}

TEST(History, TheBandIsThreeStandardDeviationsOfANight) {
  // Steps of 1 between nights, up and down, of which two nights' deviations make each: 3 x 1.4826 / sqrt(2) = 3.145. Of equal
  // nights one hundredth of the band's half width, 0.1.
  const auto swinging = [](double change) {
    return nights(21, [&](int k) { return k == 20 ? 102.0 + change : k % 2 == 0 ? 101.5 : 102.5; });
  };
  EXPECT_FALSE(regressed(swinging(3.145 * 0.97)));
  EXPECT_TRUE(regressed(swinging(3.145 * 1.03)));
  const auto still = [](double change) { return nights(21, [&](int k) { return k == 20 ? 102.0 + change : 102.0; }); };
  EXPECT_FALSE(regressed(still(0.097)));
  EXPECT_TRUE(regressed(still(0.103)));
}

TEST(History, WallTimeOfEqualWorkOnly) {
  std::vector<Night> all = nights(6, [](int) { return 102.0; });
  all.push_back(night(6, 102.0, 90.0));
  EXPECT_TRUE(regressed(all, "wall time"));
  all.back() = night(6, 102.0, 90.0, 1500);
  EXPECT_FALSE(regressed(all, "wall time"));
  all.back() = night(6, 102.0, 70.0);
  EXPECT_FALSE(regressed(all, "wall time"));
}

TEST(History, NightsThatFailedAreNoReference) {
  std::vector<Night> all = nights(5, [](int) { return 102.0; });
  all[2].summary.verdicts[0].criteria[0].actual = std::nan("");
  EXPECT_FALSE(regressed(all));
  all.push_back(night(5, std::nan("")));
  EXPECT_EQ(trends_of(all)[0].state, State::fail);
  EXPECT_NE(trends_text(all, trends_of(all), false).find("FAIL"), std::string::npos);
}

TEST(History, OneFileANight) {
  const Scratch scratch;
  const auto folder = scratch / "nights";
  EXPECT_THROW(read_history(folder), InputError);
  for (const int day : {3, 1, 2, 2}) append_night(folder, night(day, 100.0 + day));
  const std::vector<Night> back = read_history(folder);
  ASSERT_EQ(back.size(), 4u);
  EXPECT_EQ(back.front().summary.verdicts[0].criteria[0].actual, 101.0);
  EXPECT_EQ(back.back().summary.verdicts[0].criteria[0].actual, 103.0);
  EXPECT_EQ(back.back().work.seeds, (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(back.back().work.steps, 1000);
  put(folder / "torn.json", "{\"time\": ");
  put(folder / "other.json", "{}");
  const auto message = message_of<InputError>([&] { read_history(folder); });
  EXPECT_NE(message.find("torn.json"), std::string::npos);
  EXPECT_NE(message.find("other.json"), std::string::npos);
}

TEST(History, TextSaysWhatChanged) {
  const auto all = nights(30, [](int k) { return k == 29 ? 104.0 : 102.0; });
  const std::string text = trends_text(all, trends_of(all), false);
  for (const char* part : {"REGRESSED", "a: speed", "4 nights: +2", "100 nights", "30 nights"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
  EXPECT_EQ(text.find("wall time"), std::string::npos);
  EXPECT_NE(trends_text(all, trends_of(all), true).find("wall time"), std::string::npos);
}

}  // namespace
}  // namespace ddem::harness::nightly
