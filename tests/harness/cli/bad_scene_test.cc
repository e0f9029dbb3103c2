// Scenes that are wrong: refused before anything is written, with what, where and what would be right.

#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Mistake {
  const char* name;
  std::string scene;
  std::vector<std::string> parts;  // of the message
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

class BadScene : public Cli, public testing::WithParamInterface<Mistake> {};

TEST_P(BadScene, IsRefused) {
  write("scene.toml", GetParam().scene);
  expect_refused(GetParam().parts);
}

std::vector<Mistake> mistakes() {
  const std::string scene = small_scene();
  return {
      {"UnknownKey",
       replaced(scene, "rows = 8", "rwos = 8"),
       {"scene.toml:4: assembly.rwos = 8: unknown key; did you mean rows?", "assembly.rows: missing"}},
      {"UnknownTable", scene + "[probs]\nn = 1\n", {"scene.toml:18: ", "probs", "did you mean"}},
      {"WrongUnit",
       replaced(scene, "0.1 mm", "0.1 kg"),
       {"scene.toml:5: assembly.radius = \"0.1 kg\": \"kg\" is not a known unit of length",
        "such as \"16.5 mm\""}},
      {"WrongType",
       replaced(scene, "2000.0", "true"),
       {"scene.toml:7: material.density = true: ", "such as"}},
      {"NegativeRadius",
       replaced(scene, "0.1 mm", "-0.1 mm"),
       {"scene.toml:5: assembly.radius = \"-0.1 mm\": must be greater than 0"}},
      {"NotANumber", replaced(scene, "2000.0", "nan"), {"scene.toml:7: material.density = nan: "}},
      {"MissingFile",
       replaced(file_scene(), "discs.csv", "none.csv"),
       {"scene.toml:3: assembly.file = \"none.csv\": there is no file",
        "relative to the folder of the scene file"}},
      {"PointOutside",
       replaced(scene, "pairs = 3", "points = [[1e-3, 1e-3], [0.1, 1e-3]]"),
       {"scene.toml", "probes.points", "0.1", "outside", "0.0061"}},
      {"DiscThatIsNotThere",
       replaced(scene, "pairs = 3", "discs = [12, 240]"),
       {"scene.toml", "probes.discs", "240", "discs are 0 to 239"}},
      {"NoSteps", with_table(scene, "[time]\nsteps = 0"), {"scene.toml:17: time.steps = 0: must be from 1"}},
      {"NoTime",
       with_table(scene, "[time]\nend = 0.0"),
       {"scene.toml:17: time.end = 0.0: must be greater than 0"}},
      {"FractionAboveCritical",
       with_table(scene, "[time]\nstep_fraction = 1.1"),
       {"scene.toml:17: time.step_fraction = 1.1: ", "critical", "allow_above_critical = true"}},
      {"StepAboveCritical",
       with_table(scene, "[time]\nstep = 1e-6"),
       {"scene.toml:17: time.step = 1e-6", "above the critical one, 6.2", "allow_above_critical = true"}},
      {"AmplitudeOverflows", replaced(scene, "\"1 um\"", "1e999"), {"scene.toml:15:", "1e999"}},
      {"BracketsWithoutEnd", "x = " + std::string(100000, '['), {"scene.toml:1:", "nested"}},
      {"BracesWithoutEnd", "x = " + std::string(100000, '{'), {"scene.toml:1:"}},
      {"DotsWithoutEnd", "x" + std::string(100000, '.') + " = 1", {"scene.toml:1:"}},
      {"BinaryRubbish", rubbish(30000), {"scene.toml: not a text file"}},
      {"Empty", "", {"scene.toml: assembly.packing: missing"}},
      {"LaggedIsNotExactInTime",
       with_table(scene, "[time]\nintegrator = \"exact\"\n[deformation]\nyoung_modulus = 1e10\npoisson_ratio = 0.3"),
       {"scene.toml:17: time.integrator = \"exact\": of lagged strains", "use integrator = \"verlet\", or scheme = \"implicit\""}},
  };
}

INSTANTIATE_TEST_SUITE_P(Cli, BadScene, testing::ValuesIn(mistakes()),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

TEST_F(Cli, ListsAllMistakesAtOnce) {
  write("scene.toml",
        replaced(replaced(small_scene(), "0.1 mm", "0.1 kg"), "2000.0", "-1.0") + "colour = 1\n");
  expect_refused(
      {"scene.toml:5: assembly.radius", "scene.toml:7: material.density", "scene.toml:18: probes.colour"});
}

TEST_F(Cli, RefusesASceneThatIsMissing) {
  expect_refused({"scene.toml: cannot be read: No such file"});
}

TEST_F(Cli, RefusesASceneThatIsAFolder) {
  std::filesystem::create_directory(in_folder("scene.toml"));
  expect_refused({"scene.toml", "folder"});
}

TEST_F(Cli, EveryCommandThatReadsAScene) {
  write("scene.toml", replaced(small_scene(), "rows = 8", "rows = 8\ncolour = 1"));
  const auto before = contents();
  const std::string scene = path("scene.toml");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"run", scene},
                                                    {"moduli", scene, "--json"},
                                                    {"fem", scene, "-o", path("new.h5")},
                                                    {"pack", scene, "-o", path("new.csv")}}) {
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments[0];
    EXPECT_EQ(run.standard_output.empty(), arguments.back() != "--json") << arguments[0];
    EXPECT_THAT(run.standard_error, HasSubstr("scene.toml:5: assembly.colour = 1: unknown key"))
        << arguments[0];
    expect_contents(before);
  }
}

TEST_F(Cli, CampaignsTheSame) {
  for (const auto& [text, part] :
       {std::pair<std::string, std::string>{"[strip]\nrwos = 8\n",
                                            "campaign.toml:2: strip.rwos = 8: "
                                            "unknown key; did you mean rows?"},
        {"[strip]\nlength = \"3 kg\"\n", "campaign.toml:2: strip.length = \"3 kg\": "},
        {"x = " + std::string(100000, '['), "campaign.toml:1:"},
        {rubbish(3000), "campaign.toml: not a text file"}}) {
    write("campaign.toml", text);
    const auto before = contents();
    const auto run = ddem({"validate", path("campaign.toml"), "-o", path("report")});
    EXPECT_EQ(run.exit_code, 2) << run.status() << run.standard_error;
    EXPECT_THAT(run.standard_error, HasSubstr(part));
    expect_contents(before);
  }
}

// The largest stable step is 1: at 1.1 the highest mode grows from its first step on.
TEST_F(Cli, AnUnstableRunStopsWhereItDiverges) {
  write("scene.toml", with_table(small_scene(),
                                 "[time]\nstep_fraction = 1.1\nallow_above_critical = true\nend = \"1 ms\""));
  expect_refused({"scene.toml: the run diverged at step ", "disc "}, 3);
}

// K B of the lagged scheme grows with k_n/E_p: 10 is far beyond its limit (theory: about 0.6).
TEST_F(Cli, LaggedDiscsThatAreTooSoftWarnAndDiverge) {
  write("scene.toml",
        with_table(small_scene(),
                   "[deformation]\nscheme = \"lagged\"\ncorrection = \"full\"\nyoung_modulus = 1e9\n"
                   "poisson_ratio = 0.3"));
  expect_refused({"warning: the lagged scheme is unstable here", "diverged at step ", "disc "}, 3);
}

TEST_F(Cli, AnUnstableRunAsJsonHasAStatus) {
  write("scene.toml", with_table(small_scene(),
                                 "[time]\nstep_fraction = 1.1\nallow_above_critical = true\nend = \"1 ms\""));
  const auto run = ddem({"run", path("scene.toml"), "--json"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.standard_output,
              AllOf(HasSubstr("\"status\": \"diverged\""), HasSubstr("\"diverged_step\": "),
                    HasSubstr("\"diverged_disc\": "), HasSubstr("\"wave_speed\": null,\n  \"wave_speed_status\": \"the run broke down\"")));
}

}  // namespace
}  // namespace ddem::harness::test
