#pragma once
// The lattice released from noise: does a scheme hold?

#include "harness/campaign/strip_statics.h"

namespace ddem::harness {

/// The lattices of the campaign whose discs deform.
std::vector<StripMaterial> lattices_with_strain(const StripCampaign& campaign);

/// Does not throw: see StabilityOutcome::failure.
StabilityOutcome release_noise(const StripCampaign& campaign, const StripMaterial& lattice,
                               const CampaignOptions& options);

}  // namespace ddem::harness
