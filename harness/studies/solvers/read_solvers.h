#pragma once
// [solvers] of a campaign file: names = ["lammps", "my-dem.toml"], or "installed".

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/scene/document.h"
#include "reports/report.h"

namespace ddem::harness {

/// See InputTable. The data: {"names": [...]}.
nlohmann::json read_solvers(const Document& file, const std::filesystem::path& path, std::vector<std::string>& problems);
void check_solvers(const nlohmann::json& data);
std::string lost_of_solvers(const nlohmann::json& there, const nlohmann::json& here);
void introduce_solvers(const nlohmann::json& data, reports::Report& report);

/// In names of cases: the name itself, or that of the description's file without its ending.
std::string label_of_solver(const std::string& name);

}  // namespace ddem::harness
