#pragma once
// The signals of any program that has run a scene, measured as those of the built-in solver: the same windows, picks and reasons.

#include "harness/io/signals_csv.h"
#include "harness/run/dem_run.h"
#include "harness/run/scene_moduli.h"

namespace ddem::harness {

struct MeasuredSignals {
  DemRun run;                          ///< result.signals are those of the table; nothing else of the result is known
  SceneModuli moduli;                  ///< static, of the same assembly
  std::optional<double> static_speed;  ///< of the scene's wave, m/s
  std::vector<Outcome<PhaseVelocity>> phase_velocities;  ///< one a pair
};

/// Columns as DemRun's probes are named, in any order; equal times from 0 on, whatever their interval. `path` is for messages.
/// Throws InputError on other times and missing columns, and where the scene has no pairs of probes or sends no wave.
MeasuredSignals measure_signals(const Scene& scene, const SignalTable& table, const std::string& path);

}  // namespace ddem::harness
