#pragma once
// The continuum beside the strips: one process of ddem-fem for all of a campaign, since many cases are one
// problem.

#include <functional>
#include <vector>

#include "harness/studies/finite_elements/finite_elements_data.h"
#include "harness/studies/strip/strip_statics.h"

namespace ddem::harness {

/// Units of progress.
inline constexpr std::size_t kWorkOfFemCase = 3;

/// With the static moduli of the first random strip, all models and ratios, and one bar with nu = 0; nothing
/// run yet.
std::vector<FemOutcome> fem_outcomes(const StripCampaign& campaign);

/// Runs all of them. Throws as run_fem().
std::vector<FemOutcome> run_strip_fem(const StripCampaign& campaign, StripStatics& statics,
                                      const CampaignOptions& options);

/// Runs any outcomes of these materials. `disturb` changes the material that outcome k is solved with, not
/// its reference.
std::vector<FemOutcome> run_fem_outcomes(
    const StripCampaign& campaign, StripStatics& statics, std::vector<FemOutcome> outcomes,
    const std::function<void(std::size_t k, ContinuumMaterial&)>& disturb,
    const std::function<void()>& on_case = {});

}  // namespace ddem::harness
