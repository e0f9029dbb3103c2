#include "harness/campaign/results.h"

#include <algorithm>
#include <cmath>

#include "harness/references/lattice_stability.h"

namespace ddem::harness {

const StaticOutcome* CampaignResults::find(const StripMaterial& key) const {
  const auto it = std::find_if(statics.begin(), statics.end(), [&](const StaticOutcome& s) { return s.key == key; });
  return it == statics.end() ? nullptr : &*it;
}

const WaveOutcome* CampaignResults::find(const StripCase& c) const {
  const auto it = std::find_if(waves.begin(), waves.end(), [&](const WaveOutcome& w) { return w.c == c; });
  return it == waves.end() ? nullptr : &*it;
}

const FemOutcome* CampaignResults::find(const StripMaterial& material, StripWave wave) const {
  StripMaterial key = material;
  key.model = continuum_model(campaign, material.model);
  const auto it = std::find_if(fem.begin(), fem.end(),
                               [&](const FemOutcome& f) { return f.key == key && f.wave == wave && !f.uniaxial; });
  return it == fem.end() ? nullptr : &*it;
}

Recording thinned(const Recording& recording) {
  constexpr std::size_t kSamples = 300;
  Recording out = recording;
  if (recording.signals.empty()) return out;
  const std::size_t stride = std::max<std::size_t>(1, recording.signals.front().values.size() / kSamples);
  out.sample_interval = recording.sample_interval * static_cast<double>(stride);
  for (PickedSignal& s : out.signals) {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < s.values.size(); n += stride) s.values[kept++] = s.values[n];
    s.values.resize(kept);
  }
  return out;
}

Model continuum_model(const StripCampaign& campaign, Model model) {
  const bool has_lagged = std::find(campaign.models.begin(), campaign.models.end(), Model::lagged_full) != campaign.models.end();
  return model == Model::implicit_full && has_lagged ? Model::lagged_full : model;
}

Uncertain sample_statistics(const std::vector<double>& values) {
  double mean = 0.0, squares = 0.0;
  for (const double v : values) mean += v;
  mean /= static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, values.size() > 1 ? std::sqrt(squares / static_cast<double>(values.size() - 1)) : 0.0};
}

bool expected_unstable(const StripCampaign& s, const StripMaterial& c) {
  if (c.model == Model::dem || c.model == Model::implicit_full || c.packing != StripPacking::hexagonal) return false;
  const bool normal = c.model == Model::lagged_normal;
  if (normal && c.stiffness_ratio > references::hexagonal_normal_ratio_limit) return true;
  const double limit = references::hexagonal_fixed_point_limit(
      normal ? references::ContactModel::ddem_normal : references::ContactModel::ddem_full, s.particle_poisson_ratio, c.stiffness_ratio);
  return s.normal_stiffness / s.particle_modulus > limit;
}

}  // namespace ddem::harness
