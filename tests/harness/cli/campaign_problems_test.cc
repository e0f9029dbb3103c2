// What is wrong with a campaign is said before anything runs, all of it at once, each with its line and a remedy.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tests/harness/cli/small_campaign.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

class CampaignProblems : public SmallCampaign {
 protected:
  /// `validate` of the text is refused, says every part, and leaves no folder.
  void expect_refused(const std::string& text, const std::vector<std::string>& parts) const {
    write("campaign.toml", text);
    const auto run = validate("night");
    EXPECT_EQ(run.exit_code, 2) << text;
    for (const std::string& part : parts) EXPECT_THAT(run.standard_error, HasSubstr(part)) << text;
    for (const unsigned char c : run.standard_error) EXPECT_TRUE(c == '\n' || (c >= ' ' && c != 127)) << static_cast<int>(c);
    EXPECT_FALSE(std::filesystem::exists(in_folder("night")));
  }
  /// A case of one criterion; `more`: lines before it.
  static std::string case_of(const std::string& scene, const std::string& metric, const std::string& more = "") {
    return fmt::format("[[case]]\nid = \"a\"\nscene = \"{}\"\n{}[[case.criterion]]\nmetric = \"{}\"\nlower = -1.0\nupper = 1.0\nderivation = \"d\"\n",
                       scene, more, metric);
  }
};

TEST_F(CampaignProblems, MisspeltMetrics) {
  for (const auto& [wrong, remedy] : std::vector<std::pair<std::string, std::string>>{
           {"wave_sped", "did you mean wave_speed?"},
           {"static.young_modules", "did you mean static.young_modulus?"},
           {"fem.wave_spedd", "did you mean fem.wave_speed?"},
           {"stability.critical_timestep", "did you mean stability.critical_time_step?"},
           {"young_modulus", "there are bonds"},
           {"static.wave_speed", "there are static.bar_velocity"},
           {"statics.p_velocity", "no prefix"},
           {"wall_seconds", "no two runs"},
           {"fem.solve_seconds", "no two runs"},
           {"", "there are"},
           {"static.", "there are static."}}) {
    expect_refused(case_of("scene.toml", wrong), {"campaign.toml:5: case.criterion.metric", remedy});
    expect_refused(replaced(kSmallCampaign, "static.p_velocity", wrong), {"campaign.toml:9: case.criterion.target", remedy});
  }
}

// A bound in GPa would be judged as so many Pa, and the report would name a unit that its numbers have not.
TEST_F(CampaignProblems, UnitsThatAMetricHasNot) {
  for (const auto& [metric, unit, says] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"wave_speed", "km/h", "wave_speed is in m/s"},
           {"fem.wave_speed_by_centroid", "mm/us", "is in m/s"},
           {"static.shear_velocity", "km/s", "is in m/s"},
           {"static.young_modulus", "GPa", "static.young_modulus is in Pa; give target and bounds in Pa"},
           {"moving_density", "g/cm3", "is in kg/m3"},
           {"stability.critical_time_step", "us", "is in s"},
           {"static.poisson_ratio", "%", "static.poisson_ratio has no unit; leave unit out"},
           {"discs", "1", "discs has no unit"}}) {
    expect_refused(replaced(case_of("scene.toml", metric), "lower", "unit = \"" + unit + "\"\nlower"), {"case.criterion.unit = " + unit, says});
  }
}

TEST_F(CampaignProblems, TheUnitOfAMetricMayBeSpeltAsInScenes) {
  for (const auto& [metric, unit, written] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"moving_density", "kg/m^3", "kg/m3"}, {"moving_density", "kg/m³", "kg/m3"}, {"static.young_modulus", "N/m2", "Pa"}}) {
    write("campaign.toml", replaced(case_of("scene.toml", metric), "lower = -1.0\nupper = 1.0", "unit = \"" + unit + "\"\nlower = 0.0"));
    EXPECT_EQ(validate("night", {"--force"}).exit_code, 0) << unit;
    EXPECT_THAT(outcome("night"), HasSubstr("\"unit\": \"" + written + "\"")) << unit;
  }
}

TEST_F(CampaignProblems, MetricsThatTheSceneCannotHave) {
  write("points.toml", replaced(with_table(small_scene(), "[time]\nend = \"1 us\""), "pairs = 3", "points = [[1e-3, 1e-4]]"));
  write("one.toml", replaced(small_scene(), "pairs = 3", "pairs = 1"));
  write("turning.toml", replaced(small_scene(), "[boundary]", "kinematics = \"nonlinear\"\n[boundary]"));
  write("waiting.toml", replaced(small_scene(), "pairs = 3", "discs = [3]"));
  write("steps.toml", with_table(small_scene(), "[time]\nsteps = 50"));
  for (const auto& [scene, metric, why] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"points.toml", "wave_speed", "between pairs of probes"},
           {"points.toml", "fem.wave_speed", "between pairs of probes"},
           {"scene.toml", "wave_speed_by_centroid", "no pulse of known width"},
           {"one.toml", "wave_speed_stddev", "no standard deviation"},
           {"turning.toml", "energy_drift", "nonlinear"},
           {"waiting.toml", "bonds", "no last peak"},
           {"steps.toml", "fem.dofs", "steps are the discs'"},
           {"scene.toml", "stability.softness", "plain DEM"},
           {"scene.toml", "stability.fixed_point_radius_limit", "lagged"}}) {
    expect_refused(case_of(scene, metric), {"campaign.toml:4: case.criterion.metric = " + metric, why});
    if (scene == "scene.toml") expect_refused(replaced(kSmallCampaign, "static.p_velocity", metric), {"case.criterion.target = " + metric, why});
  }
}

TEST_F(CampaignProblems, Matrices) {
  const auto with = [](const std::string& matrix) { return case_of("scene.toml", "wave_speed", "[case.matrix]\n" + matrix + "\n"); };
  expect_refused(with(""), {":4: case.matrix", "empty"});
  expect_refused(with("\"contact.stifness_ratio\" = [0.1]"), {":5: case.matrix.contact.stifness_ratio", "did you mean \"contact.stiffness_ratio\"?"});
  expect_refused(with("stiffness_ratio = [0.1]"), {":5: case.matrix.stiffness_ratio", "with its table"});
  expect_refused(with("\"contact.stiffness_ratio\" = []"), {":5: case.matrix.contact.stiffness_ratio = []", "not a list"});
  expect_refused(with("\"contact.stiffness_ratio\" = [0.1, 0.2, 0.1]"), {":5: case.matrix.contact.stiffness_ratio", "stands twice"});
  expect_refused(with("\"contact.stiffness_ratio\" = [0.1, -2.0, -3.0]"),
                 {":5: case.matrix.contact.stiffness_ratio = -2", "case.matrix.contact.stiffness_ratio = -3"});
  expect_refused(with("\"material.density\" = [\"2 kg\"]"), {":5: case.matrix.material.density = \"2 kg\""});
}

/// Of the longest, whose cases are files with long names, everything is written.
TEST_F(CampaignProblems, NamesThatAreTooLong) {
  const auto named = [](const std::string& id) { return replaced(kSmallCampaign, "id = \"small\"", "title = \"t\"\nid = \"" + id + "\""); };
  for (const std::size_t length : {101u, 255u, 256u, 5000u}) {
    write("campaign.toml", named(std::string(length, 'n')));
    const auto run = validate("night");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.standard_error, HasSubstr("campaign.toml:3: case.id = nnn"));
    EXPECT_THAT(run.standard_error, HasSubstr(fmt::format("{} bytes long, and files are named after it; at most 100 bytes are allowed", length)));
    EXPECT_EQ(std::ranges::count(run.standard_error, '\n'), 1) << run.standard_error;
    EXPECT_LT(run.standard_error.size(), 500u);
    EXPECT_FALSE(std::filesystem::exists(in_folder("night")));
  }
  const std::string longest(100, 'n');
  write("campaign.toml", named(longest));
  EXPECT_EQ(validate("night").exit_code, 0);
  EXPECT_THAT(cases_in("night"), testing::Contains(testing::HasSubstr(longest)));
  const std::string first = outcome("night");
  EXPECT_EQ(validate("night", {"--resume"}).exit_code, 0);
  EXPECT_EQ(outcome("night"), first);
}

TEST_F(CampaignProblems, TextsWithControlCharacters) {
  for (const char* bad : {"\\u0000", "\\u001b[2J", "\\u0007", "\\u007f", "\\u0085", "\\u009b2J", "\\r"}) {
    for (const char* key : {"title", "id"})
      expect_refused(replaced(kSmallCampaign, "scene = ", fmt::format("{} = \"a{}b\"\nscene = ", std::string(key) == "id" ? "title" : key, bad)), {"case.title"});
    expect_refused(replaced(kSmallCampaign, "\"small\"", fmt::format("\"a{}b\"", bad)), {"case.id"});
    expect_refused(replaced(kSmallCampaign, "\"m/s\"", fmt::format("\"{}\"", bad)), {"case.criterion.unit"});
    expect_refused(replaced(kSmallCampaign, "\"anything near\"", fmt::format("\"{}\"", bad)), {"case.criterion.derivation"});
    expect_refused(replaced(kSmallCampaign, "\"energy_drift\"", fmt::format("\"energy{}\"", bad)), {"case.criterion.metric"});
    expect_refused(replaced(kSmallCampaign, "scene.toml", fmt::format("scene{}.toml", bad)), {"case.scene"});
    expect_refused(fmt::format("[strip]\ntitle = \"a{}b\"\nseeds = [1, 2]\n", bad), {"strip.title", "control characters"});
  }
}

/// Of files that were changed by hand: whatever command shows what they hold.
TEST_F(CampaignProblems, TextsOfFilesDoNotSteerTheTerminal) {
  ASSERT_EQ(validate("night", {"--history", path("nights")}).exit_code, 0);
  ASSERT_EQ(validate("second", {"--history", path("nights")}).exit_code, 0);
  ASSERT_EQ(ddem({"baseline", "update", path("night"), "-o", path("baseline.json")}).exit_code, 0);
  const std::string escape = "\\u001b[2J\\u009b2J";
  std::vector<std::string> changed = {"second/summary.json", "baseline.json"};
  for (const auto& entry : std::filesystem::directory_iterator(in_folder("nights"))) {
    if (entry.path().extension() == ".json") changed.push_back("nights/" + entry.path().filename().string());
  }
  for (const std::string& file : changed) {
    std::string text = read(file);
    for (const char* word : {"wave_speed", "m/s", "case/small", "Campaign of", "anything near"}) {
      for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + escape.size() + 2))
        text.insert(at + 2, escape);
    }
    write(file, text);
  }
  write("fewer.toml", replaced(kSmallCampaign, "0.3, 0.5]", "0.3]"));
  const std::vector<std::vector<std::string>> commands = {{"compare", path("night"), path("baseline.json")},
                                                          {"compare", path("second"), path("night")},
                                                          {"baseline", "update", path("second"), "-o", path("other.json")},
                                                          {"history", path("nights"), "--all"},
                                                          {"validate", path("fewer.toml"), "-o", path("second")},
                                                          {"validate", path("fewer.toml"), "-o", path("third"), "--baseline", path("baseline.json")}};
  for (const auto& words : commands) {
    const auto run = ddem(words);
    EXPECT_NE(run.standard_output + run.standard_error, "");
    for (const char* bad : {"\033", "\xc2\x9b"})
      EXPECT_EQ((run.standard_output + run.standard_error).find(bad), std::string::npos) << testing::PrintToString(words);
  }
}

/// What is wrong with scenes, criteria and names is one list.
TEST_F(CampaignProblems, AllAtOnce) {
  write("bad.toml", replaced(small_scene(), "normal_stiffness", "normal_stifness"));
  expect_refused(case_of("bad.toml", "wave_sped") + case_of("nowhere.toml", "wave_speed") + case_of("scene.toml", "wave_speed") +
                     "[[case.criterion]]\nmetric = \"bonds\"\nlower = 2\nupper = 1\nderivation = \"d\"\n" +
                     "[[case.criterion]]\nmetric = \"bonds\"\ntarget = \"bonds\"\nlower = -0.1\nderivation = \"d\"\n",
                 {"did you mean wave_speed?", "did you mean normal_stiffness?", "nowhere.toml", "nothing would pass", "as good as itself"});
  expect_refused(case_of("scene.toml", "wave_speed") + case_of("scene.toml", "wave_speed"), {"used twice"});
  expect_refused("", {"an empty campaign; write [strip]"});
  expect_refused("# nothing\n", {"an empty campaign; write [strip]"});
  // Of a strip, what its scenes would be refused for.
  expect_refused("[strip]\ncolumns = 100000\nrows = 10000\n", {"[strip] as long-wave/hexagonal", "assembly.columns", "take fewer"});
}

/// The names that a campaign knows are those of the numbers that the commands print.
TEST_F(CampaignProblems, KnownMetricsAreWhatTheCommandsPrint) {
  const std::string driven = replaced(small_scene(), "[initial]\nwave = \"longitudinal\"\namplitude = \"1 um\"\n",
                                      "[drive]\nwave = \"shear\"\nduration = \"0.5 us\"\namplitude = \"10 nm\"\n");
  write("driven.toml", replaced(driven, "[boundary]", "[deformation]\nscheme = \"lagged\"\nyoung_modulus = 4e10\npoisson_ratio = 0.3\n[boundary]"));
  std::vector<std::pair<std::string, std::string>> groups = {{"run", ""}, {"moduli", "static."}, {"stability", "stability."}};
#ifdef DDEM_HAS_FEM
  groups.push_back({"fem", "fem."});
#endif
  for (const auto& [command, prefix] : groups) {
    std::set<std::string> printed, known;
    for (const char* scene : {"scene.toml", "driven.toml"}) {
      const auto run = ddem({command, path(scene), "--json"});
      ASSERT_EQ(run.exit_code, 0) << run.standard_error;
      const Json json = parse_json(run.standard_output, command);
      for (const auto& [key, value] : json.items()) {
        if (value.is_number() && !key.ends_with("seconds") && !key.starts_with("nanoseconds")) printed.insert(prefix + key);
      }
    }
    write("campaign.toml", case_of("scene.toml", prefix + "qqqqqqqqqqqqqqqq"));
    std::string names = validate("night").standard_error;
    names = names.substr(names.find("there are ") + 10);
    for (std::size_t begin = 0, end = 0; end < names.size(); begin = end + 2) {
      end = std::min(names.find(", ", begin), names.find('\n', begin));
      known.insert(names.substr(begin, end - begin));
      if (names[end] == '\n') break;
    }
    EXPECT_EQ(known, printed) << command;
  }
}

/// Values whose names would be the same are cases of their own, and each has its own result.
TEST_F(CampaignProblems, ValuesThatLookAlikeAreCasesOfTheirOwn) {
  std::vector<Disc> discs = small_lattice();
  write("a b.csv", disc_table(discs));
  discs.pop_back();
  write("a-b.csv", disc_table(discs));
  write("scene.toml", file_scene());
  write("discs.csv", disc_table(discs));
  write("campaign.toml", replaced(case_of("scene.toml", "discs", "[case.matrix]\n\"assembly.file\" = [\"a b.csv\", \"a-b.csv\"]\n"), "upper = 1.0\n", ""));
  const auto run = validate("night");
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_EQ(cases_in("night"), (std::vector<std::string>{"case/a/file=a-b.csv", "case/a/file=a-b.csv~2"}));
  const Json summary = read_json(in_folder("night/summary.json"));
  EXPECT_EQ(summary["cases"][0]["criteria"][0]["actual"], 240);
  EXPECT_EQ(summary["cases"][1]["criteria"][0]["actual"], 239);
}

TEST_F(CampaignProblems, CasesWhoseNamesEndAsFilesDo) {
  const std::string one = replaced(case_of("scene.toml", "discs"), "upper = 1.0\n", "");
  write("campaign.toml", one + replaced(replaced(case_of("scene.toml", "bonds", "[case.matrix]\n\"contact.stiffness_ratio\" = [0, 0.1]\n"), "upper = 1.0\n", ""),
                                        "\"a\"", "\"a.unit\""));
  const auto run = validate("night");
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_EQ(cases_in("night").size(), 3u);
}

#ifdef DDEM_HAS_FEM
/// Of the continuum alone, discs need not be there.
TEST_F(CampaignProblems, ACaseOfTheContinuumNeedsWhatFemNeeds) {
  write("scene.toml",
        "[assembly]\nlength = \"16.5 mm\"\nwidth = \"2 mm\"\n[boundary]\ntop_bottom = \"periodic\"\nright = \"fixed\"\n"
        "[drive]\nwave = \"shear\"\nduration = \"3 us\"\namplitude = \"1 um\"\n"
        "[continuum]\nyoung_modulus = \"10 GPa\"\npoisson_ratio = 0.25\ndensity = 1700.0\ndegree = 4\nelements = [66, 8]\n"
        "[time]\nend = \"12 us\"\n[probes]\npairs = 5\n");
  const std::string continuum =
      "[[case]]\nid = \"cont\"\nscene = \"scene.toml\"\n[[case.criterion]]\nmetric = \"fem.wave_speed\"\ntarget = \"fem.analytical_speed\"\n"
      "lower = -0.02\nupper = 0.02\nderivation = \"d\"\n";
  expect_refused(replaced(continuum, "\"fem.analytical_speed\"", "\"static.shear_velocity\""), {"normal_stiffness", "missing"});
  write("campaign.toml", continuum);
  const auto run = validate("night");
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  const Json c = read_json(in_folder("night/summary.json"))["cases"][0]["criteria"][0];
  EXPECT_NEAR(c["actual"].get<double>(), 1533.93, 0.1);  // sqrt(10e9 / 2.5 / 1700)
  EXPECT_NEAR(c["target"].get<double>(), 1533.93, 0.01);
}
#endif

}  // namespace
}  // namespace ddem::harness::test
