#pragma once
// From recorded signals to a wave speed: windows free of reflections, a pick at each probe, the speed of each pair where
// measurability.h finds a wave. The same for particles and continuum.

#include <optional>
#include <vector>

#include "harness/measure/phase_velocity.h"
#include "harness/measure/picker.h"
#include "harness/measure/wave_speed.h"
#include "harness/model/probes.h"
#include "harness/run/wave_context.h"

namespace ddem::harness {

struct ProbePick {
  int probe = 0;
  Pick pick;
};

/// The same pairs measured in three ways. Dispersion and scatter of a packing move a pulse's top, its centroid and its
/// best fit apart: how far they differ is a measure of what a single number can mean.
struct WaveMeasurement {
  std::vector<ProbePick> picks;
  WaveSpeed speed;                        ///< peak to peak, as in the paper
  std::optional<WaveSpeed> by_centroid;   ///< centroids over the pulse's width; empty where the source sends no pulse of known width
  WaveSpeed by_correlation;               ///< cross-correlation of each pair's signals, cut before the first reflection
};

/// The mean speeds of the three ways, m/s; empty where there is none.
struct PickedSpeeds {
  std::optional<double> peak = {}, centroid = {}, correlation = {};
};
PickedSpeeds picked_speeds(const WaveMeasurement& measurement);

/// `signals[p]` belongs to `probes[p]`; the component that carries the wave. A mean needs more than half of the pairs.
WaveMeasurement measure_wave(const std::vector<std::vector<double>>& signals, double dt,
                             const ProbeLayout& layout, const WaveContext& context);

/// Phase velocity against frequency between the probes of each pair (see phase_velocity.h), windowed like the picks.
std::vector<Outcome<PhaseVelocity>> phase_velocities(const std::vector<std::vector<double>>& signals, double dt,
                                                     const ProbeLayout& layout, const WaveContext& context);

}  // namespace ddem::harness
