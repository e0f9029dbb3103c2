// What is told of growth before a run: against the eigenvalues of its very step, and against runs, of which some are too short to
// show it.

#include "harness/run/instability_warnings.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dem/spectra/spectra.h"
#include "dem/spectra/step_map.h"
#include "harness/model/assemble.h"
#include "harness/model/held_edges.h"
#include "harness/run/dem_run.h"
#include "harness/scene/read_scene.h"

namespace ddem::harness::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// 48 discs of a lattice: few enough for the eigenvalues of a step.
Scene scene_of(const std::string& step, const std::string& deformation = "", double ratio = 0.25, int steps = 200) {
  const std::string text = fmt::format(
      "[assembly]\npacking = \"hexagonal\"\ncolumns = 8\nrows = 6\nradius = 1e-4\n[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = {}\n"
      "[boundary]\ntop_bottom = \"periodic\"\n{}\n[initial]\nwave = \"shear\"\nshape = \"gaussian\"\nwidth = 6e-4\namplitude = 1e-8\n"
      "[time]\n{}\nallow_above_critical = true\nsteps = {}\n[probes]\ndiscs = [3]\n",
      ratio, deformation.empty() ? "" : "[deformation]\nyoung_modulus = 4e10\npoisson_ratio = 0.3\n" + deformation, step, steps);
  const SceneResult scene = parse_scene(text, "scene.toml", ".", {Purpose::simulation});
  EXPECT_TRUE(scene) << to_string(scene.violations);
  return *scene;
}

/// The largest |z| - 1 of a step.
double growth_of(const Scene& scene) {
  const ddem::Assembly a = build_assembly(scene);
  const ContactParameters contact = contact_parameters(scene);
  const HeldDofs held = held_dofs(scene, a);
  const double dt = std::get<StepFraction>(scene.time.step).of_critical * 2.0 / largest_frequency(a, contact, held);
  return step_growth(a, contact, deformation_parameters(scene), held, dt);
}

/// "... grows by 0.2 a step, ...".
double told_growth(const std::string& warning) { return std::stod(warning.substr(warning.find("grows by ") + 9)); }

std::string warning_with(const std::vector<std::string>& warnings, const std::string& part) {
  for (const std::string& w : warnings) {
    if (w.find(part) != std::string::npos) return w;
  }
  return "";
}

TEST(InstabilityWarnings, OfAStepAboveTheCriticalOneTellItsGrowth) {
  for (const char* step : {"step_fraction = 1.0001", "step_fraction = 1.002", "step_fraction = 1.05"}) {
    const Scene scene = scene_of(step);
    const std::string warning = warning_with(run_scene(scene).warnings, "times the critical one");
    ASSERT_NE(warning, "") << step;
    EXPECT_NEAR(told_growth(warning) / growth_of(scene), 1.0, 0.04) << warning;  // two digits
  }
  EXPECT_EQ(warning_with(run_scene(scene_of("step_fraction = 0.9999")).warnings, "grows"), "");
  EXPECT_EQ(warning_with(run_scene(scene_of("integrator = \"exact\"\nstep_fraction = 1.5")).warnings, "grows"), "") << "its march is another";
}

/// Where a run is too short to show it: the growth of the step's eigenvalues is in the warning, and nothing in the energy.
TEST(InstabilityWarnings, OfSlowWavesOfTheLatticeAreGivenWhereTheRunShowsNone) {
  const std::string published = "correction = \"normal\"\nscheme = ";
  for (const auto& [scheme, ratio] : {std::pair("\"lagged\"", 0.5), std::pair("\"lagged\"", 1.0)}) {
    const Scene scene = scene_of("step_fraction = 0.2", published + scheme, ratio);
    const DemRun run = run_scene(scene);
    EXPECT_FALSE(run.result.breakdown);
    EXPECT_FALSE(run.context.obstacle) << run.context.obstacle->reason;
    const std::string warning = warning_with(run.warnings, "a plane wave of the lattice grows by ");
    ASSERT_NE(warning, "") << scheme << ratio;
    const double growth = growth_of(scene);
    EXPECT_GT(growth, 0.0);
    EXPECT_LT(growth, 1.05 * told_growth(warning)) << "the worst of all waves, of which the strip has some";
    EXPECT_GT(growth, 0.3 * told_growth(warning));
  }
  // Stable by the same eigenvalues.
  for (const auto& [scheme, ratio] : {std::pair(published + "\"lagged\"", 0.25), std::pair(published + "\"lagged\"", 0.0), std::pair(std::string("correction = \"full\""), 1.0)}) {
    const Scene scene = scene_of("step_fraction = 0.2", scheme, ratio);
    EXPECT_LE(growth_of(scene), kGrowthRoundOff) << scheme << ratio;
    EXPECT_EQ(warning_with(run_scene(scene).warnings, "grows"), "") << scheme << ratio;
  }
}

/// The flip, for any number of evaluations and relaxation: warned of exactly where the eigenvalues grow.
TEST(InstabilityWarnings, OfTheStepsOfEverySchemeAgreeWithItsEigenvalues) {
  int unstable = 0, stable = 0;
  for (const char* scheme : {"correction = \"full\"", "correction = \"normal\"", "correction = \"full\"\nevaluations = 3", "correction = \"full\"\nrelaxation = 0.5",
                             "correction = \"normal_only_stress\"\nevaluations = 3\nrelaxation = 0.7", "correction = \"full\"\nevaluations = 2\nrelaxation = 0.4",
                             "correction = \"full\"\nscheme = \"implicit\""}) {
    for (const double fraction : {0.3, 0.6, 0.8, 0.95, 1.02, 1.15, 1.4}) {
      const Scene scene = scene_of(fmt::format("step_fraction = {}", fraction), scheme, 0.25, 5);
      const bool grows = growth_of(scene) > kGrowthRoundOff;
      const DemRun run = run_scene(scene);
      const bool warned = warning_with(run.warnings, "scheme is unstable at this step") != "";
      EXPECT_EQ(warned, grows) << scheme << ", " << fraction << ": " << growth_of(scene);
      ++(grows ? unstable : stable);
    }
  }
  EXPECT_GT(unstable, 5);
  EXPECT_GT(stable, 5);
}

}  // namespace
}  // namespace ddem::harness::test
