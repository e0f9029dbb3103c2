#pragma once
// Problems that show only when a scene is used, at the place in its file that they come from.

#include <string>
#include <string_view>

#include "harness/scene/scene.h"

namespace ddem::harness {

/// "scene.toml:17: time.step = 1e-06: MESSAGE; REMEDY": with line and value where the key is written in the file.
std::string scene_problem(const Scene& scene, std::string_view dotted_key, std::string message, std::string remedy);

}  // namespace ddem::harness
