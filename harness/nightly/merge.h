#pragma once
// Several folders of one plan into one. Commutative and idempotent: whichever order, however often.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/nightly/plan.h"

namespace ddem::harness::nightly {

struct MergeReport {
  std::vector<std::string> missing;  ///< units without a result in any folder
  std::vector<std::string> refused;  ///< files that were not used, and why
};

/// Copies the plan and the results of all folders into `target`, which may be one of them, and adds to what
/// it has of the same plan; another plan there gives way where `replace` says so, else it is an error. Of the same unit a result counts more than a failure. Throws InputError, before anything is
/// written, where the folders are of different plans, and where two results of one identity differ in more
/// than times: naming all of them.
MergeReport merge_folders(std::span<const std::filesystem::path> folders,
                          const std::filesystem::path& target, bool replace = false);

}  // namespace ddem::harness::nightly
