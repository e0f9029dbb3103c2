// The array script with the variables that Slurm would set, and a program that fails where it is told to: whatever goes wrong,
// a task that is started again ends in the report of the whole campaign.

#include <thread>

#include "harness/io/atomic_file.h"
#include "tests/harness/cli/small_campaign.h"

namespace ddem::harness::test {
namespace {

class Slurm : public SmallCampaign {
 protected:
  void SetUp() override {
    SmallCampaign::SetUp();
    // Notes its command, and dies as `fail-COMMAND` says: a line of a shell, once.
    write("ddem", std::string("#!/bin/bash\necho \"$1\" >>") + path("calls") + "\nif [[ -e " + path("fail-") + "$1 ]]; then\n  source " +
                      path("fail-") + "$1; rm " + path("fail-") + "$1; exit 4\nfi\nif [[ $1 == merge && -e " +
                      path("slow") + " ]]; then sleep 1; fi\nexec " + DDEM_PROGRAM + " \"$@\"\n");
    std::filesystem::permissions(in_folder("ddem"), std::filesystem::perms::owner_all);
    ASSERT_EQ(validate("whole").exit_code, 0);
  }

  SubprocessResult task(int number, int count = 3) const {
    return run_program("/usr/bin/env", {"SLURM_ARRAY_JOB_ID=7", "SLURM_ARRAY_TASK_COUNT=" + std::to_string(count),
                                        "SLURM_ARRAY_TASK_ID=" + std::to_string(number), "SLURM_CPUS_PER_TASK=1", "NIGHT=" + path("night"),
                                        "DDEM=" + path("ddem"), "bash", DDEM_SCENES "/../campaigns/slurm.sh", path("campaign.toml")});
  }
  void run_all() const {
    for (const int k : {2, 1, 3}) ASSERT_EQ(task(k).exit_code, 0) << k;
  }
  int merges() const {
    int count = 0;
    const std::string calls = read("calls");
    for (std::size_t at = calls.find("merge\n"); at != std::string::npos; at = calls.find("merge\n", at + 1)) ++count;
    return count;
  }
  bool is_merged() const { return std::filesystem::exists(in_folder("night/merged")); }
  void expect_whole(int after_merges) const {
    EXPECT_TRUE(is_merged());
    EXPECT_EQ(outcome("night/report"), outcome("whole"));
    EXPECT_EQ(merges(), after_merges);
  }
};

TEST_F(Slurm, TheLastTaskMerges) {
  for (const int k : {2, 1, 2, 3}) {  // one of them is started twice
    EXPECT_FALSE(std::filesystem::exists(in_folder("night/report"))) << k;
    const auto run = task(k);
    ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  }
  expect_whole(1);
}

/// The first merge fails in every way that we know; any task that is started again, whichever, does it.
TEST_F(Slurm, AMergeThatFailedIsDoneByAnyTask) {
  const std::vector<std::string> deaths = {"true",                   // exit code 4: a full disk
                                           "kill -KILL $$",          // the program
                                           "kill -KILL $PPID",       // the script above it, as a time limit does
                                           "touch $NIGHT/report"};   // no folder
  for (std::size_t k = 0; k < deaths.size(); ++k) {
    std::filesystem::remove_all(in_folder("night"));
    std::filesystem::remove(in_folder("calls"));
    write("fail-merge", deaths[k]);
    EXPECT_EQ(task(1).exit_code, 0);
    EXPECT_EQ(task(2).exit_code, 0);
    const auto last = task(3);
    EXPECT_TRUE(last.exit_code != 0 || last.signal != 0) << deaths[k];
    EXPECT_FALSE(is_merged()) << deaths[k];
    std::filesystem::remove(in_folder("fail-merge"));
    std::filesystem::remove_all(in_folder("night/report"));  // what was in the way
    const auto again = task(static_cast<int>(k % 3) + 1);
    EXPECT_EQ(again.exit_code, 0) << again.standard_error;
    expect_whole(2);
  }
}

TEST_F(Slurm, AShardThatDiedIsStartedAgain) {
  for (const char* death : {"true", "kill -KILL $$", "kill -KILL $PPID"}) {
    std::filesystem::remove_all(in_folder("night"));
    std::filesystem::remove(in_folder("calls"));
    EXPECT_EQ(task(1).exit_code, 0);
    write("fail-validate", death);
    const auto died = task(2);
    EXPECT_TRUE(died.exit_code != 0 || died.signal != 0);
    std::filesystem::remove(in_folder("fail-validate"));
    EXPECT_EQ(task(3).exit_code, 0);
    EXPECT_FALSE(is_merged());
    // Alone, as `sbatch --array=2`: the night is still cut into three.
    EXPECT_EQ(task(2, 1).exit_code, 0);
    expect_whole(1);
  }
}

TEST_F(Slurm, WhatIsStartedAgainAfterTheMergeIsMergedAgain) {
  run_all();
  expect_whole(1);
  std::filesystem::remove(in_folder("night/shard-2/cases/case/small/stiffness_ratio=0.1/density=2000-kg-m3.unit"));
  EXPECT_EQ(task(2).exit_code, 0);
  expect_whole(2);
}

TEST_F(Slurm, TasksThatEndAtOnceMergeOnce) {
  EXPECT_EQ(task(1).exit_code, 0);
  write("slow", "");  // the other is there before the merge has ended
  std::vector<std::jthread> tasks;
  for (const int k : {2, 3}) tasks.emplace_back([this, k] { EXPECT_EQ(task(k).exit_code, 0); });
  tasks.clear();
  expect_whole(1);
}

TEST_F(Slurm, ATaskOfAnotherCutIsRefused) {
  run_all();
  const auto run = task(4, 8);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.standard_error, testing::HasSubstr("--array=1-3"));
  expect_whole(1);
}

/// A file that a full disk cut, or that somebody wrote: no task starts on it, and none takes it for its own cut.
TEST_F(Slurm, ACutThatIsNoNumberIsRefused) {
  std::filesystem::create_directory(in_folder("night"));
  for (const char* junk : {"\n", " ", "0", "-3", "03", "3x", "3 4", "3\n4\n", "1e1", "0x3", "x[$(touch run-by-bash)]", "\xff"}) {
    write("night/shards", junk);
    const auto run = task(1);
    EXPECT_EQ(run.exit_code, 2) << junk;
    EXPECT_THAT(run.standard_error, testing::HasSubstr("/shards: holds no number of tasks; remove it")) << junk;
    EXPECT_EQ(read("night/shards"), junk);
  }
  EXPECT_FALSE(std::filesystem::exists("run-by-bash"));
  EXPECT_FALSE(std::filesystem::exists(in_folder("calls")));
  std::filesystem::remove(in_folder("night/shards"));
  run_all();
  expect_whole(1);
}

}  // namespace
}  // namespace ddem::harness::test
