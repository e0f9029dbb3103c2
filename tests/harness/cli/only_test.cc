// Studies asked for by name, in files and on the command line: that study with what it needs, and nothing else.

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "harness/io/json.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

constexpr const char* kStrip =
    "[strip]\nseeds = [1, 2]\nmodels = [\"dem\", \"implicit-full\"]\nstiffness_ratios = [0.3, 0.5]\ndiscs = 300\nlength = \"7.3 mm\"\n"
    "pulse_length = \"4 mm\"\n";

class Only : public Cli {
 protected:
  /// The first parts of the units' names that a plan has.
  std::set<std::string> kinds_planned(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"validate", path("strip.toml"), "--plan", "--force", "-o", path("planned")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    std::set<std::string> kinds;
    units_ = 0;
    const Json plan = read_json(in_folder("planned/plan.json"));
    for (const Json& unit : plan["units"]) {
      const std::string id = unit["id"];
      kinds.insert(id.substr(0, id.find('/')));
      ++units_;
    }
    return kinds;
  }

  std::size_t units_ = 0;
};

TEST_F(Only, AStudyHasItsUnitsAndThoseThatItsCasesNeed) {
  write("strip.toml", kStrip);
  using Kinds = std::set<std::string>;
  EXPECT_EQ(kinds_planned({"--only", "sizes"}), Kinds{"sizes"});
  EXPECT_EQ(kinds_planned({"--only", "sizes/waves"}), Kinds{"sizes"});
  EXPECT_EQ(kinds_planned({"--only", "statics"}), Kinds{"statics"});
  EXPECT_EQ(kinds_planned({"--only", "static/random"}), Kinds{"statics"});
  EXPECT_EQ(units_, 2u * 2u * 2u);
  EXPECT_EQ(kinds_planned({"--only", "paper-protocol"}), (Kinds{"paper", "statics"}));
  EXPECT_EQ(kinds_planned({"--only", "paper/random/dem/kt0.30"}), (Kinds{"paper", "statics"}));
  EXPECT_EQ(units_, 2u + 2u);
  EXPECT_EQ(kinds_planned({"--only", "long-wave/hexagonal/dem/kt0.30"}), (Kinds{"waves", "statics"}));
  EXPECT_EQ(units_, 2u);
  EXPECT_EQ(kinds_planned({"--only", "waves"}), (Kinds{"waves", "statics", "film", "finite_elements"}));
}

TEST_F(Only, ACampaignFileChooses) {
  using Kinds = std::set<std::string>;
  write("strip.toml", std::string(kStrip) + "[studies]\nrun = [\"statics\", \"schemes\"]\n");
  EXPECT_EQ(kinds_planned({}), (Kinds{"statics", "schemes", "poisson-range"}));
  EXPECT_EQ(kinds_planned({"--only", "schemes/range"}), Kinds{"poisson-range"});
  write("strip.toml", std::string(kStrip) + "[studies]\nskip = [\"waves\", \"paper_protocol\", \"finite_elements\"]\n");
  const Kinds rest = kinds_planned({});
  EXPECT_FALSE(rest.contains("waves") || rest.contains("paper") || rest.contains("finite_elements"));
  EXPECT_TRUE(rest.contains("statics") && rest.contains("sizes"));
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"[studies]\nrun = [\"wafes\"]\n", "did you mean \"waves\"?"},
           {"[studies]\nrun = [\"user_cases\"]\n", "no list of studies"},
           {"[studies]\nrun = []\n", "no list of studies"},
           {"[studies]\nrun = \"waves\"\n", "no list of studies"},
           {"[studies]\nruns = [\"waves\"]\n", "the keys are run, skip"},
           {"[studies]\nrun = [\"waves\"]\nskip = [\"statics\"]\n", "give run, or skip"}}) {
    write("strip.toml", kStrip + text);
    const auto run = ddem({"validate", path("strip.toml"), "-o", path("never")});
    EXPECT_EQ(run.exit_code, 2) << text;
    EXPECT_THAT(run.standard_error, HasSubstr(words));
    EXPECT_THAT(run.standard_error, HasSubstr("strip.toml:"));
    EXPECT_FALSE(std::filesystem::exists(in_folder("never")));
  }
}

TEST_F(Only, TheListSaysWhatThereIs) {
  write("strip.toml", kStrip);
  const auto run = ddem({"validate", path("strip.toml"), "--list", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const Json studies = parse_json(run.standard_output, "--list")["studies"];
  std::map<std::string, Json> by_id;
  for (const Json& s : studies) {
    EXPECT_GT(s["title"].get<std::string>().size(), 0u);
    EXPECT_GE(s["seconds"].get<double>(), 0.0);
    by_id[s["id"]] = s;
  }
  EXPECT_EQ(by_id.at("paper_protocol")["needs"], Json({"statics"}));
  EXPECT_EQ(by_id.at("sizes")["cases"], Json({"sizes/bias", "sizes/waves"}));
  EXPECT_TRUE(by_id.at("sizes")["needs"].empty());
  EXPECT_EQ(by_id.at("paper_protocol")["cases"].size(), 4u);
  const auto text = ddem({"validate", path("strip.toml"), "--list"});
  EXPECT_THAT(text.standard_output, HasSubstr("\n    paper/random/dem/kt0.30\n"));
}

/// Run alone it is judged as in the whole.
TEST_F(Only, ACaseAloneIsTheCaseOfTheWhole) {
  write("strip.toml", std::string(kStrip) + "[studies]\nrun = [\"statics\", \"paper_protocol\"]\n");
  ddem({"validate", path("strip.toml"), "-o", path("whole")});
  ddem({"validate", path("strip.toml"), "-o", path("one"), "--only", "paper/random/dem/kt0.50"});
  const Json whole = read_json(in_folder("whole/summary.json")), one = read_json(in_folder("one/summary.json"));
  EXPECT_EQ(whole["cases"].size(), 12u);
  ASSERT_EQ(one["cases"].size(), 1u);
  for (const Json& c : whole["cases"]) {
    if (c["id"] != "paper/random/dem/kt0.50") continue;
    EXPECT_EQ(c["criteria"], one["cases"][0]["criteria"]);
  }
}

}  // namespace
}  // namespace ddem::harness::test
