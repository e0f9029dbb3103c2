#pragma once
// A scene file named on the command line.

#include <filesystem>
#include <string>
#include <vector>

#include "harness/scene/read_scene.h"

namespace ddem::harness {

/// Reads it for that purpose; throws InputError with every violation.
Scene load_scene(const std::filesystem::path& path, Purpose purpose);

/// Refuses outputs before anything is computed: a folder that does not exist (MachineError); the same file twice, or one
/// that the scene reads: the scene itself, its discs, bonds or states (InputError). Empty paths: no output.
void check_outputs(const std::vector<std::string>& paths, const Scene& scene);

}  // namespace ddem::harness
