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

namespace {

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  return std::filesystem::weakly_canonical(a, ignored) == std::filesystem::weakly_canonical(b, ignored);
}

std::vector<std::filesystem::path> files_read_by(const Scene& scene) {
  std::vector<std::filesystem::path> files = {scene.path};
  if (const auto* file = std::get_if<FilePacking>(&scene.assembly.packing)) files.push_back(file->discs);
  if (const auto* bonds = std::get_if<BondFile>(&scene.assembly.bonding)) files.push_back(bonds->path);
  if (const auto* state = std::get_if<InitialState>(&scene.load)) {
    if (state->displacement) files.push_back(*state->displacement);
    if (state->velocity) files.push_back(*state->velocity);
  }
  return files;
}

}  // namespace

void check_outputs(const std::vector<std::string>& paths, const Scene& scene) {
  std::vector<std::filesystem::path> taken = files_read_by(scene);
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    const auto folder = std::filesystem::absolute(path).parent_path();
    if (!std::filesystem::is_directory(folder)) {
      throw MachineError(path + ": the folder " + folder.string() + " does not exist; create it first");
    }
    for (const auto& other : taken) {
      if (std::filesystem::is_character_file(path) || !same_file(path, other)) continue;
      throw InputError(path + ": would overwrite " + other.string() + ", which this command reads or writes too; name another file");
    }
    taken.push_back(path);
  }
}

}  // namespace ddem::harness
