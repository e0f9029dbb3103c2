#pragma once
// A scene file named on the command line.

#include <filesystem>
#include <string>

#include "harness/scene/read_scene.h"

namespace ddem::harness {

/// Reads it for that purpose; throws InputError with every violation.
Scene load_scene(const std::filesystem::path& path, Purpose purpose);

/// Refuses outputs that cannot be written, before anything is computed: the folder must exist. Throws MachineError.
void check_output(const std::string& path);

}  // namespace ddem::harness
