// Shards into one folder: in any order, however often, and never by guessing.

#include "harness/nightly/merge.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "harness/io/errors.h"
#include "tests/harness/nightly/toy_units.h"

namespace ddem::harness::nightly {
namespace {

namespace fs = std::filesystem;

class Merge : public testing::Test {
 protected:
  fs::path shard(std::size_t i, std::size_t n) {
    const fs::path folder = scratch_ / ("shard-" + std::to_string(i));
    fs::create_directories(folder);
    write_plan(folder, toy_plan(units_));
    outcomes_of(units_, {.folder = folder, .shard = {i, n}});
    return folder;
  }
  fs::path target(const std::string& name) {
    fs::create_directories(scratch_ / name);
    return scratch_ / name;
  }
  void store(const fs::path& folder, std::size_t k, const Outcome& outcome) {
    fs::create_directories(folder);
    write_plan(folder, toy_plan(units_));
    write_unit(folder, {units_[k].id, toy_plan(units_).units[k].identity, outcome});
  }
  /// Names and contents of all files below.
  static std::map<std::string, std::string> files(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file())
        all[fs::relative(entry.path(), folder).string()] = content_of(entry.path());
    }
    return all;
  }

  Scratch scratch_;
  std::vector<Unit> units_ = toy_units(17);
};

TEST_F(Merge, IsTheWhole) {
  const std::vector<fs::path> folders = {shard(1, 3), shard(2, 3), shard(3, 3)};
  const MergeReport report = merge_folders(folders, target("all"));
  EXPECT_TRUE(report.missing.empty());
  EXPECT_TRUE(report.refused.empty());
  EXPECT_EQ(outcomes_in(scratch_ / "all", units_), outcomes_of(units_, {}));
}

TEST_F(Merge, CommutesAndRepeats) {
  std::vector<fs::path> folders = {shard(1, 3), shard(2, 3), shard(3, 3)};
  // Overlapping, with other times; and a failure where another folder has the result.
  Outcome again{toy_result(4), "", 3.5};
  again.result["seconds"] = 8.0;
  store(folders[0], 4, again);
  store(folders[2], 6, {nullptr, "no memory", 1.0});
  merge_folders(folders, target("first"));
  const auto first = files(scratch_ / "first");
  std::sort(folders.begin(), folders.end());
  int n = 0;
  do {
    const fs::path to = target("order-" + std::to_string(n++));
    merge_folders(folders, to);
    EXPECT_EQ(files(to), first);
    merge_folders(folders, to);
    EXPECT_EQ(files(to), first);
  } while (std::next_permutation(folders.begin(), folders.end()));
  const std::vector<fs::path> self = {scratch_ / "first"};
  merge_folders(self, scratch_ / "first");
  EXPECT_EQ(files(scratch_ / "first"), first);
  // One after the other.
  for (const fs::path& folder : folders) merge_folders(std::vector{folder}, target("steps"));
  EXPECT_EQ(files(scratch_ / "steps"), first);
}

TEST_F(Merge, NamesWhatIsMissingAndDamaged) {
  const std::vector<fs::path> folders = {shard(1, 2)};
  put(unit_path(folders[0], units_[2].id), "damaged");
  const MergeReport report = merge_folders(folders, target("all"));
  EXPECT_EQ(report.missing.size(), 9u);  // 8 of the other shard, and the damaged one
  EXPECT_NE(std::find(report.missing.begin(), report.missing.end(), units_[1].id), report.missing.end());
  ASSERT_EQ(report.refused.size(), 1u);
  EXPECT_NE(report.refused[0].find(units_[2].id), std::string::npos);
}

TEST_F(Merge, ConflictsAreAllNamedAndNothingIsWritten) {
  const fs::path a = shard(1, 1), b = scratch_ / "b";
  for (const std::size_t k : {3u, 5u}) {
    nlohmann::json other = toy_result(k);
    other["speed"] = other["speed"].get<double>() * (1.0 + 1e-15);
    store(b, k, {other, "", 0.0});
  }
  const auto message = message_of<InputError>([&] { merge_folders(std::vector{a, b}, target("all")); });
  for (const std::size_t k : {3u, 5u}) EXPECT_NE(message.find(units_[k].id), std::string::npos) << message;
  EXPECT_TRUE(files(scratch_ / "all").empty());
}

TEST_F(Merge, OtherPlansAreRefused) {
  const fs::path a = shard(1, 2);
  const std::vector<Unit> others = toy_units(3);
  fs::create_directories(scratch_ / "other");
  write_plan(scratch_ / "other", toy_plan(others));
  EXPECT_THROW(merge_folders(std::vector{a, scratch_ / "other"}, target("all")), InputError);
  EXPECT_THROW(merge_folders(std::vector{a}, scratch_ / "other"), InputError);
  EXPECT_THROW(merge_folders(std::vector{a, scratch_ / "nowhere"}, target("all")), InputError);
  EXPECT_TRUE(files(scratch_ / "all").empty());
}

}  // namespace
}  // namespace ddem::harness::nightly
