#pragma once
// What studies of the strip found, as others look it up: statics, waves and the continuum of each material.

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "harness/measure/elastic_constants.h"
#include "harness/studies/finite_elements/finite_elements_data.h"
#include "harness/studies/statics/statics_data.h"
#include "harness/studies/strip/material.h"
#include "harness/studies/waves/waves_data.h"

namespace ddem::harness {

/// Each list is planned by its study, with reasons why there is nothing yet; places stay where they are.
struct StripResults {
  StripCampaign campaign;
  std::deque<StaticOutcome> statics;
  std::deque<WaveOutcome> waves;  ///< by both protocols
  std::deque<FemOutcome> fem;
  std::string fem_failure;  ///< why there are no finite-element results at all

  /// Whether the strip's waves were to be run.
  bool has_waves() const { return !waves.empty(); }
  const StaticOutcome* find(const StripMaterial& key) const;
  const WaveOutcome* find(const StripCase& c) const;
  /// The continuum of that material: see continuum_model().
  const FemOutcome* find(const StripMaterial& material, StripWave wave) const;
};

/// Mean and standard deviation of the sample (n - 1).
Uncertain sample_statistics(const std::vector<double>& values);

}  // namespace ddem::harness
