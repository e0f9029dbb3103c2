#pragma once
// The files that a scene names.

#include <filesystem>
#include <vector>

#include "harness/scene/scene.h"

namespace ddem::harness {

/// What a run of the scene reads beside the scene itself; whether they exist is not looked at.
std::vector<std::filesystem::path> files_named_by(const Scene& scene);

}  // namespace ddem::harness
