#pragma once
// The report of a campaign: which figures and tables, filled with its results.

#include <vector>

#include "harness/campaign/results.h"
#include "reports/report.h"

namespace ddem::harness {

/// `more`: sections by others, after those of the results.
reports::Report report_of(const CampaignResults& results, const std::vector<reports::Verdict>& verdicts,
                          const std::vector<reports::Section>& more = {});

}  // namespace ddem::harness
