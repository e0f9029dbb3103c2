#include "harness/studies/strip/strip_results.h"

#include <algorithm>
#include <cmath>

namespace ddem::harness {

const StaticOutcome* StripResults::find(const StripMaterial& key) const {
  const auto it = std::find_if(statics.begin(), statics.end(), [&](const StaticOutcome& s) { return s.key == key; });
  return it == statics.end() ? nullptr : &*it;
}

const WaveOutcome* StripResults::find(const StripCase& c) const {
  const auto it = std::find_if(waves.begin(), waves.end(), [&](const WaveOutcome& w) { return w.c == c; });
  return it == waves.end() ? nullptr : &*it;
}

const FemOutcome* StripResults::find(const StripMaterial& material, StripWave wave) const {
  StripMaterial key = material;
  key.model = continuum_model(campaign, material.model);
  const auto it = std::find_if(fem.begin(), fem.end(),
                               [&](const FemOutcome& f) { return f.key == key && f.wave == wave && !f.uniaxial; });
  return it == fem.end() ? nullptr : &*it;
}

Uncertain sample_statistics(const std::vector<double>& values) {
  double mean = 0.0, squares = 0.0;
  for (const double v : values) mean += v;
  mean /= static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, values.size() > 1 ? std::sqrt(squares / static_cast<double>(values.size() - 1)) : 0.0};
}

}  // namespace ddem::harness
