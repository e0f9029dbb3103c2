#pragma once
// The design curves of a campaign, with the targets that were calibrated.

#include "harness/campaign/results.h"
#include "reports/figure.h"

namespace ddem::harness {

/// nu and E/k_n over k_t/k_n (means of the random packings' static moduli, and their span) and over k_n/E_p,
/// the closed forms of the lattice beside them, and the calibrated targets as points.
reports::Figure design_figure(const CampaignResults& results);

}  // namespace ddem::harness
