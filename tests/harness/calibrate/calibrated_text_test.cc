// The scene file that a calibration writes: the user's, with the found values.
#include "harness/calibrate/scene_text.h"

#include <gmock/gmock.h>

#include "harness/io/errors.h"
#include "tests/harness/calibrate/scenes.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;
using testing::Not;

FoundParameters found() {
  FoundParameters f;
  f.point = {0.2, 0.5, 0.45};
  f.stiffness = 3e10;
  f.particle_young_modulus = 6e10;
  f.particle_density = 2847.25;
  return f;
}

Scene packing_scene(const std::string& text) {
  SceneResult scene = parse_scene(text, "scene.toml", ".", {Purpose::packing});
  EXPECT_TRUE(scene) << to_string(scene.violations);
  return *scene;
}

constexpr const char* kAssembly = "[assembly]  # mine\npacking = \"hexagonal\"\nperiodic = \"xy\"\n";

TEST(CalibratedText, ReplacesValuesAndKeepsTheRest) {
  const std::string text =
      std::string("# stiffness_ratio = 0.25 is not this one\ntitle = \"my stiffness_ratio\"\n\n") +
      kAssembly +
      "[contact]\nstiffness_ratio  = 0.25   # k_t / k_n = 0.25\nnormal_stiffness = \"10 GN/m\"\nnew_contacts "
      "= \"off\"\n"
      "[deformation]\nyoung_modulus=4e10\npoisson_ratio = 0.3\n[material]\ndensity = \"2 g/cm3\"\n";
  const std::string out = calibrated_text(packing_scene(text), found());
  EXPECT_EQ(out, std::string("# stiffness_ratio = 0.25 is not this one\ntitle = \"my stiffness_ratio\"\n\n") +
                     kAssembly +
                     "[contact]\nstiffness_ratio  = 0.2   # k_t / k_n = 0.25\nnormal_stiffness = "
                     "30000000000.0\nnew_contacts = \"off\"\n"
                     "[deformation]\nyoung_modulus=60000000000.0\npoisson_ratio = 0.45\n[material]\ndensity "
                     "= 2847.25\n");
}

TEST(CalibratedText, AddsTablesAndKeysThatAreMissing) {
  const std::string bare = calibrated_text(packing_scene(kAssembly), found());
  const Scene read = scene_of(bare);
  EXPECT_EQ(std::get<NormalStiffness>(read.contact->stiffness).k_n, 3e10);
  EXPECT_EQ(read.contact->stiffness_ratio, 0.2);
  EXPECT_EQ(read.material->density, 2847.25);
  EXPECT_FALSE(read.deformation);  // rigid discs stay rigid
  EXPECT_THAT(bare, HasSubstr("# mine"));
}

TEST(CalibratedText, WritesTheContactModulusWhereThereIsOne) {
  const Scene scene = packing_scene(
      std::string(kAssembly) +
      "[contact]\ncontact_modulus = \"20 GPa\"\nstiffness_ratio = 1\n[material]\ndensity = 1000\n");
  const Scene read = scene_of(calibrated_text(scene, found()));
  EXPECT_EQ(std::get<ContactModulus>(read.contact->stiffness).pascal, 3e10);
}

TEST(CalibratedText, TakesInlineAndDottedTablesOrSaysThatItCannot) {
  const std::string dotted =
      std::string(
          "contact.stiffness_ratio = 0.25\ncontact.normal_stiffness = 1e10\nmaterial.density = 2000\n") +
      kAssembly;
  EXPECT_EQ(scene_of(calibrated_text(packing_scene(dotted), found())).contact->stiffness_ratio, 0.2);
  const std::string in_line =
      std::string(
          "contact = { stiffness_ratio = 0.25, normal_stiffness = 1e10 }\nmaterial = { density = 2000 }\n") +
      kAssembly;
  try {
    EXPECT_EQ(scene_of(calibrated_text(packing_scene(in_line), found())).contact->stiffness_ratio, 0.2);
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("with a line for each key"));
  }
}

TEST(CalibratedText, TheDefaultAssemblyIsAScene) {
  const Scene scene = packing_scene(default_assembly_text());
  const std::string text = calibrated_text(scene, found()) + default_load_text(2000.0);
  const SceneResult read = parse_scene(text, "scene.toml", ".", {Purpose::simulation});
  ASSERT_TRUE(read) << to_string(read.violations);
  EXPECT_DOUBLE_EQ(std::get<Drive>(read->load).duration, 4e-6);
}

}  // namespace
}  // namespace ddem::harness::test
