#pragma once
// Reading scene files.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/scene/check_scene.h"
#include "harness/scene/scene.h"
#include "harness/scene/violation.h"

namespace ddem::harness {

/// A value instead of what the file says, or says nothing of: {"contact.stiffness_ratio", "0.5"}, as TOML.
struct SceneOverride {
  std::string key, value;
};

struct ReadOptions {
  Purpose purpose = Purpose::simulation;
  std::vector<SceneOverride> overrides = {};
  bool continuum_too = false;  ///< read for the continuum as well: its mesh must be there
};

using SceneResult = Checked<Scene>;

/// Reads a scene file. Files that it names are looked for in its folder; one that the purpose does not read need not be there: a
/// start is for simulations, a mesh for the continuum, discs and bonds are for all. Every problem of the file is listed,
/// in the order of its lines; a file that is no TOML has one. Does not throw on any input.
SceneResult read_scene(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for a text; `name` stands for the file in messages.
SceneResult parse_scene(std::string_view text, const std::string& name,
                        const std::filesystem::path& base_folder, const ReadOptions& options = {});

}  // namespace ddem::harness
