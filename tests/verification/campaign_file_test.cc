// Campaign files: what is wrong is listed at once, and what is right is taken over.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "harness/campaign/read_campaign.h"
#include "harness/io/errors.h"
#include "harness/studies/strip/read_strip.h"

namespace ddem::harness {
namespace {

class CampaignFiles : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  std::filesystem::path write(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return path_;
  }

  /// The messages that reading a file of that text throws; none if it is accepted.
  std::vector<std::string> problems(const std::string& text) {
    try {
      read_campaign(write(text));
    } catch (const InputError& e) {
      return e.messages();
    }
    return {};
  }

  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("ddem-campaign-" + std::to_string(getpid()) + ".toml");
};

/// Whether one message holds all of the words.
bool one_says(const std::vector<std::string>& messages, const std::vector<std::string>& words) {
  for (const std::string& m : messages) {
    bool all = true;
    for (const std::string& w : words) all = all && m.find(w) != std::string::npos;
    if (all) return true;
  }
  return false;
}

TEST_F(CampaignFiles, TakesUnitsAndKeepsDefaults) {
  const StripCampaign s =
      strip_in(read_campaign(write("[strip]\ntitle = \"soft\"\nlength = \"33 mm\"\nparticle_modulus = \"20 "
                                "GPa\"\nseeds = [3, 7]\nmodels = [\"lagged-full\"]\n"
                                "stiffness_ratios = [0.0, 0.5]\nrows = 12\n")));
  EXPECT_EQ(s.title, "soft");
  EXPECT_DOUBLE_EQ(s.length, 33e-3);
  EXPECT_DOUBLE_EQ(s.particle_modulus, 20e9);
  EXPECT_EQ(s.seeds, (std::vector<std::int64_t>{3, 7}));
  EXPECT_EQ(s.models, std::vector<Model>{Model::lagged_full});
  EXPECT_EQ(s.stiffness_ratios, (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(s.rows, 12);
  EXPECT_DOUBLE_EQ(s.width, StripCampaign{}.width);
  EXPECT_EQ(s.columns, StripCampaign{}.columns);
}

TEST_F(CampaignFiles, ListsEveryProblemAtOnce) {
  const auto found = problems(
      "stray = 1\n"                      // 1
      "[strip]\n"                        // 2
      "densty = 2000.0\n"                // 3
      "length = \"16.5 GPa\"\n"          // 4
      "seeds = [1, 1]\n"                 // 5
      "stiffness_ratios = [0.5, 0.2]\n"  // 6
      "models = [\"dem\", \"deem\"]\n"   // 7
      "rows = \"ten\"\n"                 // 8
      "particle_poisson_ratio = 1.5\n"   // 9
      "normal_stiffness = -1e10\n"       // 10
      "width = nan\n"                    // 11
      "[strips]\n"                       // 12
      "length = 1.0\n");
  const std::string file = path_.string();
  EXPECT_TRUE(one_says(found, {file, "1", "stray", "[strip]"}));
  EXPECT_TRUE(one_says(found, {file, "3", "densty", "unknown key", "density"}));
  EXPECT_TRUE(one_says(found, {file, "4", "strip.length", "16.5 GPa", "length"}));
  EXPECT_TRUE(one_says(found, {file, "5", "strip.seeds", "ascending"}));
  EXPECT_TRUE(one_says(found, {file, "6", "strip.stiffness_ratios", "from 0 to 1"}));
  EXPECT_TRUE(one_says(found, {file, "7", "strip.models", "lagged-normal"}));
  EXPECT_TRUE(one_says(found, {file, "8", "strip.rows", "whole number"}));
  EXPECT_TRUE(one_says(found, {file, "9", "strip.particle_poisson_ratio", "at most"}));
  EXPECT_TRUE(one_says(found, {file, "10", "strip.normal_stiffness", "greater than 0"}));
  EXPECT_TRUE(one_says(found, {file, "11", "strip.width"}));
  EXPECT_TRUE(one_says(found, {file, "12", "strips", "unknown table"}));
  EXPECT_EQ(found.size(), 11u);
}

TEST_F(CampaignFiles, OddRowsAreListedWithTheRest) {
  EXPECT_TRUE(one_says(problems("[strip]\nrows = 11\n"), {"strip.rows", "11", "even"}));
  const auto both = problems("[strip]\nrows = 11\ndensty = 1.0\n");
  EXPECT_TRUE(one_says(both, {"strip.rows", "11", "even"}));
  EXPECT_TRUE(one_says(both, {"densty"}));
}

TEST_F(CampaignFiles, EachBadValueIsRefused) {
  for (const std::string line : {"seeds = []",
                                 "seeds = [1]",
                                 "seeds = [2, 1]",
                                 "seeds = [1.5, 2.5]",
                                 "seeds = 1",
                                 "seeds = [-1, 2]",
                                 "stiffness_ratios = []",
                                 "stiffness_ratios = [0.2, 1.2]",
                                 "stiffness_ratios = [-0.1]",
                                 "stiffness_ratios = [0.1, 0.1]",
                                 "stiffness_ratios = [nan]",
                                 "stiffness_ratios = \"0.1\"",
                                 "models = []",
                                 "models = \"dem\"",
                                 "models = [\"dem\", \"dem\"]",
                                 "models = [1]",
                                 "discs = 10",
                                 "discs = 1.5",
                                 "columns = 3",
                                 "step_fraction = 0.0",
                                 "step_fraction = 1.5",
                                 "coordination = 7.0",
                                 "density = \"2 kg\"",
                                 "density = inf",
                                 "pulse_length = \"8\"",
                                 "title = 3",
                                 "fem_degree = 0",
                                 "fem_degree = 99",
                                 "length = [1.0]",
                                 "length = true"}) {
    EXPECT_EQ(problems("[strip]\n" + line + "\n").size(), 1u) << line;
  }
}

TEST_F(CampaignFiles, MissingFileAndRubbish) {
  EXPECT_THROW(read_campaign("/nowhere/campaign.toml"), InputError);
  try {
    read_campaign("/nowhere/campaign.toml");
  } catch (const InputError& e) {
    EXPECT_TRUE(one_says(e.messages(), {"/nowhere/campaign.toml"}));
  }
  EXPECT_THROW(read_campaign(std::filesystem::temp_directory_path()), InputError);
  EXPECT_FALSE(problems(std::string("\x7f"
                                    "ELF\x00\x01\xff\xfe[strip",
                                    14))
                   .empty());
  EXPECT_FALSE(problems("[strip]\nseeds = " + std::string(100000, '[')).empty());
  EXPECT_FALSE(problems("[strip]\nlength = 1\nlength = 2\n").empty());
}

}  // namespace
}  // namespace ddem::harness
