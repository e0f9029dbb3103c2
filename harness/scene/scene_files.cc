#include "harness/scene/scene_files.h"

namespace ddem::harness {

std::vector<std::filesystem::path> files_named_by(const Scene& scene) {
  std::vector<std::filesystem::path> files;
  if (const auto* random = std::get_if<RandomPacking>(&scene.assembly.packing); random != nullptr && random->grading == Grading::sieve)
    files.push_back(random->sieve);
  if (const auto* file = std::get_if<FilePacking>(&scene.assembly.packing)) files.push_back(file->discs);
  if (const auto* bonds = std::get_if<BondFile>(&scene.assembly.bonding)) files.push_back(bonds->path);
  if (scene.continuum && scene.continuum->mesh) files.push_back(*scene.continuum->mesh);
  if (const auto* state = std::get_if<InitialState>(&scene.load)) {
    if (state->displacement) files.push_back(*state->displacement);
    if (state->velocity) files.push_back(*state->velocity);
  }
  return files;
}

}  // namespace ddem::harness
