#include "harness/cli/scene_argument.h"

#include "harness/io/errors.h"

namespace ddem::harness {

Scene load_scene(const std::filesystem::path& path, Purpose purpose) {
  SceneResult scene = read_scene(path, {purpose});
  if (scene) return *scene;
  std::vector<std::string> lines;
  for (const Violation& v : scene.violations) lines.push_back(to_string(v));
  throw InputError(lines);
}

void check_output(const std::string& path) {
  if (path.empty()) return;
  const auto folder = std::filesystem::absolute(path).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    throw MachineError(path + ": the folder " + folder.string() + " does not exist; create it first");
  }
}

}  // namespace ddem::harness
