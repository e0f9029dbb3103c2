// Scene files.
#include "harness/scene/read_scene.h"
#include "tests/fuzz/fuzz.h"

void fuzz(std::string_view text) {
  using namespace ddem::harness;
  for (const Purpose purpose :
       {Purpose::packing, Purpose::statics, Purpose::simulation, Purpose::continuum}) {
    const SceneResult scene = parse_scene(text, "fuzz.toml", "/nowhere", {purpose});
    require(scene.value.has_value() == scene.violations.empty());
  }
}
