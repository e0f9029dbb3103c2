#pragma once
// Particles over continuum: the same pulse at the same sections.

#include <optional>

#include "harness/studies/strip/strip_results.h"

namespace ddem::harness {

/// Correlation coefficient sum(a b)/sqrt(sum a^2 sum b^2) of the particles' and the continuum's signals over all probes,
/// each up to the end of its causal window (what follows is the end's echo), without shift. Empty where one of them is missing.
std::optional<double> waveform_correlation(const StripResults& results, const StripMaterial& key, StripWave wave);

/// A recording's value at a time, linearly between samples; 0 before the start.
double value_at(const std::vector<double>& signal, double sample_interval, double time);

}  // namespace ddem::harness
