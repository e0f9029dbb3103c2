#pragma once
// The files of a campaign: results.h5, summary.json, junit.xml, report.html, and its figures as SVG, each whole or not
// at all.

#include <filesystem>
#include <vector>

#include "harness/campaign/results.h"
#include "reports/report.h"

namespace ddem::harness {

/// Makes the folder, so that a campaign that cannot be written is not run. Throws MachineError.
void prepare_folder(const std::filesystem::path& folder);

/// Writes all of them into `folder`; `more` are sections of the report by others. Throws MachineError.
void write_results(const std::filesystem::path& folder, const CampaignResults& results,
                   const std::vector<reports::Verdict>& verdicts, const std::vector<reports::Section>& more = {});

}  // namespace ddem::harness
