#pragma once
// What a run keeps: signals of receivers, energies, and now and then all discs. Each looks at the stepper after a sweep,
// which then holds u_{n+1}.

#include <chrono>
#include <optional>
#include <vector>

#include "dem/simulation/audit.h"
#include "dem/simulation/simulation.h"
#include "dem/simulation/stepper.h"

namespace ddem {

/// Adds the time until its end to a sum: what looking at a run costs is not what the run costs.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class SignalRecorder {
 public:
  SignalRecorder(const SimulationInput& input, const Stepper& stepper);
  /// The state at the start, and of all steps of the last sweep.
  void sample_start();
  void after_sweep();
  Signals take() { return std::move(signals_); }

 private:
  void sample(long step, const double* motion, const std::vector<int>& at);

  const SimulationInput& input_;
  const Stepper& stepper_;
  std::vector<int> places_, slots_;  // of the receivers' discs, one receiver after the other
  Signals signals_;
};

/// Energies, and how well the leapfrog invariant holds from the end of the drive on.
class EnergyRecorder {
 public:
  EnergyRecorder(const Assembly& assembly, const SimulationInput& input, const Stepper& stepper);
  void after_step();
  /// The first step after the one at hand that must end a sweep.
  long next_step() const;
  std::optional<double> drift() const;
  double seconds() const { return seconds_; }
  std::vector<EnergySample> take() { return std::move(samples_); }

 private:
  std::optional<StateAudit> audit_;  ///< none where nothing is to be sampled
  const Stepper& stepper_;
  double time_step_ = 0.0;
  long every_ = 1, last_ = 0, undriven_ = 1;
  std::optional<double> reference_;
  double drift_ = 0.0, seconds_ = 0.0;
  std::vector<EnergySample> samples_;
};

class SnapshotRecorder {
 public:
  SnapshotRecorder(const Assembly& assembly, const SimulationInput& input, const Stepper& stepper);
  void after_step();
  long next_step() const;
  double seconds() const { return seconds_; }
  std::vector<Snapshot> take() { return std::move(snapshots_); }

 private:
  StateAudit audit_;
  const SimulationInput& input_;
  const Stepper& stepper_;
  double seconds_ = 0.0;
  std::vector<Snapshot> snapshots_;
};

}  // namespace ddem
