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

std::vector<std::filesystem::path> files_read_by(const Scene& scene) {
  std::vector<std::filesystem::path> files = {scene.path};
  if (const auto* file = std::get_if<FilePacking>(&scene.assembly.packing)) files.push_back(file->discs);
  if (const auto* bonds = std::get_if<BondFile>(&scene.assembly.bonding)) files.push_back(bonds->path);
  if (const auto* state = std::get_if<InitialState>(&scene.load)) {
    if (state->displacement) files.push_back(*state->displacement);
    if (state->velocity) files.push_back(*state->velocity);
  }
  if (scene.continuum && scene.continuum->mesh) files.push_back(*scene.continuum->mesh);
  return files;
}

}  // namespace ddem::harness
