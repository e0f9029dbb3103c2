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
  for (const char* key : {"length = ", "width = "}) {  // they follow from the discs
    if (const auto at = scene.find(key); at != std::string::npos) scene.erase(at, scene.find('\n', at) + 1 - at);
  }
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

/// The published correction with shear stiffness on random discs, k_n/E_p = 0.125, a tenth of what blows up at once.
std::string published_scene(int discs, const std::string& length, int seed, const std::string& scheme) {
  return "[assembly]\npacking = \"random\"\nlength = \"" + length + "\"\nwidth = \"1.2 mm\"\ndiscs = " + std::to_string(discs) + "\nseed = " + std::to_string(seed) +
         "\n[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.5\nnew_contacts = \"off\"\n[deformation]\nscheme = \"lagged\"\n" + scheme +
         "young_modulus = 8e10\npoisson_ratio = 0.3\n[boundary]\ntop_bottom = \"periodic\"\nright = \"fixed\"\n";
}

/// Growth so slow that a run of 1e5 steps shows none; the figures are those of the amplification matrix written down elsewhere
/// (q, v, eps). Runs diverge at step 2.3e6, 1.0e6 and 0.8e6.
TEST_F(Stability, OfGrowthThatNoShortRunShows) {
  const std::string scheme = "evaluations = 3\nrelaxation = 0.5\n";
  const std::string by_modulus = replaced(published_scene(48, "4 mm", 7, scheme), "normal_stiffness = 1e10", "contact_modulus = 1e14");
  for (const auto& [scene, growth] : {std::pair(published_scene(48, "4 mm", 7, scheme), 6.20e-6), std::pair(published_scene(48, "4 mm", 8, scheme), 1.52e-5), std::pair(by_modulus, 1.26e-5)}) {
    const Json json = json_of(scene);
    EXPECT_EQ(json["stability"], "unstable");
    EXPECT_EQ(json["stable_at_step_fraction"], false);
    EXPECT_NEAR(json["growth_per_step"].get<double>(), growth, 0.005 * growth);
    EXPECT_TRUE(json["steps_needed"].contains("status"));
  }
  const auto run = ddem({"stability", path("scene.toml")});
  EXPECT_THAT(run.standard_output, HasSubstr("UNSTABLE:\n  a motion grows by 1.26e-05 a step"));
}

TEST_F(Stability, OfASmallAssemblyThatTheLagDamps) {
  const Json json = json_of(replaced(published_scene(24, "2 mm", 1, ""), "stiffness_ratio = 0.5", "stiffness_ratio = 0.05"));
  EXPECT_EQ(json["stability"], "stable");
  EXPECT_EQ(json["stable_at_step_fraction"], true);
  EXPECT_LT(json["growth_per_step"].get<double>(), 0.0);
  EXPECT_THAT(ddem({"stability", path("scene.toml")}).standard_output, HasSubstr("the scene is stable."));
}

/// A run that could not have seen growth decides nothing.
TEST_F(Stability, OfALargeAssemblyWithoutAnEnergyIsUndecided) {
  const std::string scene = published_scene(240, "20 mm", 7, "evaluations = 3\nrelaxation = 0.5\n");
  const Json json = json_of(scene);
  EXPECT_EQ(json["stability"], "undecided");
  EXPECT_TRUE(json["stable_at_step_fraction"].is_null());
  EXPECT_TRUE(json["growth_per_step"].contains("status"));
  // Growth of 1e-6 a step in noise of 240 discs; ten times as long for a run of 1e7 steps.
  const double needed = 0.5 * std::log(480.0) / 0.75e-6;
  EXPECT_NEAR(json["steps_needed"].get<double>() / needed, 1.0, 1e-5);
  EXPECT_GT(json["steps_needed"].get<double>(), json["noise_run"]["steps"].get<double>());
  EXPECT_NEAR(json["noise_run"]["detectable_per_step"].get<double>() * json["noise_run"]["steps"].get<double>(), 1e-6 * needed, 1e-5);
  write("scene.toml", scene + "[time]\nsteps = 10000000\n");
  const auto run = ddem({"stability", path("scene.toml")});
  EXPECT_THAT(run.standard_output, HasSubstr("the scene is UNDECIDED:\n"));
  EXPECT_THAT(run.standard_output, HasSubstr("Growth of 1e-07 a step would show in 4.1e+07 steps."));
}

TEST_F(Stability, OfEvenEvaluationsIsSharpWhereTheAssemblyIsSmall) {
  const std::string full = "correction = \"full\"\nevaluations = 2\nrelaxation = 0.5\n";
  const Json small = json_of(published_scene(24, "2 mm", 1, full));
  EXPECT_EQ(small["stability"], "stable");
  EXPECT_EQ(small["largest_stable_softness_at_step"], small["largest_stable_softness_at_step_at_most"]);
  // Overshooting strains, but no motion that grows: with softer discs 3 % below the limit.
  const double limit = small["largest_stable_softness_at_step"].get<double>();
  for (const auto& [share, verdict] : {std::pair(0.97, "stable"), std::pair(1.03, "unstable")}) {
    const Json soft = json_of(replaced(published_scene(24, "2 mm", 1, full), "young_modulus = 8e10", "young_modulus = " + std::to_string(1e10 / (share * limit))));
    EXPECT_EQ(soft["critical_time_step_bound"], "feeding");
    EXPECT_EQ(soft["stability"], verdict) << share;
  }
}

}  // namespace
}  // namespace ddem::harness::test
