#pragma once
// The report of a campaign, from what its studies say.

#include <string>
#include <vector>

#include "harness/campaign/planned_campaign.h"
#include "reports/report.h"

namespace ddem::harness {

std::string campaign_title(const nlohmann::json& tables);

/// `more`: sections besides those of the studies. A figure that lacks results is left out, with the reason.
reports::Report report_of(const CampaignResults& results, const std::vector<reports::Verdict>& verdicts,
                          const std::vector<reports::Section>& more = {});

}  // namespace ddem::harness
