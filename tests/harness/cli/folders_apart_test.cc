// Folders of one command that must not be the same: results and nights, shards and what they make together. By any name.

#include "tests/harness/cli/small_campaign.h"

namespace ddem::harness::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FoldersApart : public SmallCampaign {
 protected:
  void expect_no(const std::vector<std::string>& arguments, const std::string& why) const {
    const auto before = contents();
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(run.standard_error, HasSubstr(why)) << testing::PrintToString(arguments);
    expect_contents(before);
  }
};

TEST_F(FoldersApart, ResultsAndNights) {
  fs::create_directories(in_folder("night/nights"));
  fs::create_directory_symlink("night", in_folder("link"));
  const std::pair<const char*, const char*> pairs[] = {
      {"night", "night"},        {"night", "night/nights"}, {"night/nights", "night"},     {"night", "./night/"},  {"night", "link"},
      {"link", "night"},         {"night", "link/nights"},  {"link/nights", "night"},      {"new", "new"},         {"new", "new/nights"},
      {"new/deep/night", "new"}, {"link/new", "night/new"}, {"night", "night/nights/../x"}};
  for (const auto& [folder, history] : pairs) {
    expect_no({"validate", path("campaign.toml"), "-o", path(folder), "--history", path(history)}, "give the nights a folder of their own");
    expect_no({"merge", path("shard"), "-o", path(folder), "--history", path(history)}, "give the nights a folder of their own");
  }
  // A name that begins as the other is another folder.
  EXPECT_EQ(validate("night", {"--history", path("nights")}).exit_code, 0);
  EXPECT_EQ(validate("nights-of-2026", {"--history", path("nights")}).exit_code, 0);
}

TEST_F(FoldersApart, ShardsAndWhatTheyMakeTogether) {
  for (const char* i : {"1", "2"}) ASSERT_EQ(validate(std::string("shard-") + i, {"--shard", std::string(i) + "/2"}).exit_code, 0);
  fs::create_directory_symlink("shard-1", in_folder("link"));
  for (const char* name : {"shard-1", "./shard-1/", "link", "shard-2/../shard-1"}) {
    expect_no({"merge", path("shard-1"), path("shard-2"), "-o", path(name)}, "is one of the folders to be merged");
    expect_no({"merge", path("shard-1"), path("shard-2"), path(name), "-o", path("merged")}, "is given twice");
  }
  expect_no({"merge", path("shard-1"), path("shard-2"), "-o", path("merged"), "--partial"}, "--baseline");
  EXPECT_EQ(ddem({"merge", path("shard-1"), path("shard-2"), "-o", path("merged")}).exit_code, 0);
}

}  // namespace
}  // namespace ddem::harness::test
