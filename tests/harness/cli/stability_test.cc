// ddem stability from outside: keys, known values, refusals.

#include "harness/io/json.h"
#include "harness/references/lattice_stability.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

class Stability : public Cli {
 protected:
  Json json_of(const std::string& scene, const std::vector<std::string>& more = {}) const {
    write("scene.toml", scene);
    std::vector<std::string> arguments{"stability", path("scene.toml"), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto run = ddem(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    return Json::parse(run.standard_output, nullptr, false);
  }
};

/// The infinite lattice, k_n / E_p = `softness`.
std::string lattice_scene(double softness, const std::string& stiffness_ratio, const std::string& scheme,
                          const std::string& correction) {
  std::string scene = replaced(small_scene(), "rows = 8", "rows = 8\nperiodic = \"xy\"");
  scene = replaced(scene, "stiffness_ratio = 0.25", "stiffness_ratio = " + stiffness_ratio);
  scene.erase(scene.find("[initial]"));
  return scene + "[deformation]\nscheme = \"" + scheme + "\"\ncorrection = \"" + correction +
         "\"\nyoung_modulus = " + std::to_string(1e10 / softness) + "\npoisson_ratio = 0.3\n";
}

TEST_F(Stability, OfThePublishedSchemeOnTheLattice) {
  const Json json = json_of(lattice_scene(0.25, "0.0", "lagged", "normal"));
  EXPECT_EQ(json["status"], "ok");
  // Closed forms: 2/sqrt(6) sqrt(m/k_n), (1 + ...) of theory section 3; Lanczos is right to 1e-6.
  const double mass = 2000.0 * M_PI * 1e-8;
  EXPECT_NEAR(json["dem_critical_time_step"].get<double>() / references::hexagonal_critical_step(1e10, mass), 1.0, 1e-5);
  EXPECT_NEAR(json["fixed_point_radius"].get<double>(), 0.334225, 1e-6);
  const double limit = references::hexagonal_fixed_point_limit(references::ContactModel::ddem_normal, 0.3, 0.0);
  EXPECT_NEAR(json["largest_stable_softness"].get<double>() / limit, 1.0, 1e-5);
  EXPECT_TRUE(json["stable_at_step_fraction"].get<bool>());
  EXPECT_LE(json["critical_time_step"].get<double>(), json["dem_critical_time_step"].get<double>() * (1.0 + 1e-6));
  EXPECT_EQ(json["critical_time_step_bound"], "flip");
  EXPECT_NEAR(json["step_fraction"].get<double>(), 0.2, 1e-12);
  ASSERT_FALSE(json["waves"].empty());
  for (const Json& wave : json["waves"]) {
    EXPECT_EQ(wave["method"], "bloch");
    EXPECT_LT(wave["growth_per_step"].get<double>(), 0.0);
  }
}

TEST_F(Stability, NumbersThatDoNotExistAreStatuses) {
  const Json dem = json_of(small_scene());
  EXPECT_TRUE(dem["fixed_point_radius"].contains("status"));
  EXPECT_TRUE(dem["largest_stable_softness"].contains("status"));
  EXPECT_EQ(dem["critical_time_step"], dem["dem_critical_time_step"]);
  const Json soft = json_of(lattice_scene(2.0, "0.0", "lagged", "normal"));
  EXPECT_TRUE(soft["critical_time_step"].contains("status"));
  EXPECT_EQ(soft["critical_time_step_bound"], "fixed_point");
  EXPECT_FALSE(soft["stable_at_step_fraction"].get<bool>());
}

TEST_F(Stability, ImplicitStrainsAreStableAtAnySoftness) {
  const Json json = json_of(lattice_scene(20.0, "0.5", "implicit", "full"));
  EXPECT_TRUE(json["stable_at_step_fraction"].get<bool>());
  EXPECT_GT(json["fixed_point_radius"].get<double>(), 1.0);
  // The fastest vibration may be one that strains nothing; Lanczos is right to 1e-6.
  EXPECT_GE(json["critical_time_step"].get<double>(), json["dem_critical_time_step"].get<double>() * (1.0 - 1e-6));
}

TEST_F(Stability, OfTheLatticeOnBothSidesOfOneThird) {
  EXPECT_TRUE(json_of(lattice_scene(0.25, "0.32", "lagged", "normal"))["stable_at_step_fraction"].get<bool>());
  const Json above = json_of(lattice_scene(0.25, "0.35", "lagged", "normal"));
  EXPECT_FALSE(above["stable_at_step_fraction"].get<bool>());
  EXPECT_THAT(above["instabilities"].dump(), HasSubstr("infinite lattice"));
}

TEST_F(Stability, OfTwoDiscs) {
  write("discs.csv", "x,y,radius\n1e-4,1e-4,1e-4\n3e-4,1e-4,1e-4\n");
  std::string scene = replaced(file_scene(), "stiffness_ratio = 0.25", "stiffness_ratio = 0.0");
  scene.erase(scene.find("[boundary]"));
  const Json json = json_of(scene + "[boundary]\nright = \"free\"\n");
  // omega^2 = 2 k_n/m.
  EXPECT_NEAR(json["critical_time_step"].get<double>() / std::sqrt(2.0 * 2000.0 * M_PI * 1e-8 / 1e10), 1.0, 1e-12);
  EXPECT_TRUE(json["waves"].empty());
  EXPECT_THAT(json["waves_status"].get<std::string>(), HasSubstr("too short"));
}

TEST_F(Stability, OfGivenWavelengths) {
  const Json json = json_of(small_scene(), {"--wavelength", "4 mm", "--wavelength", "0.002"});
  ASSERT_EQ(json["waves"].size(), 6u);  // shear, P and rotation of each
  EXPECT_EQ(json["waves"][0]["wavelength"], 4e-3);
  EXPECT_EQ(json["waves"][3]["wavelength"], 2e-3);
  EXPECT_EQ(json["waves"][0]["wave"], "shear");
}

TEST_F(Stability, RefusesWavesThatDiscsCannotCarry) {
  write("scene.toml", small_scene());
  for (const char* wavelength : {"0.3 mm", "0", "-1", "nan", "4 kg"}) {
    const auto run = ddem({"stability", path("scene.toml"), "--wavelength", wavelength});
    EXPECT_EQ(run.exit_code, 2) << wavelength;
    EXPECT_EQ(run.standard_output, "") << wavelength;
    EXPECT_THAT(run.standard_error, HasSubstr("wavelength")) << wavelength;
  }
}

TEST_F(Stability, SaysInWordsWhatItFound) {
  write("scene.toml", lattice_scene(2.0, "0.0", "lagged", "normal"));
  const auto run = ddem({"stability", path("scene.toml")});
  EXPECT_EQ(run.exit_code, 0) << run.standard_error;
  EXPECT_THAT(run.standard_output, HasSubstr("UNSTABLE"));
  EXPECT_THAT(run.standard_output, HasSubstr("scheme = \"implicit\""));
}

}  // namespace
}  // namespace ddem::harness::test
