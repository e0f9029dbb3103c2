#pragma once
// Runs a campaign on several threads. The results do not depend on how many.

#include <functional>

#include "harness/campaign/results.h"
#include "harness/run/fem_run.h"

namespace ddem::harness {

struct CampaignOptions {
  int jobs = 1;
  bool with_fem = true;
  bool with_studies = true;  ///< of schemes, and of the range of Poisson's ratio
  /// Called from any thread, with the work done since the last call out of campaign_work().
  std::function<void(std::size_t)> on_progress;
  /// Changes what the solvers are given, not the references: a defect that the verdicts must find.
  std::function<void(Scene&)> disturb_scene;
  std::function<void(ContinuumMaterial&)> disturb_continuum;
};

/// Units of progress of a whole campaign.
std::size_t campaign_work(const StripCampaign& campaign, const CampaignOptions& options);

CampaignResults run_campaign(const StripCampaign& campaign, const CampaignOptions& options);

}  // namespace ddem::harness
