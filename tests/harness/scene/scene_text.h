#pragma once
// Scenes to test with, and a folder for the files that they name.

#include <filesystem>
#include <string>
#include <string_view>

#include "harness/scene/read_scene.h"

namespace ddem::harness::test {

/// A scene with a key in every table that goes together with the others.
std::string full_scene();

/// The least that a simulation needs. Its lines are numbered in the tests of errors.
std::string small_scene();

/// `text` with its only occurrence of `what` replaced; throws if there is none or more than one.
std::string replaced(std::string text, std::string_view what, std::string_view by);

/// Reads `text` as "scene.toml" in the temporary folder.
SceneResult parse(std::string_view text, Purpose purpose = Purpose::simulation);

/// Messages of all violations, a line each.
std::string messages(std::string_view text, Purpose purpose = Purpose::simulation);

std::filesystem::path temporary_folder();
std::filesystem::path write_file(const std::string& name, std::string_view content);

}  // namespace ddem::harness::test
