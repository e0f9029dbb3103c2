// The scenes that users copy.

#include <gtest/gtest.h>

#include "harness/scene/read_scene.h"

namespace ddem::harness::test {
namespace {

Scene example(const std::string& name, Purpose purpose) {
  const SceneResult scene = read_scene(std::filesystem::path(DDEM_SCENES) / name, {purpose});
  EXPECT_TRUE(scene) << to_string(scene.violations);
  return scene ? *scene : Scene{};
}

TEST(ExampleScenes, BarDem) {
  const Scene scene = example("bar_dem.toml", Purpose::simulation);
  EXPECT_EQ(std::get<RandomPacking>(scene.assembly.packing).discs, 682);
  EXPECT_FALSE(scene.assembly.periodic.y);
  EXPECT_FALSE(scene.deformation);
}

TEST(ExampleScenes, ShearDdem) {
  const Scene scene = example("shear_ddem.toml", Purpose::simulation);
  EXPECT_TRUE(scene.assembly.periodic.y);
  ASSERT_TRUE(scene.deformation);
  EXPECT_EQ(scene.deformation->scheme, Scheme::lagged);
  EXPECT_EQ(std::get<NormalStiffness>(scene.contact->stiffness).k_n / scene.deformation->young_modulus, 0.25);
}

TEST(ExampleScenes, ModuliCell) {
  const Scene scene = example("moduli_cell.toml", Purpose::statics);
  EXPECT_TRUE(scene.assembly.periodic.x);
  EXPECT_TRUE(std::holds_alternative<HexagonalPacking>(scene.assembly.packing));
}

TEST(ExampleScenes, Continuum) {
  const Scene scene = example("continuum.toml", Purpose::continuum);
  EXPECT_FALSE(scene.contact);
  EXPECT_EQ(scene.continuum->young_modulus, 10e9);
  EXPECT_EQ(std::get<ProbePoints>(scene.probes).points.size(), 4u);
}

TEST(ExampleScenes, LongWaveP) {
  const Scene scene = example("long_wave_p.toml", Purpose::simulation);
  EXPECT_EQ(std::get<Drive>(scene.load).wave, Wave::longitudinal);
  EXPECT_TRUE(scene.assembly.periodic.y);
  EXPECT_TRUE(std::get<ProbePairs>(scene.probes).section);
}

}  // namespace
}  // namespace ddem::harness::test
