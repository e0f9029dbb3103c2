#pragma once
// The lattice released from noise: does a scheme hold?

#include "harness/studies/strip/strip_statics.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// The lattice, periodic in x and y, released from noise: does the published scheme hold?
struct StabilityOutcome {
  StripMaterial key;
  std::string failure;
  bool expected_unstable = false;
  std::optional<long> diverged_step;
  long steps = 0;
};

DDEM_MEMBERS(StabilityOutcome, key, failure, expected_unstable, diverged_step, steps)

/// Whether theory says that the published scheme is unstable there: on the lattice beyond the fixed-point limit, or N
/// with k_t/k_n above 1/3 (theory section 3); on random packings nothing exact is known.
bool expected_unstable(const StripCampaign& campaign, const StripMaterial& key);

/// Noise that is the same everywhere: no library's random numbers, whose distributions differ.
std::vector<double> steady_noise(std::size_t n, std::uint64_t state, double amplitude);

/// The lattices of the campaign whose discs deform.
std::vector<StripMaterial> lattices_with_strain(const StripCampaign& campaign);

/// Does not throw: see StabilityOutcome::failure.
StabilityOutcome release_noise(const StripCampaign& campaign, const StripMaterial& lattice,
                               const CampaignOptions& options);

/// Where theory says so, it must diverge; elsewhere it must not.
reports::Verdict noise_verdict(const StabilityOutcome& outcome);

}  // namespace ddem::harness
