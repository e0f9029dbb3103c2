#pragma once
// Which folder a campaign may be written into: one that is empty of campaigns, or holds the same one.

#include <filesystem>
#include <string>
#include <vector>

#include "harness/nightly/plan.h"
#include "reports/report.h"

namespace ddem::harness {

/// For --help.
inline constexpr const char* kForceHelp =
    "replace the report of another campaign. Without it a folder is written into where it holds no report, or that of the\n"
    "same campaign: all of its cases are among this run's, of the same scenes and strip (criteria, titles and the program\n"
    "may be others)";

/// Throws InputError, with what is there and the remedies, where the folder's report or plan is not the campaign's.
void check_replaceable(const std::filesystem::path& folder, const nightly::Plan& plan, bool force);

/// The same of a folder into which a report is drawn alone.
void check_drawable(const std::filesystem::path& folder, const reports::Report& report, bool force);

/// Throws InputError where the folders of a run and of the nights are one, or one lies in the other: each would take the
/// other's files for its own. `history` may be empty.
void require_apart(const std::filesystem::path& folder, const std::filesystem::path& history);

/// Throws InputError where two of the folders are one, by whatever name, or the target is one of them.
void require_distinct(const std::vector<std::string>& folders, const std::filesystem::path& target);

}  // namespace ddem::harness
