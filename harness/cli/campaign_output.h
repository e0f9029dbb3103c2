#pragma once
// The end of a campaign, whether it was just run, merged or read from its folder.

#include <filesystem>
#include <optional>

#include "harness/campaign/planned_campaign.h"
#include "harness/nightly/baseline.h"

namespace ddem::harness {

/// Where a run's outcome goes, and what it is compared with.
struct Conclusion {
  std::filesystem::path folder;  ///< of report and results
  std::optional<nightly::Baseline> baseline;
  std::filesystem::path history;  ///< gets a night; empty: none does
};

/// Judges, writes report and results, prints what did not pass, and returns the exit code.
int conclude_campaign(const PlannedCampaign& campaign, const CampaignResults& results,
                      const Conclusion& conclusion);

}  // namespace ddem::harness
