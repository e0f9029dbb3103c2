#pragma once
// What stands beside the running program, in a build and where it is installed.

#include <filesystem>
#include <string_view>

namespace ddem::harness {

/// The folder of the running program, links followed: its companions stand there.
std::filesystem::path program_folder();

/// Where share/ddem/`name` of the same tree is, or would be.
std::filesystem::path shared_file(std::string_view name);

}  // namespace ddem::harness
