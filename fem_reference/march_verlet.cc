#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "fem_reference/excitation.h"
#include "fem_reference/march.h"
#include "fem_reference/receivers.h"
#include "fem_reference/sampling.h"
#include "fem_reference/snapshots.h"

namespace ddem::fem {
namespace {

constexpr std::uint64_t steps_between_checks = 64;
// Waves that meet at an edge or a corner double a few times; a thousand times the excitation is no wave.
constexpr double largest_amplification = 1e3;

// In all processes.
bool within(const StripModel& model, std::span<const double> u, double limit) {
  const bool here = std::all_of(u.begin(), u.end(),
                                [&](double value) { return std::abs(value) <= limit; });  // false for NaN
  if (!model.processes) return here;
  double beyond = here ? 0.0 : 1.0;
  model.processes->sum({&beyond, 1});
  return beyond == 0.0;
}

// Displacement that the excitation is worth, to tell a wave from an instability.
double excitation(const StripCase& strip, double end) {
  if (strip.drive) return std::abs(strip.drive->amplitude);
  const bool velocity = strip.initial->field == Field::velocity;
  return std::abs(strip.initial->amplitude) * (velocity ? end : 1.0);
}

Leapfrog start(const StripProblem& problem, double time_step) {
  const std::vector<double> nothing(problem.stiffness.vector_size(), 0.0);
  std::vector<double> displacement = nothing, velocity = nothing;
  if (const auto& pulse = problem.strip.initial) {
    (pulse->field == Field::velocity ? velocity : displacement) = initial_field(problem.strip, problem.model, *pulse);
  }
  return Leapfrog(problem.stiffness, problem.inverse_mass, {displacement, velocity}, time_step);
}

}  // namespace

void march_verlet(const StripProblem& problem, CaseResult& result) {
  const StripCase& strip = problem.strip;
  const StripModel& model = problem.model;
  const double dt = strip.time.step.value_or(strip.time.step_fraction * result.critical_time_step);
  result.time_step = dt;
  result.sample_interval = dt * static_cast<double>(strip.sample_every);
  const ReceiverReader receivers(model, problem.stiffness);
  const std::size_t values = receivers.values();
  const std::uint64_t steps = count_steps(strip, dt, values), samples = steps / strip.sample_every + 1;
  const double limit = largest_amplification * excitation(strip, static_cast<double>(steps) * dt);
  Leapfrog leapfrog = start(problem, dt);
  // The invariant joins two states: both must lie behind the end of the drive.
  const double still = strip.drive ? std::ceil(strip.drive->duration / dt) + 1.0 : 1.0;
  EnergyAudit audit(still <= static_cast<double>(steps) ? static_cast<std::uint64_t>(still) : steps + 1, steps);
  result.time.reserve(samples);
  result.time.push_back(0.0);
  result.signals.resize(samples * values);
  receivers.evaluate(leapfrog.displacement(), result.signals.data());
  SnapshotRecorder snapshots(strip, model, steps, result.fields);
  std::size_t good_samples = 1;
  double* row = nullptr;  // of the sample that this step is; else null
  const std::function<void(int)> look = [&](int thread) {
    if (row != nullptr) receivers.evaluate_share(thread, leapfrog.displacement(), row);
  };
  for (std::uint64_t step = 1; step <= steps; ++step) {
    row = step % strip.sample_every == 0 ? &result.signals[result.time.size() * values] : nullptr;
    leapfrog.step(look);
    if (strip.drive) {
      const double value = strip.drive->amplitude * motion(*strip.drive)(leapfrog.time());
      for (const std::uint32_t node : model.left_nodes) {
        leapfrog.prescribe(2 * node + component(strip.drive->wave), value);
      }
    }
    if (row != nullptr) {
      receivers.evaluate_rest(leapfrog.displacement(), row);
      result.time.push_back(leapfrog.time());
    }
    audit.watch(leapfrog);
    snapshots.watch(leapfrog);
    if (step % steps_between_checks != 0 && step != steps) continue;
    result.steps = step;
    if (!within(model, leapfrog.displacement(), limit)) {
      result.status = fmt::format("unstable: step {}", step);
      result.time.resize(good_samples);
      result.signals.resize(good_samples * values);
      result.fields = {};
      if (model.processes) model.processes->sum(result.signals);
      return;
    }
    good_samples = result.time.size();
  }
  if (model.processes) model.processes->sum(result.signals);
  result.energy_drift = audit.drift();
}

}  // namespace ddem::fem
