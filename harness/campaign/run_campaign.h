#pragma once
// Runs a campaign on several threads, in memory: without a file. The results do not depend on how many.

#include "harness/campaign/results.h"
#include "harness/campaign/run_options.h"

namespace ddem::harness {

CampaignResults run_campaign(const StripCampaign& campaign, const CampaignOptions& options);

}  // namespace ddem::harness
