#pragma once
// From results to verdicts: one case a model, packing and k_t/k_n, with criteria whose bounds say where they are from.

#include <vector>

#include "harness/campaign/results.h"
#include "reports/verdict.h"

namespace ddem::harness {

std::vector<reports::Verdict> verdicts_of(const CampaignResults& results);

}  // namespace ddem::harness
