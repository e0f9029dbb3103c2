#pragma once
// The files of a finished campaign.

#include <filesystem>
#include <vector>

#include "harness/campaign/planned_campaign.h"
#include "reports/report.h"

namespace ddem::harness {

/// Makes the folder, and checks that files can be written there. Throws InputError, MachineError.
void prepare_folder(const std::filesystem::path& folder);

/// report.html, figures, results.h5, summary.json, junit.xml. Throws MachineError.
void write_results(const std::filesystem::path& folder, const CampaignResults& results, const reports::Report& report);

}  // namespace ddem::harness
