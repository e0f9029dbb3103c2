#pragma once
// From recorded signals to a wave speed: windows free of reflections, a pick at each probe, the speed of each pair.
// The same for particles and continuum.

#include <optional>
#include <vector>

#include "harness/measure/phase_velocity.h"
#include "harness/measure/picker.h"
#include "harness/measure/wave_speed.h"
#include "harness/model/probes.h"

namespace ddem::harness {

/// What is known of the wave before it is measured.
struct WaveContext {
  double speed = 0.0;            ///< expected, m/s: static, or the kinematic estimate
  double length = 0.0;           ///< of the strip, m
  double left_end = 0.0;         ///< x of the source, m
  double source_centre = 0.0;    ///< where the source's maximum starts, m from the left end
  double source_duration = 0.0;  ///< of a driven edge, s
  double source_amplitude = 0.0; ///< m
  double smallest_arrival = 0.05; ///< of the amplitude: what is smaller is no arrival
  double pulse_half_width = 0.0; ///< of the pulse that the source sends, s; 0: a released column, which sends none
};

/// From the first possible arrival to the last, and before the first reflection, at a probe.
Window causal_window(const WaveContext& context, double x);

/// When the peak has passed x, with a margin of `margin` times the travel time: how long a run must last.
double time_of_passage(const WaveContext& context, double x, double margin);

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
