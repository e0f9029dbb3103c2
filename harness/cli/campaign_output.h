#pragma once
// The end of a campaign, whether it was just run, merged or read from its folder.

#include <filesystem>
#include <optional>

#include "harness/campaign/planned_campaign.h"
#include "harness/nightly/comparison.h"

namespace ddem::harness {

/// For --help.
inline constexpr const char* kPartialHelp = "the run is a part of the baseline's: what it lacks is SKIPPED, not MISSING";

/// Where a run's outcome goes, and what it is compared with.
struct Conclusion {
  std::filesystem::path folder;  ///< of report and results
  std::optional<nightly::Baseline> baseline;
  bool partial = false;  ///< what the baseline has and the run has not was not asked for
  std::filesystem::path history;  ///< gets a night; empty: none does
};

/// Judges, writes report and results, prints what did not pass, and returns the exit code.
int conclude_campaign(const PlannedCampaign& campaign, const CampaignResults& results,
                      const Conclusion& conclusion);

}  // namespace ddem::harness
