// ddem calibrate from outside: what it prints and writes, verdicts, refusals.

#include <cmath>

#include "harness/io/json.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Calibrate : public Cli {
 protected:
  /// The infinite lattice, with lines before [material].
  void write_lattice(const std::string& more = "") const {
    write("lattice.toml", "[assembly]\npacking = \"hexagonal\"   # mine\nperiodic = \"xy\"\n" + more);
  }
  SubprocessResult calibrate(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "calibrate");
    return ddem(arguments);
  }
};

const char* const kDeformation =
    "[deformation]\nscheme = \"implicit\"\ncorrection = \"full\"\nyoung_modulus = 1e10\npoisson_ratio = "
    "0.1\n";

/// Closed form: lambda = 0.2, k_n = E/(0.375 * 2 sqrt(3)); and `ddem moduli` says the same of the scene that
/// is written.
TEST_F(Calibrate, WritesASceneThatHasTheTarget) {
  write_lattice();
  const auto run = calibrate({"--young", "30 GPa", "--poisson", "0.25", "--density", "2400", "--assembly",
                              path("lattice.toml"), "-o", path("out.toml"), "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_EQ(run.standard_error, "");
  const Json json = Json::parse(run.standard_output);
  EXPECT_TRUE(json["feasible"].get<bool>());
  EXPECT_NEAR(json["parameters"]["stiffness_ratio"].get<double>(), 0.2, 1e-9);
  EXPECT_NEAR(json["parameters"]["normal_stiffness"].get<double>() / 2.30940108e10, 1.0, 1e-8);
  EXPECT_NEAR(json["young_modulus"].get<double>() / 30e9, 1.0, 1e-9);
  EXPECT_NEAR(json["poisson_ratio"].get<double>(), 0.25, 1e-9);
  for (const char* key : {"target", "residuals", "seeds", "over_seeds", "reachable", "uncertainty", "proof"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_THAT(read("out.toml"), HasSubstr("# mine"));
  const auto moduli = ddem({"moduli", path("out.toml"), "--json"});
  ASSERT_EQ(moduli.exit_code, 0) << moduli.standard_error;
  const Json given = Json::parse(moduli.standard_output);
  EXPECT_NEAR(given["young_modulus"].get<double>() / 30e9, 1.0, 1e-9);
  EXPECT_NEAR(given["poisson_ratio"].get<double>(), 0.25, 1e-9);
  EXPECT_NEAR(given["bulk_density"].get<double>() / 2400.0, 1.0, 1e-12);
}

TEST_F(Calibrate, DeformableDiscsFromVelocitiesInPlaneStrain) {
  write_lattice(kDeformation);
  // E = 30 GPa, nu = 0.28 of a solid of 2400 kg/m3: its shear velocity and P velocity.
  const double shear = std::sqrt(30e9 / (2.0 * 1.28) / 2400.0),
               p = std::sqrt(30e9 * 0.72 / (1.28 * 0.44) / 2400.0);
  const auto run =
      calibrate({"--shear-velocity", std::to_string(shear), "--p-velocity",
                 std::to_string(1e-3 * p) + " km/s", "--density", "2.4 g/cm3", "--plane", "strain",
                 "--assembly", path("lattice.toml"), "--stiffness-ratio", "0.2", "-o", path("out.toml")});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_THAT(run.standard_output,
              AllOf(HasSubstr("plane strain: E = "), HasSubstr("k_n/E_p = "), HasSubstr("within reach")));
  const Json given = Json::parse(ddem({"moduli", path("out.toml"), "--json"}).standard_output);
  // std::to_string keeps six digits behind the point of km/s: 3e-7.
  EXPECT_NEAR(given["young_modulus"].get<double>() / (30e9 / (1.0 - 0.28 * 0.28)), 1.0, 1e-5);
  EXPECT_NEAR(given["poisson_ratio"].get<double>(), 0.28 / 0.72, 1e-5);
  EXPECT_NEAR(given["p_velocity"].get<double>() / p, 1.0, 1e-5);
}

TEST_F(Calibrate, SaysWhatIsOutOfReachAndWritesNothing) {
  write_lattice();
  const auto before = contents();
  const auto run = calibrate({"--young", "3e10", "--poisson", "0.40", "--density", "2400", "--assembly",
                              path("lattice.toml"), "-o", path("out.toml"), "--json"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.standard_error, HasSubstr("was not written"));
  const Json json = Json::parse(run.standard_output);
  EXPECT_FALSE(json["feasible"].get<bool>());
  EXPECT_NEAR(json["nearest"]["poisson_ratio"].get<double>(), 1.0 / 3.0, 1e-9);
  EXPECT_FALSE(json["what_helps"].empty());
  expect_contents(before);
}

TEST_F(Calibrate, WritesDesignCurves) {
  write_lattice();
  std::filesystem::create_directory(in_folder("curves"));
  const auto run = calibrate({"--young", "3e10", "--poisson", "0.2", "--density", "2400", "--assembly",
                              path("lattice.toml"), "--curves", path("curves")});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_THAT(read("curves/design-curves.svg"), HasSubstr("</svg>"));
  EXPECT_THAT(read("curves/design-curves.csv"),
              AllOf(HasSubstr("kinematic_poisson_ratio"), HasSubstr("\nDEM,"), HasSubstr("\nDDEM F,")));
}

TEST_F(Calibrate, RefusesBadTargetsAndOptions) {
  write_lattice();
  write("soft.toml", read("lattice.toml") + kDeformation);
  const std::string lattice = path("lattice.toml");
  struct Refusal {
    std::vector<std::string> arguments;
    const char* says;
  };
  for (const Refusal& r :
       {Refusal{{"--young", "-30e9", "--poisson", "0.25", "--density", "2400"}, "must be positive"},
        Refusal{{"--young", "30e9", "--poisson", "1.0", "--density", "2400"}, "between -1 and 1"},
        Refusal{{"--young", "30e9", "--poisson", "-1.5", "--density", "2400"}, "between -1 and 1"},
        Refusal{{"--young", "nan", "--poisson", "0.25", "--density", "2400"}, "finite"},
        Refusal{{"--young", "30e9", "--poisson", "nan", "--density", "2400"}, "between -1 and 1"},
        Refusal{{"--young", "30 kg", "--poisson", "0.25", "--density", "2400"}, "not a known unit of stress"},
        Refusal{{"--young", "30e9", "--poisson", "0.25", "--density", "heavy"}, "density"},
        Refusal{{"--young", "30e9", "--poisson", "0.25"}, "--density: missing"},
        Refusal{{"--young", "30e9", "--density", "2400"}, "two targets"},
        Refusal{{"--bar-velocity", "3000", "--shear-velocity", "1000", "--density", "2400"}, "contradict"},
        Refusal{{"--young", "30e9", "--poisson", "0.25", "--density", "2400", "--plane", "both"}, "--plane"},
        Refusal{{"--young", "30e9", "--poisson", "0.25", "--density", "2400", "--softness", "0.3"},
                "[deformation]"},
        Refusal{{"--young", "30e9", "--poisson", "0.25", "--density", "2400", "--stiffness-ratio", "-1"},
                "from 0 to"},
        Refusal{{"--young", "30e9", "--poisson", "0.25", "--density", "2400", "--seeds", "0"}, "--seeds"}}) {
    std::vector<std::string> arguments = r.arguments;
    arguments.insert(arguments.end(), {"--assembly", lattice});
    const auto run = calibrate(arguments);
    EXPECT_EQ(run.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_EQ(run.standard_output, "") << testing::PrintToString(arguments);
    EXPECT_THAT(run.standard_error, HasSubstr(r.says)) << testing::PrintToString(arguments);
  }
  const std::vector<std::string> good = {"--young", "30e9", "--poisson", "0.25", "--density", "2400"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), good.begin(), good.end());
    return calibrate(more);
  };
  EXPECT_EQ(with({"--assembly", path("none.toml")}).exit_code, 2);
  EXPECT_EQ(with({"--assembly", lattice, "-o", lattice}).exit_code, 2);
  EXPECT_EQ(with({"--assembly", lattice, "-o", path("none/out.toml")}).exit_code, 2);
  EXPECT_EQ(with({"--assembly", lattice, "--curves", path("none")}).exit_code, 2);
  EXPECT_EQ(with({"--assembly", path("soft.toml"), "--particle-poisson", "1.2"}).exit_code, 2);
  EXPECT_EQ(with({"--assembly", path("soft.toml"), "--softness", "nan"}).exit_code, 2);
}

}  // namespace
}  // namespace ddem::harness::test
