#pragma once
// One DEM or DDEM simulation of a scene, from file to wave speed: what `ddem run` does and a campaign repeats.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dem/simulation/simulation.h"
#include "harness/model/probes.h"
#include "harness/run/measure_wave.h"
#include "harness/scene/scene.h"
#include "harness/solvers/solver.h"

namespace ddem::harness {

struct DemRun {
  ddem::Assembly assembly;
  ProbeLayout layout;
  std::optional<Wave> wave;
  WaveContext context;
  double critical_time_step = 0.0;
  double time_step = 0.0;        ///< of the march, s
  double sample_interval = 0.0;  ///< of the signals, s
  SimulationResult result;
  std::optional<WaveMeasurement> measurement;  ///< empty where there are no pairs or the run diverged
  std::vector<std::string> warnings;
};

struct RunOptions {
  /// The static speed where the caller knows it (m/s): narrows the windows and the run time. Else the kinematic estimate.
  std::optional<double> expected_speed;
  std::function<bool(double)> on_progress;
  std::function<void(std::string)> on_stage = {};  ///< what is worked on: packing, limits, simulating
  int energy_samples = 8;   ///< of the energies over time: enough for their drift, and an audit costs as much as ten steps
  int snapshots = 0;        ///< of all discs, over the run
  bool as_text = false;     ///< the signals will be written as CSV: of their memory alone
  bool warn = true;         ///< of short pulses, crystallised packings, and instability that theory predicts; costs more than a short run
  /// Of the assembly, or a smaller one (s), where the caller knows it: finding it takes as long as some hundred steps.
  std::optional<double> critical_time_step = std::nullopt;
  /// See SimulationInput::relaxations.
  std::vector<double> relaxations = {};
  /// One that is not exact in time takes the scene's steps instead; one that has no energies is not asked for them.
  const Solver* solver = &builtin_solver();
};

/// What happened, for people: "the run diverged", and what to do about it.
struct BreakdownText {
  std::string what, advice;
};
BreakdownText describe(const Breakdown& breakdown, const Scene& scene);

/// Throws InputError (scene). A divergence is not an exception but in result.breakdown.
DemRun run_scene(const Scene& scene, const RunOptions& options = {});
/// The same with an assembly made otherwise than from scene.assembly.
DemRun run_assembly(const Scene& scene, ddem::Assembly assembly, const RunOptions& options = {});

/// A run that a solver has not made yet: what it is given, and what its signals are measured by.
struct PreparedRun {
  DemRun run;  ///< without a result
  SimulationInput input;
  bool load_is_doubtful = false;  ///< a warning has been given
};
/// Throws InputError. run_assembly() is prepare_run(), the solver, and finish_run().
PreparedRun prepare_run(const Scene& scene, ddem::Assembly assembly, const RunOptions& options = {});
/// Measures what the solver found; `warn` as in RunOptions.
DemRun finish_run(const Scene& scene, PreparedRun prepared, SimulationResult result, bool warn = true);

/// The component of the signals that carries the wave.
const std::vector<std::vector<double>>& wave_component(const Signals& signals, Wave wave);

}  // namespace ddem::harness
