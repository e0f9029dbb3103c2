// Regression is not failure: synthetic nights with known answers, false alarms and misses.

#include "harness/nightly/baseline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/io/errors.h"
#include "harness/nightly/comparison.h"
#include "harness/nightly/summary.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness::nightly {
namespace {

using reports::Criterion;
using reports::State;
using reports::Verdict;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Verdict verdict(const std::string& id, double actual, double target = 100.0, double tolerance = 10.0) {
  Criterion c{.metric = "speed",
              .actual = actual,
              .target = target,
              .lower = target - tolerance,
              .upper = target + tolerance,
              .unit = "m/s",
              .derivation = "made up"};
  c.state = actual >= c.lower && actual <= c.upper ? State::pass : State::fail;
  return {.case_id = id, .title = "A case", .state = c.state, .reason = "", .criteria = {c}, .reproduce = ""};
}

Baseline baseline_at(const std::vector<double>& values) {
  std::vector<std::vector<Verdict>> nights;
  for (const double v : values) nights.push_back({verdict("a", v)});
  std::vector<std::string> left_out;
  return baseline_of(nights, left_out);
}

State state_of(double now, const Baseline& baseline) {
  std::vector<Verdict> verdicts = {verdict("a", now)};
  compare(verdicts, baseline);
  EXPECT_EQ(verdicts[0].criteria[0].state, verdicts[0].state);
  return verdicts[0].state;
}

/// The accuracy band reaches from 90 to 110, 1 % of its half width is 0.1.
TEST(Baseline, AccuracyAndRegressionAreDifferentBands) {
  const Baseline b = baseline_at({102.0});
  EXPECT_EQ(state_of(102.0, b), State::pass);
  EXPECT_EQ(state_of(102.09, b), State::pass);
  EXPECT_EQ(state_of(102.11, b), State::regressed);
  EXPECT_EQ(state_of(109.9, b), State::regressed);
  EXPECT_EQ(state_of(110.1, b), State::fail);
  EXPECT_EQ(state_of(100.0, b), State::pass);  // better
  EXPECT_EQ(state_of(98.01, b), State::pass);  // as far on the other side
  EXPECT_EQ(state_of(97.8, b), State::regressed);
}

TEST(Baseline, NoiseIsWhatTheNightsDifferBy) {
  const Baseline b = baseline_at({101.0, 104.0, 102.0});
  EXPECT_DOUBLE_EQ(b.at("a | speed").value, 102.0);
  EXPECT_DOUBLE_EQ(b.at("a | speed").noise, 2.0);
  EXPECT_EQ(state_of(103.9, b), State::pass);
  EXPECT_EQ(state_of(104.1, b), State::regressed);
}

TEST(Baseline, OneSidedAndUnboundedCriteria) {
  const Criterion most{.metric = "drift", .upper = 1e-12}, least{.metric = "pairs", .lower = 3.0},
      both{.metric = "x", .lower = 1.0, .upper = 3.0}, none{.metric = "y"};
  EXPECT_LT(badness(most, 1e-15, 0.0), badness(most, 2e-15, 0.0));
  EXPECT_LT(badness(least, 5.0, 0.0), badness(least, 4.0, 0.0));
  EXPECT_DOUBLE_EQ(badness(both, 1.5, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(badness(none, 7.0, 5.0), 2.0);
}

TEST(Baseline, NothingThatIsNoNumberPasses) {
  const Baseline b = baseline_at({102.0});
  for (const double wrong : {std::nan(""), kInfinity, -kInfinity}) {
    Verdict v = verdict("a", wrong);
    v.criteria[0].state = v.state = State::pass;  // even where somebody calls it passed
    std::vector<Verdict> verdicts = {v};
    compare(verdicts, b);
    EXPECT_FALSE(reports::is_pass(verdicts[0].criteria[0].state)) << wrong;
    EXPECT_FALSE(reports::is_pass(verdicts[0].state)) << wrong;
    std::vector<std::string> left_out;
    const std::vector<std::vector<Verdict>> nights = {{v}};
    EXPECT_TRUE(baseline_of(nights, left_out).empty());
    EXPECT_EQ(left_out.size(), 1u);
    const Verdict read = parse_summary(summary_json({"t", 1.0, {}, {v}}), "here").verdicts[0];
    EXPECT_EQ(read.criteria[0].state, State::error);
  }
}

TEST(Baseline, NewAndLostMetrics) {
  std::vector<Verdict> verdicts = {verdict("new", 101.0)};
  const auto comparisons = compare(verdicts, baseline_at({102.0}));
  EXPECT_EQ(verdicts[0].state, State::no_baseline);
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_EQ(verdicts[1].case_id, "a");
  EXPECT_EQ(verdicts[1].state, State::missing);
  ASSERT_EQ(verdicts[1].criteria.size(), 1u);
  EXPECT_EQ(verdicts[1].criteria[0].metric, "speed");
  EXPECT_FALSE(reports::is_failure(verdicts[0].state));
  EXPECT_EQ(comparisons.size(), 2u);
  EXPECT_NE(comparison_text(comparisons).find("NO_BASELINE"), std::string::npos);
  // The night's summary keeps the state.
  const Summary read = parse_summary(summary_json({"t", 1.0, {}, verdicts}), "here");
  EXPECT_EQ(read.verdicts[1].criteria[0].state, State::missing);
}

/// Whatever is left out of a run: some metrics of a case, whole cases, all of it. What is there is judged as before.
TEST(Baseline, WhatARunLacksIsMissing) {
  std::vector<Verdict> whole;
  for (const char* id : {"a", "b", "c/d", "e"}) {
    whole.push_back(verdict(id, 101.0));
    whole.back().criteria.push_back(whole.back().criteria[0]);
    whole.back().criteria[1].metric = "other | speed";
  }
  std::vector<std::string> left_out;
  const Baseline baseline = baseline_of({whole}, left_out);
  ASSERT_EQ(baseline.size(), 8u);
  for (unsigned kept = 0; kept < 256; ++kept) {
    std::vector<Verdict> run;
    std::size_t metrics = 0;
    for (unsigned k = 0; k < 4; ++k) {
      Verdict v = whole[k];
      v.criteria.clear();
      for (const unsigned c : {0u, 1u}) {
        if ((kept >> (2 * k + c)) % 2 == 1) v.criteria.push_back(whole[k].criteria[c]), ++metrics;
      }
      if (!v.criteria.empty()) run.push_back(v);
    }
    std::vector<Verdict> verdicts = run, partial = run;
    const auto comparisons = compare(verdicts, baseline);
    EXPECT_EQ(count_of(State::missing, comparisons), 8 - metrics);
    EXPECT_EQ(count_of(State::pass, comparisons), metrics);
    EXPECT_EQ(measured_nothing(comparisons), metrics == 0);
    for (const Verdict& v : verdicts) {
      const auto lost = std::count_if(v.criteria.begin(), v.criteria.end(), [](const Criterion& c) { return c.state == State::missing; });
      EXPECT_EQ(v.state, lost > 0 ? State::missing : State::pass) << v.case_id;
      EXPECT_EQ(v.criteria.size(), 2u);
    }
    EXPECT_EQ(verdicts.size(), 4u);
    const Json j = comparison_json(comparisons);
    EXPECT_EQ(j["states"]["MISSING"], 8 - metrics);
    EXPECT_EQ(j["metrics"], 8);

    // Of a run that was to measure a part: what was not asked for is no case's.
    const auto some = compare(partial, baseline, [](const std::string& id) { return id == "a"; });
    EXPECT_EQ(count_of(State::missing, some) + count_of(State::skipped, some), 8 - metrics);
    EXPECT_EQ(count_of(State::missing, some), 2 - (kept & 1u) - ((kept >> 1) & 1u));
    for (const Verdict& v : partial) EXPECT_EQ(v.state == State::missing, v.case_id == "a" && (kept & 3u) != 3u);
  }
}

TEST(Baseline, AnotherUnitOrNameIsNotCompared) {
  std::vector<Verdict> verdicts = {verdict("a", 102.0)};
  verdicts[0].criteria[0].unit = "km/s";
  const auto units = compare(verdicts, baseline_at({102.0}));
  EXPECT_EQ(verdicts[0].state, State::missing);
  EXPECT_NE(comparison_text(units).find("in km/s here, in m/s in the baseline"), std::string::npos);
  verdicts = {verdict("a", 120.0)};
  verdicts[0].criteria[0].unit = "";
  compare(verdicts, baseline_at({102.0}));
  EXPECT_EQ(verdicts[0].state, State::fail) << "worse than MISSING";

  verdicts = {verdict("a", 102.0)};
  verdicts[0].criteria[0].metric = "sped";
  verdicts[0].criteria.push_back(verdicts[0].criteria[0]);
  verdicts[0].criteria[1].metric = "another";
  const auto names = compare(verdicts, baseline_at({102.0}));
  EXPECT_EQ(verdicts[0].state, State::missing);
  EXPECT_NE(comparison_text(names).find("did you mean sped"), std::string::npos) << comparison_text(names);
}

TEST(Baseline, WithoutMetricsItIsRefused) {
  const Scratch scratch;
  put(scratch / "b.json", baseline_text({}));
  EXPECT_NE(message_of<InputError>([&] { read_baseline(scratch / "b.json"); }).find("not one metric"), std::string::npos);
  std::filesystem::create_directory(scratch / "run");
  for (const std::vector<Verdict>& verdicts : {std::vector<Verdict>{}, std::vector<Verdict>{verdict("a", 500.0)}}) {
    put(scratch / "run/summary.json", to_text(summary_json({"t", 1.0, {}, verdicts})));
    EXPECT_NE(message_of<InputError>([&] { read_baseline(scratch / "run"); }).find("not one metric"), std::string::npos);
  }
}

TEST(Baseline, WhatFailedIsLeftOut) {
  std::vector<std::string> left_out;
  const std::vector<std::vector<Verdict>> nights = {{verdict("a", 101.0), verdict("b", 120.0)},
                                                    {verdict("a", 101.0), verdict("b", 101.0)}};
  const Baseline b = baseline_of(nights, left_out);
  EXPECT_EQ(b.size(), 1u);
  EXPECT_EQ(left_out, std::vector<std::string>{"b | speed"});
}

TEST(Baseline, TextIsSortedExactAndALineAMetric) {
  std::vector<std::string> left_out;
  const std::vector<std::vector<Verdict>> nights = {
      {verdict("z \"quoted\"", 1.0 / 3.0 + 100.0), verdict("a", 102.0)}};
  const Baseline b = baseline_of(nights, left_out);
  const std::string text = baseline_text(b);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2 + 3 + 3);  // the last but one is its digest
  EXPECT_LT(text.find("\"a | speed\""), text.find("quoted"));
  const Baseline back = parse_baseline(text, "here");
  ASSERT_EQ(back.size(), 2u);
  for (const auto& [key, e] : b) {
    EXPECT_EQ(back.at(key).value, e.value);
    EXPECT_EQ(back.at(key).noise, e.noise);
  }
  EXPECT_EQ(baseline_text(back), text);
}

TEST(Baseline, OtherFilesAreRefused) {
  for (const char* text :
       {"", "[]", "{}", "{\"schema_version\": 2, \"metrics\": {}}",
        "{\"schema_version\": 1, \"metrics\": {\"a\": 3}}",
        "{\"schema_version\": 1, \"metrics\": {\"a\": {\"value\": 1, \"noise\": -1, \"unit\": \"\"}}}",
        "{\"schema_version\": 1, \"metrics\": {\"a\": {\"value\": 1e999, \"noise\": 0, \"unit\": \"\"}}}",
        "{\"schema_version\": 1, \"metrics\": {\"a\": {\"value\": null, \"noise\": 0, \"unit\": \"\"}}}"}) {
    EXPECT_THROW(parse_baseline(text, "here"), InputError) << text;
  }
  const Scratch scratch;
  EXPECT_THROW(read_baseline(scratch / "mistyped"), InputError);
  EXPECT_EQ(scratch.entries(), 0);
}

TEST(Summary, RoundTrip) {
  Verdict v = verdict("a", 101.0);
  v.criteria.push_back({.metric = "drift", .actual = 1e-15, .upper = 1e-12, .state = State::regressed});
  v.criteria.push_back({.metric = "lost"});
  v.state = State::unstable_as_expected;
  const Summary s{"title", 12.5, {{"version", "1"}}, {v}};
  const Summary back = parse_summary(summary_json(s), "here");
  EXPECT_EQ(to_text(summary_json(back)), to_text(summary_json(s)));
  EXPECT_EQ(back.verdicts[0].state, State::unstable_as_expected);
  EXPECT_EQ(back.verdicts[0].criteria[1].lower, -kInfinity);
  EXPECT_TRUE(std::isnan(back.verdicts[0].criteria[2].actual));
  for (const char* text : {"{}", "[]", "3", "{\"schema_version\": 1}"})
    EXPECT_THROW(parse_summary(Json::parse(text), "here"), InputError);
}

}  // namespace
}  // namespace ddem::harness::nightly
