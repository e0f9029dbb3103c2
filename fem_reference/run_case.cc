#include "fem_reference/run_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <span>

#include "fem_reference/kernel/critical_step.h"
#include "fem_reference/kernel/leapfrog.h"

namespace ddem::fem {
namespace {

using std::numbers::pi;

constexpr double most_steps = 1e9;
constexpr double most_sample_bytes = 1e9;  // held twice, and one more time while the file is written
constexpr std::uint64_t steps_between_checks = 64;
constexpr std::uint64_t energies = 20;
// Waves that meet at an edge or a corner double a few times; a thousand times the excitation is no wave.
constexpr double largest_amplification = 1e3;

int component(Wave wave) {
  return wave == Wave::longitudinal ? 0 : 1;
}

double profile(const InitialPulse& pulse, double s) {
  switch (pulse.shape) {
    case Shape::column:
      return pulse.amplitude * std::max(0.0, 1.0 - s / pulse.spacing);
    case Shape::cosine:
      return s < pulse.width ? 0.5 * pulse.amplitude * (1.0 + std::cos(pi * s / pulse.width)) : 0.0;
    case Shape::gaussian:
      return pulse.amplitude * std::exp(-0.5 * std::pow((s - pulse.center) / pulse.width, 2));
  }
  return 0.0;
}

double drive_value(const EdgeDrive& drive, double t) {
  if (t >= drive.duration) return 0.0;
  const double sine = std::sin(pi * t / drive.duration);
  return drive.amplitude * sine * sine;
}

std::vector<double> inverse_mass(const StripCase& strip, const StripModel& model,
                                 const ElasticOperator& stiffness) {
  std::vector<double> inverse(stiffness.vector_size(), 0.0);
  for (std::size_t node = 0; node < stiffness.node_count(); ++node) {
    inverse[2 * node] = inverse[2 * node + 1] = 1.0 / stiffness.mass()[node];
  }
  for (const std::uint32_t node : model.right_nodes) {
    if (strip.right != RightEdge::free) inverse[2 * node] = 0.0;
    if (strip.right == RightEdge::fixed) inverse[2 * node + 1] = 0.0;
  }
  if (strip.drive) {
    for (const std::uint32_t node : model.left_nodes) inverse[2 * node + component(strip.drive->wave)] = 0.0;
  }
  return inverse;
}

std::uint64_t count_steps(const StripCase& strip, double time_step) {
  const double steps = strip.time.steps ? static_cast<double>(*strip.time.steps)
                                        : std::ceil(*strip.time.end / time_step - 1e-9);
  const double receivers =
      static_cast<double>(strip.receivers.points.size() + strip.receivers.sections.size());
  const double bytes =
      8.0 * (1.0 + 2.0 * receivers) * (steps / static_cast<double>(strip.sample_every) + 1.0);
  if (!(steps <= most_steps && bytes <= most_sample_bytes)) {
    throw CaseError(
        fmt::format("case \"{}\", time: {:.3g} steps of {:.3g} s make {:.3g} bytes of signals; {:.0e} "
                    "steps and {:.0e} bytes are the most",
                    strip.id, steps, time_step, bytes, most_steps, most_sample_bytes));
  }
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(steps));
}

class Recorder {
 public:
  Recorder(const StripModel& model, CaseResult& result, std::uint64_t samples)
      : model_(model), result_(result) {
    result.time.reserve(samples);
    result.points.reserve(samples * model.points.size() * 2);
    result.sections.reserve(samples * model.sections.size() * 2);
  }

  void record(double time, std::span<const double> u) {
    result_.time.push_back(time);
    for (const NodeWeights& weights : model_.points) evaluate(weights, u, result_.points);
    for (const NodeWeights& weights : model_.sections) evaluate(weights, u, result_.sections);
  }

  void keep_only(std::size_t samples) {
    result_.time.resize(samples);
    result_.points.resize(samples * model_.points.size() * 2);
    result_.sections.resize(samples * model_.sections.size() * 2);
  }

 private:
  static void evaluate(const NodeWeights& weights, std::span<const double> u, std::vector<double>& out) {
    double ux = 0.0, uy = 0.0;
    for (const auto& [node, weight] : weights) {
      ux += weight * u[2 * node];
      uy += weight * u[2 * node + 1];
    }
    out.push_back(ux);
    out.push_back(uy);
  }

  const StripModel& model_;
  CaseResult& result_;
};

// Largest relative change of the invariant at a few times of the run, from `first_step` on.
class EnergyAudit {
 public:
  EnergyAudit(std::uint64_t first_step, std::uint64_t steps)
      : next_(first_step),
        interval_(std::max<std::uint64_t>(1, (steps - std::min(steps, first_step)) / energies)) {}

  void watch(const Leapfrog& leapfrog) {
    if (leapfrog.steps_done() < next_) return;
    next_ += interval_;
    const double energy = leapfrog.energy();
    if (count_++ == 0) first_ = energy;
    largest_change_ = std::max(largest_change_, std::abs(energy - first_));
  }

  std::optional<double> drift() const {
    if (count_ < 2 || !(first_ > 0.0) || !std::isfinite(largest_change_)) return {};
    return largest_change_ / first_;
  }

 private:
  std::uint64_t next_, interval_, count_ = 0;
  double first_ = 0.0, largest_change_ = 0.0;
};

bool within(std::span<const double> u, double limit) {
  return std::all_of(u.begin(), u.end(),
                     [&](double value) { return std::abs(value) <= limit; });  // false for NaN
}

void march(const StripCase& strip, const StripModel& model, Leapfrog& leapfrog, CaseResult& result) {
  const double amplitude = std::abs(strip.initial ? strip.initial->amplitude : strip.drive->amplitude);
  const double dt = leapfrog.time_step();
  const std::uint64_t steps = count_steps(strip, dt);
  // The invariant joins two states: both must lie behind the end of the drive.
  const double still = strip.drive ? std::ceil(strip.drive->duration / dt) + 1.0 : 1.0;
  EnergyAudit audit(still < most_steps ? static_cast<std::uint64_t>(still) : steps + 1, steps);
  Recorder recorder(model, result, steps / strip.sample_every + 1);
  recorder.record(0.0, leapfrog.displacement());
  std::size_t good_samples = 1;
  for (std::uint64_t step = 1; step <= steps; ++step) {
    leapfrog.step();
    if (strip.drive) {
      const double value = drive_value(*strip.drive, leapfrog.time());
      for (const std::uint32_t node : model.left_nodes) {
        leapfrog.prescribe(2 * node + component(strip.drive->wave), value);
      }
    }
    if (step % strip.sample_every == 0) recorder.record(leapfrog.time(), leapfrog.displacement());
    audit.watch(leapfrog);
    if (step % steps_between_checks != 0 && step != steps) continue;
    result.steps = step;
    if (!within(leapfrog.displacement(), largest_amplification * amplitude)) {
      result.status = fmt::format("unstable: step {}", step);
      recorder.keep_only(good_samples);
      return;
    }
    good_samples = result.time.size();
  }
  result.energy_drift = audit.drift();
}

}  // namespace

std::vector<double> initial_displacement(const StripCase& strip, const StripModel& model) {
  std::vector<double> u(2 * (model.mesh.node_count + 1), 0.0);
  if (!strip.initial) return u;
  for (std::size_t node = 0; node < model.mesh.node_count; ++node) {
    u[2 * node + component(strip.initial->wave)] = profile(*strip.initial, model.x[node]);
  }
  for (const std::uint32_t node : model.right_nodes) {
    if (strip.right != RightEdge::free) u[2 * node] = 0.0;
    if (strip.right == RightEdge::fixed) u[2 * node + 1] = 0.0;
  }
  return u;
}

CaseResult run_case(const StripCase& strip, const StripModel& model) {
  const auto start = std::chrono::steady_clock::now();
  const PlaneMaterial material =
      plane_material(strip.young_modulus, strip.poisson_ratio, strip.density, strip.plane);
  const ElasticOperator stiffness(model.mesh, material);
  const std::vector<double> inverse = inverse_mass(strip, model, stiffness);
  CaseResult result;
  result.dofs = 2 * stiffness.node_count();
  result.critical_time_step = critical_time_step(stiffness, inverse);
  result.time_step = strip.time.step_fraction * result.critical_time_step;
  Leapfrog leapfrog(stiffness, inverse, initial_displacement(strip, model), result.time_step);
  march(strip, model, leapfrog, result);
  result.solve_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace ddem::fem
