// Trends over nights: made-up nights, with noise, steps, drifts, slow machines.

#include "harness/nightly/history.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>

#include "harness/io/errors.h"
#include "harness/nightly/broken_since.h"
#include "tests/harness/io/scratch.h"
#include "tests/harness/nightly/made_up_nights.h"

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

/// Any short night that waits for the processor, at its start, at that of its workers and at its end, is as it was; what takes
/// longer than that is slower, however short it was.
TEST(History, WaitsForTheProcessorAreNoSlowerNight) {
  for (const double seconds : {0.01, 0.04, 0.1, 0.5, 1.4}) {
    std::vector<Night> all = nights(6, [](int) { return 102.0; });
    for (Night& n : all) n.summary.wall_seconds = seconds;
    all.back().summary.wall_seconds = seconds + 0.29;
    EXPECT_FALSE(regressed(all, "wall time")) << seconds;
    all.back().summary.wall_seconds = seconds + 0.31;
    EXPECT_TRUE(regressed(all, "wall time")) << seconds;
  }
}

TEST(History, NightsThatFailedAreNoReference) {
  std::vector<Night> all = nights(5, [](int) { return 102.0; });
  all[2].summary.verdicts[0].criteria[0].actual = std::nan("");
  EXPECT_FALSE(regressed(all));
  all.push_back(night(5, std::nan("")));
  EXPECT_EQ(trends_of(all)[0].state, State::fail);
  EXPECT_NE(trends_text(all, trends_of(all), false).find("FAIL"), std::string::npos);
}

std::vector<double> values_of(const std::vector<Night>& nights) {
  std::vector<double> values;
  for (const Night& n : nights) values.push_back(n.summary.verdicts[0].criteria[0].actual);
  return values;
}

/// Clocks that run ahead, behind, or are reset: in any order of days the last night added is judged, and every night that is
/// dated before one that was there is named.
TEST(History, ClocksDoNotOrderNights) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Scratch scratch;
    std::vector<int> days(6);
    for (int& day : days) day = std::uniform_int_distribution<int>(0, 250)(random);
    int latest = days[0];
    std::size_t backwards = 0;
    for (std::size_t k = 0; k < days.size(); ++k) {
      append_night(scratch / "nights", night(days[k], k + 1 == days.size() ? 120.0 : 101.0));
      backwards += days[k] < latest;
      latest = std::max(latest, days[k]);
    }
    const std::vector<Night> back = read_history(scratch / "nights");
    EXPECT_EQ(values_of(back), (std::vector<double>{101.0, 101.0, 101.0, 101.0, 101.0, 120.0}));
    EXPECT_EQ(trends_of(back)[0].state, State::fail);
    EXPECT_TRUE(regressed(back));
    EXPECT_EQ(clock_complaints(back).size(), backwards > 0 ? backwards + 1 : 0u);
  }
  EXPECT_TRUE(clock_complaints({night(3, 101.0)}, "2026-01-05T00:00:00Z").empty());
  EXPECT_EQ(clock_complaints({night(3, 101.0)}, "2026-01-03T00:00:00Z").size(), 2u) << "a night of the future";
}

/// Files of earlier versions are called by their time: they come first, by time.
TEST(History, NightsThatAreNotCountedComeFirst) {
  const Scratch scratch;
  const auto folder = scratch / "nights";
  append_night(folder, night(9, 101.0));
  append_night(folder, night(2, 102.0));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  for (const auto& file : files) {
    const std::string name = file.filename().string();
    std::filesystem::rename(file, folder / name.substr(name.find('_') + 1));
  }
  EXPECT_EQ(values_of(read_history(folder)), (std::vector<double>{102.0, 101.0}));
  EXPECT_TRUE(append_night(folder, night(1, 103.0)).filename().string().starts_with("night-000001_"));
  append_night(folder, night(0, 104.0));
  EXPECT_EQ(values_of(read_history(folder)), (std::vector<double>{102.0, 101.0, 103.0, 104.0}));
}

TEST(History, NightsThatAreAddedAtOnceAreAllThere) {
  const Scratch scratch;
  std::vector<std::jthread> writers;
  for (int k = 0; k < 8; ++k) writers.emplace_back([&, k] { append_night(scratch / "nights", night(5, 101.0 + k)); });
  writers.clear();
  std::vector<double> values = values_of(read_history(scratch / "nights"));
  std::sort(values.begin(), values.end());
  EXPECT_EQ(values, (std::vector<double>{101.0, 102.0, 103.0, 104.0, 105.0, 106.0, 107.0, 108.0}));
}

TEST(History, WhatTheLastNightLacksIsMissing) {
  std::vector<Night> all = nights(4, [](int) { return 102.0; });
  all.back().summary.verdicts[0].case_id = "renamed";
  const std::vector<Trend> trends = trends_of(all);
  ASSERT_EQ(trends.size(), 3u);
  EXPECT_EQ(trends[1].case_id, "a");
  EXPECT_EQ(trends[1].state, State::missing);
  EXPECT_NE(trends_text(all, trends, false).find("MISSING     a: speed: none"), std::string::npos) << trends_text(all, trends, false);
  all.push_back(all.back());
  EXPECT_EQ(trends_of(all).size(), 2u) << "the night before lacks it, too";
}

TEST(History, OneFileANight) {
  const Scratch scratch;
  const auto folder = scratch / "nights";
  EXPECT_THROW(read_history(folder), InputError);
  for (const int day : {3, 1, 2, 2}) append_night(folder, night(day, 100.0 + day));
  const std::vector<Night> back = read_history(folder);
  EXPECT_EQ(values_of(back), (std::vector<double>{103.0, 101.0, 102.0, 102.0})) << "in the order in which they were added";
  EXPECT_EQ(back.back().work.seeds, (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(back.back().work.steps, 1000);
  put(folder / "night-000009_torn.json", "{\"time\": ");
  put(folder / "2026-01-01T020000Z.json", "{}");
  const auto message = message_of<InputError>([&] { read_history(folder); });
  EXPECT_NE(message.find("torn.json"), std::string::npos);
  EXPECT_NE(message.find("2026-01-01T020000Z.json"), std::string::npos);
}

/// Whatever else is kept in the folder, of any content: also a night by another name, such as a copy.
TEST(History, OtherFilesAreLeftAlone) {
  const Scratch scratch;
  const auto folder = scratch / "nights";
  std::filesystem::create_directory(folder);
  const std::vector<std::string> others = {"2026-11-22.json", "202X-11-22T020000Z.json", "baseline.json", "night-.json",
                                           "night-1.json",    "night-x_1.json",          "summary.json"};
  for (const std::string& name : others) put(folder / name, "{\"time\": ");
  EXPECT_NE(message_of<InputError>([&] { read_history(folder); }).find("no nights"), std::string::npos);
  EXPECT_TRUE(nights_so_far(folder).empty());
  const auto first = append_night(folder, night(1, 101.0));
  EXPECT_TRUE(first.filename().string().starts_with("night-000001_"));
  std::filesystem::copy_file(first, folder / "copy of a night.json");
  EXPECT_EQ(values_of(read_history(folder)), (std::vector<double>{101.0}));
  std::vector<std::string> left;
  for (const auto& file : files_beside_nights(folder)) left.push_back(file.filename().string());
  std::vector<std::string> expected = others;
  expected.push_back("copy of a night.json");
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(left, expected);
}

TEST(History, TextSaysWhatChanged) {
  const auto all = nights(30, [](int k) { return k == 29 ? 104.0 : 102.0; });
  const std::string text = trends_text(all, trends_of(all), false);
  for (const char* part : {"REGRESSED", "a: speed", "4 nights: +2", "100 nights", "30 nights"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
  EXPECT_EQ(text.find("wall time"), std::string::npos);
  EXPECT_NE(trends_text(all, trends_of(all), true).find("wall time"), std::string::npos);
}

TEST(BrokenSince, CountsTheNightsWithoutAGap) {
  std::vector<Night> nights = made_up_nights(5);
  EXPECT_TRUE(broken_since(nights).empty());
  EXPECT_TRUE(broken_since({}).empty());
  const auto fail = [&nights](int night, int verdict) { nights[night].summary.verdicts[verdict].state = reports::State::fail; };
  fail(4, 1);  // this night alone
  fail(0, 2), fail(2, 2), fail(3, 2), fail(4, 2);  // again since the third
  fail(3, 0);                                      // mended since
  EXPECT_EQ(broken_since(nights), (std::vector<std::string>{"energy fails since 2026-01-03T02:00:00Z, 3 nights.", "wave/jump broke this night."}));
  // Nights without the case, or that did not run it, neither count nor end the count.
  nights[3].summary.verdicts[2].state = reports::State::skipped;
  EXPECT_EQ(broken_since(nights).front(), "energy fails since 2026-01-03T02:00:00Z, 2 nights.");
  nights[3].summary.verdicts.clear();
  EXPECT_EQ(broken_since(nights).front(), "energy fails since 2026-01-03T02:00:00Z, 2 nights.");
  EXPECT_EQ(broken_since({nights[0]}).front(), "energy fails in its first night.");
  for (reports::Verdict& v : nights[4].summary.verdicts) v.state = reports::State::fail;
  EXPECT_EQ(broken_since(nights).size(), 6u);
  EXPECT_EQ(broken_since(nights).back(), "7 more fail.");
}

}  // namespace
}  // namespace ddem::harness::nightly
