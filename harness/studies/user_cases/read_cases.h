#pragma once
// [[case]] of a campaign file.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/studies/user_cases/user_case.h"
#include "harness/scene/document.h"
#include "reports/report.h"

namespace ddem::harness {

/// See InputTable.
nlohmann::json read_case_table(const Document& file, const std::filesystem::path& path, std::vector<std::string>& problems);
void check_cases(const nlohmann::json& data);
std::string lost_of_cases(const nlohmann::json& there, const nlohmann::json& here);
void introduce_cases(const nlohmann::json& data, reports::Report& report);

/// The cases of a campaign file, one for every point of their matrices. What is wrong with them, or with
/// their scenes, is added to `problems`.
std::vector<UserCase> read_cases(const Document& document, const std::filesystem::path& file,
                                 std::vector<std::string>& problems);

}  // namespace ddem::harness
