#pragma once
// Names of temporary files and folders say whose they are, so that what a killed process left can be told from what a
// living one still needs.

#include <filesystem>
#include <string>
#include <string_view>

namespace ddem::harness {

/// "1f03ba2c-4711-88012": this machine (and its space of process numbers), this process, and when it started.
std::string process_stamp();

/// Whether a name "...-STAMP-XXX" or "...-STAMP-XXX.tmp" is of a process of this machine that has ended. Not so: other names,
/// and those of other machines that share the folder.
bool is_of_ended_process(std::string_view name);

/// Removes what ended processes left in a folder: entries of that kind whose names begin so, and that belong to this user.
/// Once a folder and process; what cannot be removed stays.
void sweep_folder(const std::filesystem::path& folder, std::string_view beginning);

}  // namespace ddem::harness
