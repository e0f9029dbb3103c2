#pragma once
// [[case]] of a campaign file.

#include <filesystem>
#include <string>
#include <vector>

#include "harness/campaign/user_case.h"
#include "harness/scene/document.h"

namespace ddem::harness {

/// The cases of a campaign file, one for every point of their matrices. What is wrong with them, or with
/// their scenes, is added to `problems`.
std::vector<UserCase> read_cases(const Document& document, const std::filesystem::path& file,
                                 std::vector<std::string>& problems);

}  // namespace ddem::harness
