#include "harness/studies/strip/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ddem::harness {

std::vector<StripMaterial> materials_of(const StripCampaign& s) {
  std::vector<StripMaterial> keys;
  for (const Model model : s.models) {
    for (const double ratio : s.stiffness_ratios) {
      keys.push_back({StripPacking::hexagonal, 0, model, ratio});
      for (const std::int64_t seed : s.seeds) keys.push_back({StripPacking::random, seed, model, ratio});
    }
  }
  return keys;
}

StripCase case_of(const StripMaterial& m, StripWave wave, Protocol protocol) {
  return {m.packing, m.seed, m.model, m.stiffness_ratio, protocol, wave};
}

std::vector<StripCase> cases_of(const StripMaterial& m, Protocol protocol) {
  std::vector<StripCase> cases;
  if (protocol == Protocol::paper && m.packing != StripPacking::random) return cases;
  for (const StripWave wave : {StripWave::bar, StripWave::shear, StripWave::p}) {
    if (protocol == Protocol::paper && wave == StripWave::p) continue;
    cases.push_back(case_of(m, wave, protocol));
  }
  return cases;
}

std::string slug_of(const StripMaterial& m) {
  const std::string packing = m.packing == StripPacking::hexagonal ? "hexagonal" : fmt::format("random-{}", m.seed);
  return packing + "/" + material_slug(m.model, m.stiffness_ratio);
}

Model continuum_model(const StripCampaign& campaign, Model model) {
  const bool has_lagged = std::find(campaign.models.begin(), campaign.models.end(), Model::lagged_full) != campaign.models.end();
  return model == Model::implicit_full && has_lagged ? Model::lagged_full : model;
}

double shown_ratio(const StripCampaign& s) {
  return *std::ranges::min_element(s.stiffness_ratios, {}, [](double ratio) { return std::abs(ratio - 0.3); });
}

}  // namespace ddem::harness
