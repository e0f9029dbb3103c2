#pragma once
// Files that the program keeps for itself: regular ones. A pipe in the place of one is never waited for.

#include <filesystem>
#include <string>

namespace ddem::harness {

/// Whom a file may come from.
enum class Trust {
  any,  ///< where the user points to
  own,  ///< where anybody may have put something: no link, this user's or root's, and not writable to all
};

/// The content of a regular file; InputError where there is none, or it cannot be trusted or read.
std::string read_regular_file(const std::filesystem::path& path, Trust trust = Trust::any);

}  // namespace ddem::harness
