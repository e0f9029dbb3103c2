// What a report says can be pasted, and no command costs the report of another campaign.

#include "harness/io/atomic_file.h"
#include "tests/harness/cli/small_campaign.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

/// Statics of a small strip: four cases in some milliseconds.
const char* const kStrip =
    "[strip]\nseeds = [1, 2]\nmodels = [\"dem\", \"implicit-full\"]\nstiffness_ratios = [0.3]\ndiscs = 300\nlength = \"7.3 mm\"\npulse_length = "
    "\"4 mm\"\n";

class CampaignFolder : public SmallCampaign {
 protected:
  /// Everything below a folder, what locks it left out.
  std::map<std::string, std::string> files(const std::string& folder) const {
    std::map<std::string, std::string> inside;
    for (const auto& [name, text] : contents()) {
      if (name.starts_with(folder + "/") && !name.ends_with(".lock")) inside[name] = text;
    }
    return inside;
  }
  /// It is refused, says what is there and how to go on, and leaves the folder alone.
  void expect_refused_over(const std::string& folder, const std::vector<std::string>& arguments, const std::string& what) const {
    const auto before = files(folder);
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(arguments);
    for (const std::string& part : {path(folder), what, std::string("another"), std::string("-o"), std::string("--force")})
      EXPECT_THAT(run.standard_error, HasSubstr(part));
    EXPECT_EQ(files(folder), before) << testing::PrintToString(arguments);
  }
  std::vector<std::string> validate_into(const std::string& folder, const std::string& campaign, std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"validate", path(campaign), "-o", path(folder)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static std::string with_all(std::string text, std::string_view old, std::string_view by) {
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size())) text.replace(at, old.size(), by);
    return text;
  }
  /// Runs the commands that summary.json, report.html and junit.xml of a folder give for a case: each must be the same, and
  /// give that case alone, with the same numbers, into another folder.
  void expect_reproducible(const std::string& folder, const std::string& id) const {
    const Json summary = read_json(in_folder(folder) / "summary.json");
    for (const Json& c : summary["cases"]) {
      if (c["id"] != id) continue;
      const std::string command = c["reproduce"];
      for (const char* file : {"report.html", "junit.xml"}) {
        std::string text = read(folder + "/" + file);
        for (const auto& [entity, character] : {std::pair("&apos;", "'"), std::pair("&#39;", "'"), std::pair("&quot;", "\"")})
          text = with_all(text, entity, character);
        EXPECT_THAT(text, HasSubstr(command)) << file;
      }
      const auto before = files(folder);
      const auto run = shell(command);
      ASSERT_EQ(run.exit_code, 0) << command << run.standard_error;
      EXPECT_EQ(files(folder), before) << command;
      const std::string own = command.substr(command.rfind(" -o ") + 4);
      EXPECT_EQ(cases_in(own), std::vector<std::string>{id});
      const Json again = read_json(in_folder(own) / "summary.json")["cases"][0];
      EXPECT_EQ(again["criteria"], c["criteria"]) << command;
      EXPECT_EQ(again["reproduce"], command);
      EXPECT_EQ(shell(command).exit_code, 0) << "pasted twice";
      return;
    }
    ADD_FAILURE() << folder << " has no case " << id;
  }
};

// Three stiffness ratios by two densities, each a wave.
TEST_F(CampaignFolder, ItsProvenanceCountsWhatRan) {
  ASSERT_EQ(validate("night").exit_code, 0);
  EXPECT_THAT(read("night/report.html"), HasSubstr("<dt>simulations</dt><dd>6</dd>"));
}

TEST_F(CampaignFolder, CommandsOfAReportCanBePasted) {
  const std::vector<std::string> names = {"campaign.toml", "it's a \"campaign\" $HOME.toml", "-campaign.toml"};
  for (const std::string& name : names) {
    write(name, kSmallCampaign);
    const std::string words = name == names[1] ? "'it'\\''s a \"campaign\" $HOME.toml'" : "./" + name;
    ASSERT_EQ(shell("ddem validate " + words + " -o night --force").exit_code, 0) << name;
    expect_reproducible("night", "case/small/stiffness_ratio=0.3/density=2000-kg-m3");
    std::filesystem::remove_all(in_folder("ddem-only-case-small-stiffness_ratio=0.3-density=2000-kg-m3"));
  }
}

TEST_F(CampaignFolder, CommandsKeepWhatTheCampaignLeavesOut) {
  write("strip.toml", kStrip);
  ASSERT_EQ(shell("ddem validate strip.toml --static -o night").exit_code, 0);
  expect_reproducible("night", "static/random/implicit-full/kt0.30");
  const Json summary = read_json(in_folder("night/summary.json"));
  EXPECT_THAT(summary["cases"][0]["reproduce"], HasSubstr("--only static/hexagonal/dem/kt0.30 strip.toml -o "));
}

/// The strip of the paper needs no file.
TEST_F(CampaignFolder, CommandsOfTheDefaultCampaign) {
  ASSERT_EQ(shell("ddem validate --static --only static/hexagonal/dem/kt0.30").exit_code, 0);
  expect_reproducible("ddem-report", "static/hexagonal/dem/kt0.30");
}

/// The same campaign again, or with other criteria, titles and more cases, but no fewer.
TEST_F(CampaignFolder, TheSameCampaignMayComeAgain) {
  ASSERT_EQ(validate("night").exit_code, 0);
  const std::vector<std::string> more = {
      replaced(kSmallCampaign, "upper = 1e-10", "upper = 1e-9"), replaced(kSmallCampaign, "0.3, 0.5]", "0.3, 0.5, 0.7]"),
      std::string(kSmallCampaign) + "[[case]]\nid = \"b\"\nscene = \"scene.toml\"\n[[case.criterion]]\nmetric = \"bonds\"\nlower = 1\nderivation = \"d\"\n"};
  for (const std::string& text : more) {
    std::filesystem::remove_all(in_folder("night"));
    write("campaign.toml", kSmallCampaign);
    ASSERT_EQ(validate("night").exit_code, 0);
    write("campaign.toml", text);
    EXPECT_EQ(validate("night").exit_code, 0) << text;
  }
  EXPECT_EQ(cases_in("night").size(), 7u);
}

TEST_F(CampaignFolder, AnotherCampaignIsRefused) {
  ASSERT_EQ(validate("night").exit_code, 0);
  write("strip.toml", kStrip);
  write("fewer.toml", replaced(kSmallCampaign, "0.3, 0.5]", "0.3]"));
  write("other.toml", replaced(kSmallCampaign, "id = \"small\"", "id = \"smell\""));
  write("soft.toml", replaced(small_scene(), "1e10", "1e9"));
  write("softer.toml", replaced(kSmallCampaign, "scene = \"scene.toml\"", "scene = \"soft.toml\""));
  const std::string one = "case/small/stiffness_ratio=0.1/density=1000";
  expect_refused_over("night", validate_into("night", "fewer.toml"), "case/small/stiffness_ratio=0.5");
  expect_refused_over("night", validate_into("night", "other.toml"), "6 cases");
  expect_refused_over("night", validate_into("night", "softer.toml"), "another scene");
  expect_refused_over("night", validate_into("night", "strip.toml", {"--static"}), "case/small");
  expect_refused_over("night", validate_into("night", "campaign.toml", {"--only", one}), one);
  expect_refused_over("night", validate_into("night", "fewer.toml", {"--plan"}), "case/small");
  expect_refused_over("night", validate_into("night", "fewer.toml", {"--resume"}), "stiffness_ratio=0.5");
  expect_refused_over("night", validate_into("night", "fewer.toml", {"--shard", "1/2"}), "stiffness_ratio=0.5");

  // Forced: the units of the first are still there, and it goes on from them.
  ASSERT_EQ(ddem(validate_into("night", "fewer.toml", {"--force"})).exit_code, 0);
  EXPECT_EQ(cases_in("night").size(), 4u);
  EXPECT_TRUE(std::filesystem::exists(in_folder("night/cases/case/small/stiffness_ratio=0.5/density=1000.unit")));
  ASSERT_EQ(validate("night", {"--resume", "--force"}).exit_code, 0);
  EXPECT_EQ(cases_in("night").size(), 6u);
}

TEST_F(CampaignFolder, AStripOfOtherDiscsIsAnotherCampaign) {
  write("strip.toml", kStrip);
  ASSERT_EQ(ddem(validate_into("night", "strip.toml", {"--static"})).exit_code, 0);
  const std::vector<std::pair<std::string, std::string>> others = {{"discs = 300", "discs = 301"},
                                                                   {"[1, 2]", "[1, 3]"},
                                                                   {"[0.3]", "[0.4]"},
                                                                   {"[\"dem\", \"implicit-full\"]", "[\"dem\"]"}};
  for (const auto& [old, by] : others) {
    write("other.toml", replaced(kStrip, old, by));
    expect_refused_over("night", validate_into("night", "other.toml", {"--static"}), "strip.");
  }
  write("more.toml", replaced(kStrip, "[0.3]", "[0.3, 0.4]"));
  EXPECT_EQ(ddem(validate_into("night", "more.toml", {"--static"})).exit_code, 0);
}

TEST_F(CampaignFolder, ReportsWithoutAPlanAreKept) {
  for (const char* file : {"report.html", "summary.json", "results.h5", "junit.xml"}) {
    std::filesystem::create_directory(in_folder("folder"));
    write(std::string("folder/") + file, "of somebody");
    expect_refused_over("folder", validate_into("folder", "campaign.toml"), file);
    std::filesystem::remove_all(in_folder("folder"));
  }
  std::filesystem::create_directory(in_folder("folder"));
  write("folder/plan.json", "{\"program\": \"x\"}");
  expect_refused_over("folder", validate_into("folder", "campaign.toml"), "plan.json");
  EXPECT_EQ(validate("folder", {"--force"}).exit_code, 0);
}

TEST_F(CampaignFolder, MergesAndDrawingsAreRefusedTheSame) {
  ASSERT_EQ(validate("night").exit_code, 0);
  write("campaign.toml", replaced(kSmallCampaign, "0.3, 0.5]", "0.3]"));
  ASSERT_EQ(validate("part").exit_code, 0);
  expect_refused_over("night", {"merge", path("part"), "-o", path("night")}, "case/small");
  expect_refused_over("night", {"report", path("part"), "-o", path("night")}, "6 cases");
  ASSERT_EQ(ddem({"merge", path("part"), "-o", path("night"), "--force"}).exit_code, 0);
  EXPECT_EQ(cases_in("night").size(), 4u);

  // Drawn elsewhere, and there again.
  for (int k = 0; k < 2; ++k) ASSERT_EQ(ddem({"report", path("part"), "-o", path("drawn")}).exit_code, 0);
  EXPECT_EQ(read("drawn/report.html"), read("part/report.html"));
  ASSERT_EQ(ddem({"report", path("part")}).exit_code, 0);
  write("campaign.toml", kSmallCampaign);
  ASSERT_EQ(validate("whole").exit_code, 0);
  expect_refused_over("drawn", {"report", path("whole"), "-o", path("drawn")}, "report");
  EXPECT_EQ(ddem({"report", path("whole"), "-o", path("drawn"), "--force"}).exit_code, 0);
}

TEST_F(CampaignFolder, CasesAreNamedAndTimed) {
  ASSERT_EQ(validate("night").exit_code, 0);
  EXPECT_THAT(read("night/report.html"), HasSubstr("<title>Campaign of 6 cases</title>"));
  EXPECT_EQ(read_json(in_folder("night/summary.json"))["title"], "Campaign of 6 cases");
  const std::string junit = read("night/junit.xml");
  EXPECT_THAT(junit, testing::Not(HasSubstr("time=\"0\"")));
  EXPECT_THAT(junit, testing::Not(HasSubstr("time=\"0.000000\"")));
}

TEST_F(CampaignFolder, ACaseThatIsNoneIsFoundBeforeTheRun) {
  const auto near = validate("night", {"--only", "case/small/stiffness_ratio=0.3/density=1001"});
  EXPECT_EQ(near.exit_code, 2);
  EXPECT_THAT(near.standard_error, HasSubstr("did you mean case/small/stiffness_ratio=0.3/density=1000?"));
  write("strip.toml", kStrip);
  for (const char* only : {"static/random/deem/kt0.30", "nonsense/random/dem/kt0.30", "size", "x"}) {
    const auto run = ddem(validate_into("night", "strip.toml", {"--only", only}));
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.standard_error, HasSubstr("no such case"));
  }
  EXPECT_FALSE(std::filesystem::exists(in_folder("night")));
}

}  // namespace
}  // namespace ddem::harness::test
