#pragma once
// Names of units as names of files.

#include <filesystem>
#include <string_view>

namespace ddem::harness::nightly {

/// "material/random-1/dem/kt0.30" -> material/random-1/dem/kt0.30.unit: a folder for each part of the name. No two names
/// share a file, no file is another's folder, and none leads out of the folder that it is looked for in: other bytes than
/// letters, digits, '-', '_', '=', '+' and '.' are escaped as in web addresses (%2F), and so are the dots that would make
/// a part "..", hidden, or end in ".unit". What is too long for a file system is its digest.
std::filesystem::path file_of_unit(std::string_view id);

}  // namespace ddem::harness::nightly
