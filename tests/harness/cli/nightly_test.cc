// Campaigns from outside: the same bits however they are run, shards, kills, baselines, nights.

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "harness/io/atomic_file.h"
#include "harness/io/json.h"
#include "tests/harness/cli/small_campaign.h"

extern char** environ;

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

class Nightly : public SmallCampaign {
 protected:
  /// Starts a campaign and kills it, and what it started, after some time.
  void kill_after(unsigned microseconds, const std::string& folder, bool resume) const {
    std::vector<std::string> words = {DDEM_PROGRAM, "validate", path("campaign.toml"), "-o", path(folder),
                                      "-j",         "2"};
    if (resume) words.push_back("--resume");
    std::vector<char*> argv;
    for (std::string& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&quiet, 2, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    ASSERT_EQ(::posix_spawn(&child, DDEM_PROGRAM, &quiet, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&quiet);
    ::usleep(microseconds);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
};

TEST_F(Nightly, SameForAnyThreadsShardsAndResumption) {
  const auto one = validate("one", {"-j", "1"});
  ASSERT_EQ(one.exit_code, 0) << one.standard_output << one.standard_error;
  EXPECT_THAT(one.standard_output, HasSubstr("6 of 6 passed"));
  const std::string expected = outcome("one");
  EXPECT_THAT(expected, HasSubstr("case/small/stiffness_ratio=0.3/density=2000-kg-m3"));
  for (const char* jobs : {"2", "4"}) {
    ASSERT_EQ(validate("more", {"-j", jobs}).exit_code, 0);
    EXPECT_EQ(outcome("more"), expected) << jobs;
  }
  for (const char* i : {"1", "2", "3", "4"})
    ASSERT_EQ(validate(std::string("shard-") + i, {"--shard", std::string(i) + "/4"}).exit_code, 0);
  const auto merged = ddem(
      {"merge", path("shard-3"), path("shard-1"), path("shard-4"), path("shard-2"), "-o", path("merged")});
  ASSERT_EQ(merged.exit_code, 0) << merged.standard_error;
  EXPECT_EQ(outcome("merged"), expected);
  std::filesystem::remove(in_folder("one") / "cases/case/small/stiffness_ratio=0.1/density=1000.unit");
  ASSERT_EQ(validate("one", {"--resume"}).exit_code, 0);
  EXPECT_EQ(outcome("one"), expected);
  ASSERT_EQ(ddem({"report", path("one")}).exit_code, 0);
  EXPECT_EQ(outcome("one"), expected);
}

TEST_F(Nightly, MissingShardsAreErrorsInTheReport) {
  ASSERT_EQ(validate("shard", {"--shard", "1/2"}).exit_code, 0);
  const auto merged = ddem({"merge", path("shard"), "-o", path("merged")});
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_THAT(merged.standard_error, HasSubstr("missing: case/small/stiffness_ratio=0.1/density=2000-kg-m3"));
  EXPECT_THAT(merged.standard_output,
              HasSubstr("3 of 9 passed, 6 ERROR"));  // three cases, and the three units that have no result
}

/// A plan first: what is run by it must be the same.
TEST_F(Nightly, PlannedFirst) {
  const auto plan = validate("night", {"--plan"});
  ASSERT_EQ(plan.exit_code, 0) << plan.standard_error;
  EXPECT_THAT(plan.standard_output, HasSubstr("6 units"));
  EXPECT_FALSE(std::filesystem::exists(in_folder("night") / "summary.json"));
  EXPECT_EQ(validate("night", {"--resume"}).exit_code, 0);
}

TEST_F(Nightly, KilledAndResumed) {
  ASSERT_EQ(validate("whole").exit_code, 0);
  for (unsigned trial = 0; trial < 8; ++trial) {
    const std::string folder = "killed-" + std::to_string(trial);
    kill_after(10000 + 12000 * trial, folder, false);
    kill_after(5000 + 9000 * trial, folder, true);
    const auto resumed = validate(folder, {"--resume"});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.standard_error;
    EXPECT_EQ(outcome(folder), outcome("whole"));
  }
}

/// What goes on is said, and goes on.
TEST_F(Nightly, InterruptedItSaysHowToGoOn) {
  write("scene.toml", with_table(small_scene(), "[time]\nsteps = 100000"));
  for (const char* signal : {"TERM", "HUP"}) {
    const std::string folder = std::string("an ") + signal;
    const auto run = shell("{ ddem validate campaign.toml -j 1 -o '" + folder + "' & until ls '" + folder + "'/cases/case/small/*/*.unit >/dev/null 2>&1; do sleep 0.01; done; kill -" + signal + " $!; wait $!; }");
    EXPECT_GT(run.exit_code, 128) << run.standard_error;
    const std::string before = "go on with: ";
    const std::size_t at = run.standard_error.find(before);
    ASSERT_NE(at, std::string::npos) << run.standard_error;
    const std::size_t begin = at + before.size();  // the shell's own words may follow
    const std::string command = run.standard_error.substr(begin, run.standard_error.find('\n', begin) - begin);
    EXPECT_EQ(command, "ddem validate campaign.toml -o '" + folder + "' --resume");
    EXPECT_EQ(shell(command).exit_code, 0) << command;
    EXPECT_THAT(outcome(folder), HasSubstr("case/small/stiffness_ratio=0.3/density=2000-kg-m3"));
  }
}

/// What --only leaves out of a baseline is not judged; what is asked for must be there.
TEST_F(Nightly, BaselinesOfAPart) {
  ASSERT_EQ(validate("whole").exit_code, 0);
  ASSERT_EQ(ddem({"baseline", "update", path("whole"), "-o", path("baseline.json")}).exit_code, 0);
  const std::string one = "case/small/stiffness_ratio=0.3/density=1000";
  const auto part = validate("part", {"--only", one, "--baseline", path("baseline.json")});
  EXPECT_EQ(part.exit_code, 0) << part.standard_output;
  EXPECT_THAT(part.standard_output, HasSubstr("10 of its 12 metrics are not of what was run"));
  EXPECT_THAT(part.standard_output, HasSubstr("1 of 1 passed"));
  const auto compared = ddem({"compare", path("part"), path("baseline.json")});
  EXPECT_EQ(compared.exit_code, 1);
  EXPECT_THAT(compared.standard_output, HasSubstr("12 metrics, 10 MISSING, 2 PASS"));
  EXPECT_EQ(ddem({"compare", path("part"), path("baseline.json"), "--partial"}).exit_code, 0);
  const auto json = ddem({"compare", path("part"), path("baseline.json"), "--json"});
  EXPECT_EQ(json.exit_code, 1);
  EXPECT_EQ(Json::parse(json.standard_output)["states"]["MISSING"], 10);

  Json summary = read_json(in_folder("part/summary.json"));
  summary["cases"] = Json::array();
  write("part/summary.json", to_text(summary));
  for (const char* partial : {"", "--partial"}) {
    std::vector<std::string> words = {"compare", path("part"), path("baseline.json")};
    if (*partial != '\0') words.push_back(partial);
    const auto nothing = ddem(words);
    EXPECT_EQ(nothing.exit_code, 1);
    EXPECT_THAT(nothing.standard_error, HasSubstr("not one metric"));
  }

  write("campaign.toml", replaced(kSmallCampaign, "0.3, 0.5]", "0.5]"));
  const auto fewer = validate("fewer", {"--baseline", path("baseline.json")});
  EXPECT_EQ(fewer.exit_code, 1);
  EXPECT_THAT(fewer.standard_output, HasSubstr("MISSING: " + one));
  EXPECT_EQ(validate("fewer", {"--baseline", path("baseline.json"), "--partial"}).exit_code, 0);
}

TEST_F(Nightly, AnotherCampaignInTheFolderIsNotResumed) {
  ASSERT_EQ(validate("night").exit_code, 0);
  const std::string before = outcome("night");
  write("campaign.toml", replaced(kSmallCampaign, "0.5]", "0.6]"));
  const auto resumed = validate("night", {"--resume"});
  EXPECT_EQ(resumed.exit_code, 2);
  EXPECT_THAT(resumed.standard_error, HasSubstr("stiffness_ratio=0.5"));
  EXPECT_EQ(outcome("night"), before);
}

TEST_F(Nightly, ADivergingCaseIsUnstable) {
  write("scene.toml", with_table(small_scene(),
                                 "[time]\nstep_fraction = 1.02\nallow_above_critical = true\nsteps = 20000"));
  const auto run = validate("night");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.standard_output, HasSubstr("6 UNSTABLE"));
  EXPECT_THAT(run.standard_output, HasSubstr("at step"));
}

TEST_F(Nightly, BaselinesAndNights) {
  ASSERT_EQ(validate("first", {"--history", path("nights")}).exit_code, 0);
  const auto none = validate("second", {"--baseline", path("mistyped.json")});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(in_folder("mistyped.json")));
  EXPECT_FALSE(std::filesystem::exists(in_folder("second")));
  EXPECT_EQ(ddem({"compare", path("first"), path("mistyped.json")}).exit_code, 2);
  EXPECT_EQ(ddem({"baseline", "update", path("mistyped"), "-o", path("baseline.json")}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(in_folder("baseline.json")));

  ASSERT_EQ(ddem({"baseline", "update", path("first"), "-o", path("baseline.json")}).exit_code, 0);
  ASSERT_EQ(ddem({"compare", path("first"), path("baseline.json")}).exit_code, 0);
  ASSERT_EQ(validate("second", {"--baseline", path("baseline.json"), "--history", path("nights")}).exit_code,
            0);
  EXPECT_EQ(ddem({"compare", path("second"), path("first")}).exit_code, 0);

  // A wave speed that is 2 % of the band better in the baseline than here.
  Json baseline = read_json(in_folder("baseline.json"));
  Json& entry = baseline["metrics"]["case/small/stiffness_ratio=0.3/density=1000 | wave_speed"];
  const Json summary = read_json(in_folder("first") / "summary.json");
  entry["noise"] = 0.0;
  for (const Json& c : summary["cases"]) {
    if (c["id"] == "case/small/stiffness_ratio=0.3/density=1000") entry["value"] = c["criteria"][0]["target"];
  }
  write("baseline.json", to_text(sealed(baseline)));
  const auto worse = validate("third", {"--baseline", path("baseline.json"), "--history", path("nights")});
  EXPECT_EQ(worse.exit_code, 1);
  EXPECT_THAT(worse.standard_output, HasSubstr("REGRESSED: case/small/stiffness_ratio=0.3/density=1000"));
  EXPECT_EQ(ddem({"compare", path("first"), path("baseline.json")}).exit_code, 1);

  const auto history = ddem({"history", path("nights"), "--all"});
  EXPECT_EQ(history.exit_code, 0);
  EXPECT_THAT(history.standard_output, HasSubstr("3 nights"));
  EXPECT_EQ(ddem({"history", path("nights"), "--regressions"}).exit_code, 1);
  EXPECT_EQ(ddem({"history", path("nights"), "--report", path("nights.html")}).exit_code, 0);
  EXPECT_THAT(read_file(path("nights.html")), HasSubstr("<ol class=\"nights\""));
  EXPECT_EQ(ddem({"history", path("nights"), "--report", path("nights.html")}).exit_code, 0);  // its own
  const auto night = std::filesystem::directory_iterator(path("nights"))->path();
  const std::string before = read_file(night);
  std::filesystem::create_symlink(night, path("link.html"));
  for (const std::string& page : {night.string(), path("nights/night-000009_x.json"), path("link.html"), path("first/report.html")})
    EXPECT_EQ(ddem({"history", path("nights"), "--report", page}).exit_code, 2) << page;
  EXPECT_EQ(ddem({"history", path("nights"), "--report", path("link.html"), "--force"}).exit_code, 2);
  EXPECT_EQ(read_file(night), before);
  write_file(path("mine.html"), "mine");
  EXPECT_EQ(ddem({"history", path("nights"), "--report", path("mine.html")}).exit_code, 2);
  EXPECT_EQ(read_file(path("mine.html")), "mine");
  EXPECT_EQ(ddem({"history", path("mistyped")}).exit_code, 2);
}

TEST_F(Nightly, TrendsAreInTheReportAndDrawnAgain) {
  for (const char* folder : {"first", "second", "third"}) ASSERT_EQ(validate(folder, {"--history", path("nights")}).exit_code, 0);
  const auto report = [this](const char* folder) { return read_file(in_folder(folder) / "report.html"); };
  EXPECT_THAT(report("first"), HasSubstr("first night of its history"));
  EXPECT_THAT(report("third"), HasSubstr("3 nights, "));
  // Of three nights: x = -2, -1, 0 for each metric.
  EXPECT_THAT(read_file(in_folder("third/figures/history-metrics.csv")), HasSubstr(",night,-2,"));
  ASSERT_EQ(ddem({"report", path("third"), "-o", path("again")}).exit_code, 0);
  EXPECT_EQ(report("again"), report("third"));

  // A history that is damaged does not cost the results; the night is still added.
  write("nights/2026-01-02T030405Z.json", "{");
  const auto run = validate("fourth", {"--history", path("nights")});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.standard_error, HasSubstr("2026-01-02T030405Z.json"));
  EXPECT_THAT(report("fourth"), HasSubstr("2026-01-02T030405Z.json"));
}

/// Without time steps: the same in one piece, resumed, and from shards; what steps in time is refused.
TEST_F(Nightly, StaticsAlone) {
  write("campaign.toml",
        "[strip]\nseeds = [1, 2]\nmodels = [\"dem\", \"implicit-full\"]\nstiffness_ratios = [0.3]\ndiscs = 300\nlength = "
        "\"7.3 mm\"\npulse_length = \"4 mm\"\n");
  const auto whole = validate("one", {"--static"});
  ASSERT_EQ(whole.exit_code, 0) << whole.standard_output << whole.standard_error;
  EXPECT_THAT(whole.standard_output, HasSubstr("4 of 4 passed"));  // lattice and random, of two models
  for (const char* file : {"report.html", "summary.json", "junit.xml", "results.h5", "figures/speed-errors.csv"})
    EXPECT_TRUE(std::filesystem::exists(in_folder("one") / file)) << file;
  const std::string expected = outcome("one");
  std::filesystem::remove(in_folder("one") / "cases/statics/hexagonal/dem/kt0.30.unit");
  ASSERT_EQ(validate("one", {"--static", "--resume"}).exit_code, 0);
  EXPECT_EQ(outcome("one"), expected);
  for (const char* i : {"1", "2"})
    ASSERT_EQ(validate(std::string("shard-") + i, {"--static", "--shard", std::string(i) + "/2"}).exit_code, 0);
  ASSERT_EQ(ddem({"merge", path("shard-1"), path("shard-2"), "-o", path("merged")}).exit_code, 0);
  EXPECT_EQ(outcome("merged"), expected);
  const std::string report = read_file(in_folder("one") / "report.html");
  ASSERT_EQ(ddem({"report", path("one")}).exit_code, 0);
  EXPECT_EQ(read_file(in_folder("one") / "report.html"), report);

  // Another plan is in the folder.
  EXPECT_EQ(validate("one", {"--resume"}).exit_code, 2);
  const auto wave = validate("two", {"--static", "--only", "long-wave/random/dem/kt0.30"});
  EXPECT_EQ(wave.exit_code, 2);
  EXPECT_THAT(wave.standard_error, HasSubstr("steps in time"));
  write("campaign.toml", kSmallCampaign);
  const auto cases = validate("two", {"--static"});
  EXPECT_EQ(cases.exit_code, 2);
  EXPECT_THAT(cases.standard_error, HasSubstr("no [strip]"));
  EXPECT_FALSE(std::filesystem::exists(in_folder("two")));
}

TEST_F(Nightly, CampaignFilesListEveryProblem) {
  write("campaign.toml", R"([[case]]
id = "small"
scene = "scene.toml"
[case.matrix]
"contact.stiffness_ratio" = [0.1, 7.0]
stiffness = [1]
[[case.criterion]]
metric = "statics.p_velocity"
upper = nan
[[case.criterion]]
metric = "wave_speed"
lower = 2.0
upper = 1.0
derivation = "no"
[[case]]
id = "a/b"
scene = "nowhere.toml"
colour = "red"
[[cases]]
id = "x"
)");
  const auto run = validate("night");
  EXPECT_EQ(run.exit_code, 2);
  for (const char* part :
       {":6: case.matrix.stiffness", ":8: case.criterion.metric", ":9: case.criterion.upper",
        ":10: case.criterion.lower", "nothing would pass", "case.id = a/b", "nowhere.toml",
        ":18: case.colour", "cases: unknown table", "case.criterion: missing"}) {
    EXPECT_THAT(run.standard_error, HasSubstr(part));
  }
  EXPECT_FALSE(std::filesystem::exists(in_folder("night")));
  write("campaign.toml", replaced(kSmallCampaign, "0.5]", "-7.0]"));
  EXPECT_THAT(validate("night").standard_error, HasSubstr("contact.stiffness_ratio = -7"));
}

}  // namespace
}  // namespace ddem::harness::test
