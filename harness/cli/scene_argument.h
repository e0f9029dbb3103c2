#pragma once
// A scene file named on the command line.

#include <filesystem>
#include <vector>

#include "harness/scene/read_scene.h"

namespace ddem::harness {

/// Reads it for that purpose; throws InputError with every violation.
Scene load_scene(const std::filesystem::path& path, Purpose purpose);

/// The scene itself, its discs, bonds, states and mesh: what no output may replace.
std::vector<std::filesystem::path> files_read_by(const Scene& scene);

}  // namespace ddem::harness
