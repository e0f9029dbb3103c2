#pragma once
// What is known of a wave before it is measured, whatever solver or laboratory recorded it.

#include <optional>

#include "harness/measure/outcome.h"
#include "harness/measure/signal.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

struct WaveContext {
  double speed = 0.0;            ///< expected, m/s: static, or the kinematic estimate
  double length = 0.0;           ///< of the strip, m
  double left_end = 0.0;         ///< x of the source, m
  double source_centre = 0.0;    ///< where the source's maximum starts, m from the left end
  double source_reach = 0.0;     ///< how far from its centre the source displaces what it acts on, m
  double source_duration = 0.0;  ///< of a driven edge, s
  double source_amplitude = 0.0; ///< m, with its sign
  double smallest_arrival = 0.05; ///< of the amplitude: what is smaller is no arrival
  double pulse_half_width = 0.0; ///< of the pulse that the source sends, s; 0: a released column, which sends none
  double pulse_width = 0.0;      ///< of the same pulse at half its height, s; likewise
  double period = 0.0;           ///< along x, m; 0: the strip has two ends
  double march_step = 0.0;       ///< of a march in time, s; 0: the signals are exact in time, or were not computed
  double sample_step = 0.0;      ///< what time.sample_every multiplies, s; 0: nothing does
  std::optional<FailedMeasurement> obstacle = std::nullopt;  ///< why nothing may be measured, whatever the signals hold
};

/// Where a source acts.
struct SourceStrip {
  double left_end = 0.0, length = 0.0, period = 0.0;  ///< m
  double edge_band = 0.0;                             ///< of the discs that a column or a drive displaces, m
};

/// Of a scene with a pulse or a drive; `speed` is the expected one, m/s.
WaveContext wave_context(const Scene& scene, const SourceStrip& strip, double speed);

/// From the first possible arrival to the last, and before the first reflection, at a probe.
Window causal_window(const WaveContext& context, double x);

/// When the top of the pulse is expected at x, s.
double time_of_top(const WaveContext& context, double x);

/// When the peak has passed x, with a margin of `margin` times the travel time: how long a run must last.
double time_of_passage(const WaveContext& context, double x, double margin);

}  // namespace ddem::harness
