#pragma once
// What is varied in the strip: its packing and its contacts.

#include <cstdint>
#include <string>
#include <vector>

#include "harness/io/members.h"
#include "harness/studies/strip/strip_campaign.h"

namespace ddem::harness {

/// Which assembly with which contact law: everything but the wave.
struct StripMaterial {
  StripPacking packing = StripPacking::hexagonal;
  std::int64_t seed = 0;
  Model model = Model::dem;
  double stiffness_ratio = 0.0;

  bool operator==(const StripMaterial&) const = default;
};

struct Speeds {
  double bar = 0.0, shear = 0.0, p = 0.0;
  double of(StripWave wave) const { return wave == StripWave::bar ? bar : wave == StripWave::shear ? shear : p; }
};

DDEM_MEMBERS(StripMaterial, packing, seed, model, stiffness_ratio)
DDEM_MEMBERS(Speeds, bar, shear, p)

/// All materials of the campaign, in a fixed order.
std::vector<StripMaterial> materials_of(const StripCampaign& campaign);

StripCase case_of(const StripMaterial& material, StripWave wave, Protocol protocol = Protocol::long_wave);

/// The waves that are sent through one material by a protocol, if any.
std::vector<StripCase> cases_of(const StripMaterial& material, Protocol protocol);

/// "random-1/lagged-full/kt0.30": the end of a unit's name.
std::string slug_of(const StripMaterial& material);

/// The model whose static moduli stand for a model's: lagged and implicit strains have the same equilibrium, and the
/// continuum is run once for both.
Model continuum_model(const StripCampaign& campaign, Model model);

/// The k_t/k_n whose signals are drawn: the one nearest to 0.3.
double shown_ratio(const StripCampaign& campaign);

}  // namespace ddem::harness
