#include "harness/cli/scene_argument.h"

#include "harness/io/errors.h"
#include "harness/scene/scene_files.h"

namespace ddem::harness {

Scene load_scene(const std::filesystem::path& path, Purpose purpose) {
  SceneResult scene = read_scene(path, {purpose});
  if (scene) return *scene;
  std::vector<std::string> lines;
  for (const Violation& v : scene.violations) lines.push_back(to_string(v));
  throw InputError(lines);
}

std::vector<std::filesystem::path> files_read_by(const Scene& scene) {
  std::vector<std::filesystem::path> files = files_named_by(scene);
  files.push_back(scene.path);
  return files;
}

}  // namespace ddem::harness
