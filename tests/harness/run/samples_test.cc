// As many rows of the signals as the scene asks for, however many steps lie between them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness/io/errors.h"
#include "harness/run/dem_run.h"
#include "harness/run/fem_plan.h"
#include "harness/scene/read_scene.h"
#include "tests/harness/run/key_values.h"

namespace ddem::harness::test {
namespace {

constexpr std::int64_t kSpacings[] = {1,          2,          7,          39,         40,         41,        32768,         65536,        65537,
                                      1000000000, 2147483647, 2147483648, 4294967295, 4294967296, 4294967297, 8589934594, 1000000000000};

SceneKeys base(const std::string& name) {
  for (const BaseScene& scene : base_scenes()) {
    if (scene.name == name) return scene.keys;
  }
  throw std::logic_error("no such base: " + name);
}

Scene scene_of(const SceneKeys& keys, Purpose purpose = Purpose::simulation) {
  const SceneResult scene = parse_scene(toml_of(keys), "scene.toml", folder_of_files(), {purpose});
  EXPECT_TRUE(scene) << to_string(scene.violations);
  return *scene;
}

TEST(Samples, AreARowAtTheStartAndAfterSoManySteps) {
  for (const char* name : {"pulse on a lattice", "lagged strains", "implicit strains", "exact", "pairs of probes"}) {
    for (const std::int64_t spacing : kSpacings) {
      SceneKeys keys = base(name);
      keys.erase("time.end");
      keys["time.steps"] = "40";
      keys["time.sample_every"] = fmt::format("{}", spacing);
      const DemRun run = run_scene(scene_of(keys));
      ASSERT_EQ(run.result.signals.time.size(), static_cast<std::size_t>(40 / spacing + 1)) << name << ": " << spacing;
      EXPECT_EQ(run.result.signals.time.front(), 0.0);
      if (spacing > 40) continue;
      EXPECT_NEAR(run.result.signals.time[1], 1e-9 * static_cast<double>(spacing), 1e-20);
    }
  }
}

TEST(Samples, OfTheContinuumAreAsWide) {
  for (const std::int64_t spacing : kSpacings) {
    SceneKeys keys = base("the continuum alone");
    keys["time.sample_every"] = fmt::format("{}", spacing);
    EXPECT_EQ(plan_fem(scene_of(keys, Purpose::continuum), {}).fem.sample_every, spacing);
  }
}

/// What the scene's run is refused with; empty where it is not.
std::string refusal(const SceneKeys& keys, int snapshots = 0) {
  RunOptions options;
  options.snapshots = snapshots;
  try {
    run_scene(scene_of(keys), options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Samples, ThatAreTooManyAreRefusedByTheirKey) {
  const auto says = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  SceneKeys keys = base("pulse on a lattice");
  keys.erase("time.end");
  for (const char* steps : {"2000000001", "4294967296", "4294967297", "1000000000000"}) {
    keys["time.steps"] = steps;
    const SceneResult scene = parse_scene(toml_of(keys), "scene.toml", folder_of_files(), {Purpose::simulation});
    EXPECT_TRUE(says(to_string(scene.violations), "time.steps = ")) << steps << to_string(scene.violations);
  }
  keys["time.steps"] = "2000000000";
  keys["probes.discs"] = "[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]";
  EXPECT_TRUE(says(refusal(keys), "time.sample_every: 2e+09 samples of 10 probes would take 1.44e+03 GB")) << refusal(keys);

  keys = base("pulse on a lattice");
  EXPECT_EQ(refusal(keys, 40), "");
  EXPECT_TRUE(says(refusal(keys, 41), "--snapshots: 41 are more than the 40 steps of the run"));
  keys["assembly.columns"] = "20000";
  keys["assembly.rows"] = "5000";
  EXPECT_TRUE(says(refusal(keys), "assembly.columns = 20000: 1e+08 discs would take 150 GB")) << refusal(keys);
  keys["assembly.columns"] = "1000";
  keys["assembly.rows"] = "100";
  EXPECT_TRUE(says(refusal(keys, 10000), "--snapshots: 10000 snapshots of 1e+05 discs would take 120 GB"));

  keys = base("the continuum alone");
  keys["continuum.elements"] = "[100000, 100000]";
  EXPECT_THROW(plan_fem(scene_of(keys, Purpose::continuum), {}), InputError);
}

}  // namespace
}  // namespace ddem::harness::test
