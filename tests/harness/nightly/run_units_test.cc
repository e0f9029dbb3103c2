// The same outcomes whoever runs the units, and no unit run twice.

#include "harness/nightly/run_units.h"

#include <gtest/gtest.h>

#include "harness/io/errors.h"
#include "tests/harness/nightly/toy_units.h"

namespace ddem::harness::nightly {
namespace {

TEST(RunUnits, SameForAnyNumberOfThreadsAndWithoutAFolder) {
  const std::vector<Unit> units = toy_units(23);
  const Outcomes one = outcomes_of(units, {});
  ASSERT_EQ(one.size(), 23u);
  for (const int jobs : {1, 2, 4}) {
    const Scratch scratch;
    EXPECT_EQ(outcomes_of(units, {.folder = scratch / "", .jobs = jobs}), one) << jobs;
    EXPECT_EQ(outcomes_in(scratch / "", units), one) << jobs;
  }
}

/// Every unit is in one shard, whatever their number, and shards differ by one unit at most.
TEST(RunUnits, ShardsArePartsOfTheWhole) {
  for (const std::size_t count : {1u, 2u, 3u, 7u, 40u}) {
    for (const std::size_t units : {0u, 1u, 5u, 23u}) {
      std::vector<int> seen(units, 0);
      for (std::size_t i = 1; i <= count; ++i) {
        const Shard shard{i, count};
        std::size_t size = 0;
        for (std::size_t k = 0; k < units; ++k) {
          if (shard.has(k)) ++seen[k], ++size;
        }
        EXPECT_EQ(size, shard.size(units));
        EXPECT_LE(size, units / count + 1);
      }
      EXPECT_EQ(seen, std::vector<int>(units, 1));
    }
  }
}

TEST(RunUnits, ShardsWriteTheirUnitsOnly) {
  const Scratch scratch;
  const std::vector<Unit> units = toy_units(11);
  EXPECT_EQ(outcomes_of(units, {.folder = scratch / "", .shard = {2, 3}}).size(), 4u);
  for (std::size_t k = 0; k < units.size(); ++k)
    EXPECT_EQ(std::filesystem::exists(unit_path(scratch / "", units[k].id)), k % 3 == 1) << k;
}

TEST(RunUnits, ShardsAsWritten) {
  EXPECT_EQ(parse_shard("2/8").index, 2u);
  EXPECT_EQ(parse_shard("8/8").count, 8u);
  for (const char* wrong : {"", "1", "1/", "/2", "0/2", "3/2", "-1/2", "1/2/3", "a/b",
                            "1/99999999999999999999", " 1/2", "1/2 ", "1/0"}) {
    EXPECT_THROW(parse_shard(wrong), InputError) << wrong;
  }
}

/// Those that take most may all come together; those that are kept, or are another shard's, do not.
TEST(RunUnits, OfKnownMemoryRunAsManyAtATimeAsFit) {
  const Scratch scratch;
  std::vector<Unit> units = toy_units(6);
  for (std::size_t k = 0; k < units.size(); ++k) units[k].memory = 1e9 * static_cast<double>(k);  // 15 GB, of the largest two 9
  const Plan plan = toy_plan(units);
  const auto refusal = [&](int jobs, double available, Shard shard = {}, bool resume = false) {
    try {
      require_memory_of_jobs(units, plan, {.folder = scratch / "", .jobs = jobs, .shard = shard, .resume = resume}, available);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal(2, 9.1e9), "");
  EXPECT_EQ(refusal(2, 8.9e9), "--jobs: 2 of the campaign's simulations at a time would take 9 GB of memory, and 8.9 GB are left; take --jobs 1");
  EXPECT_NE(refusal(4, 13e9).find("take --jobs 3"), std::string::npos) << refusal(4, 13e9);
  EXPECT_EQ(refusal(1, 1.0), "") << "one alone says so itself";
  EXPECT_EQ(refusal(100, 15.1e9), "");
  EXPECT_NE(refusal(100, 14.9e9), "");
  EXPECT_NE(refusal(2, 1e9).find("smaller ones"), std::string::npos);
  EXPECT_EQ(refusal(2, 5.1e9, {2, 3}), "") << "of 1 and 4";
  EXPECT_NE(refusal(2, 4.9e9, {2, 3}), "");
  outcomes_of(units, {.folder = scratch / "", .shard = {6, 6}});  // unit 5
  EXPECT_EQ(refusal(2, 7.1e9, {}, true), "");
  EXPECT_NE(refusal(2, 7.1e9), "");
  for (Unit& unit : units) unit.memory = 0.0;
  EXPECT_EQ(refusal(100, 1.0), "");
}

TEST(RunUnits, ResumesWithWhatIsWhole) {
  const Scratch scratch;
  std::vector<std::atomic<int>> runs(9);
  const std::vector<Unit> units = toy_units(9, &runs);
  const Outcomes whole = outcomes_of(units, {.folder = scratch / ""});
  std::filesystem::remove(unit_path(scratch / "", units[1].id));
  put(unit_path(scratch / "", units[2].id), content_of(unit_path(scratch / "", units[2].id)).substr(0, 100));
  std::filesystem::copy_file(unit_path(scratch / "", units[4].id), unit_path(scratch / "", units[3].id),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(outcomes_of(units, {.folder = scratch / "", .resume = true}), whole);
  for (std::size_t k = 0; k < units.size(); ++k) EXPECT_EQ(runs[k], k >= 1 && k <= 3 ? 2 : 1) << k;
  EXPECT_EQ(outcomes_of(units, {.folder = scratch / ""}), whole);  // not asked to resume: all again
  EXPECT_EQ(runs[0], 2);
}

TEST(RunUnits, OtherInputsAreRunAgain) {
  const Scratch scratch;
  std::vector<std::atomic<int>> runs(3);
  std::vector<Unit> units = toy_units(3, &runs);
  outcomes_of(units, {.folder = scratch / ""});
  units[1].inputs += " changed";
  outcomes_of(units, {.folder = scratch / "", .resume = true});
  EXPECT_EQ(runs[0], 1);
  EXPECT_EQ(runs[1], 2);
}

/// A unit that failed is in the folder, and gets another chance.
TEST(RunUnits, FailuresAreKeptAndTriedAgain) {
  const Scratch scratch;
  std::vector<Unit> units = toy_units(3);
  const auto good = units[1].run;
  units[1].run = []() -> nlohmann::json { throw std::runtime_error("no disk"); };
  const Outcomes failed = outcomes_of(units, {.folder = scratch / ""});
  EXPECT_EQ(outcomes_in(scratch / "", units), failed);
  EXPECT_NE(failed.at(1).find("no disk"), std::string::npos);
  units[1].run = good;
  EXPECT_EQ(outcomes_of(units, {.folder = scratch / "", .resume = true}), outcomes_of(units, {}));
}

TEST(RunUnits, ProgressCountsAllWork) {
  const Scratch scratch;
  std::vector<Unit> units = toy_units(6);
  units[2].work = 5;
  for (const bool resume : {false, true}) {
    std::atomic<std::size_t> done = 0;
    outcomes_of(units,
                {.folder = scratch / "", .jobs = 2, .resume = resume, .on_progress = [&](std::size_t n) {
                   done += n;
                 }});
    EXPECT_EQ(done, 10u);
  }
}

}  // namespace
}  // namespace ddem::harness::nightly
