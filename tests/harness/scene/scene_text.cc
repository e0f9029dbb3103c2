#include "tests/harness/scene/scene_text.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace ddem::harness::test {

std::string full_scene() {
  return R"(title = "bar, DDEM"

[assembly]
packing  = "random"
length   = "16.5 mm"
width    = "2 mm"
discs    = 682
seed     = 7
bond_gap = 0.25
periodic = ""
edge_band = 1.3
thickness = "2 cm"
radius_ratio = 1.5
walls = "periodic"

[material]
density = 2100.0

[contact]
normal_stiffness = 3e10
stiffness_ratio  = 0.35
kinematics       = "nonlinear"
new_contacts     = "off"

[deformation]
scheme        = "lagged"
evaluations   = 1
relaxation    = 1.0
correction    = "normal_only_stress"
young_modulus = 4e10
poisson_ratio = 0.31
plane         = "strain"

[boundary]
top_bottom = "periodic"
right      = "fixed"
left       = "fixed_x"

[initial]
wave      = "shear"
shape     = "gaussian"
width     = "2 mm"
center    = "3 mm"
amplitude = "1 um"

[continuum]
young_modulus = "9 GPa"
poisson_ratio = 0.28
density       = "1.7 g/cm3"
degree        = 3
elements      = [33, 4]

[time]
integrator = "verlet"
step_fraction = 0.1
end = "2e-5 s"
sample_every = 3
allow_above_critical = true

[probes]
pairs = 4
section = true

[run]
threads = 2
)";
}

std::string small_scene() {
  return R"([assembly]
packing = "random"
length = 0.0165
width = 0.002
discs = 682
[material]
density = 2000.0
[contact]
normal_stiffness = 1e10
stiffness_ratio = 0.25
[initial]
wave = "longitudinal"
amplitude = 1e-6
)";
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos || text.find(what, at + 1) != std::string::npos) {
    throw std::logic_error("not exactly once in the text: " + std::string(what));
  }
  return text.replace(at, what.size(), by);
}

SceneResult parse(std::string_view text, Purpose purpose) {
  return parse_scene(text, "scene.toml", temporary_folder(), {purpose});
}

std::string messages(std::string_view text, Purpose purpose) {
  return to_string(parse(text, purpose).violations);
}

std::filesystem::path temporary_folder() {
  // By process: ctest runs the tests of this executable side by side.
  static const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("ddem_scene_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  static const struct RemoveAtExit {
    ~RemoveAtExit() {
      std::error_code ignored;
      std::filesystem::remove_all(folder, ignored);
    }
  } cleanup;
  return folder;
}

std::filesystem::path write_file(const std::string& name, std::string_view content) {
  const std::filesystem::path path = temporary_folder() / name;
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

}  // namespace ddem::harness::test
