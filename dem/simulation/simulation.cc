#include "dem/simulation/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <numbers>
#include <stdexcept>
#include <string>

#include "dem/core/team.h"
#include "dem/simulation/recorders.h"
#include "dem/simulation/stepper.h"
#include "dem/spectra/spectra.h"

namespace ddem {
namespace {

constexpr long kCheckEvery = 16;     // steps between looks at divergence
constexpr std::size_t kLeastShare = 2000;  // discs a thread: a sweep of them takes longer than to meet at its end
constexpr double kDivergence = 1e3;  // times the largest displacement that the load can have put in

/// A degree of freedom that is held does not move, not even at first.
void check_rest(const std::vector<std::uint8_t>& held, const std::vector<double>& velocity, const char* component) {
  for (std::size_t d = 0; d < std::min(held.size(), velocity.size()); ++d) {
    if (held[d] && velocity[d] != 0.0)
      throw std::invalid_argument("disc " + std::to_string(d) + " is held, but starts with a velocity " + component);
  }
}

double largest(const std::vector<double>& v) {
  double m = 0.0;
  for (const double x : v) m = std::max(m, std::abs(x));
  return m;
}

/// No stable run exceeds this by much: what was put in at the start, by the drive, or by the initial velocities.
double divergence_bound(const SimulationInput& in) {
  const double start = std::hypot(largest(in.initial.ux), largest(in.initial.uy));
  const double drive = in.drive ? std::abs(in.drive->amplitude) : 0.0;
  const double speed = std::hypot(largest(in.initial.vx), largest(in.initial.vy));
  const double bound = start + drive + speed * in.time_step * static_cast<double>(in.steps);
  return bound > 0.0 ? kDivergence * bound : HUGE_VAL;
}

/// What happens between two stages and steps, on one thread; returns false to stop.
class Overseer {
 public:
  Overseer(const Assembly& a, const SimulationInput& in, Stepper& stepper, SimulationResult& result)
      : in_(in), stepper_(stepper), result_(result), recorder_(in, stepper), energies_(a, in, stepper),
        snapshots_(a, in, stepper), bound_(divergence_bound(in)), report_every_(std::max<long>(kCheckEvery, in.steps / 200)) {
    recorder_.sample_start();
    stepper_.take_steps(steps_to_take());
  }

  bool finish_stage() {
    if (!stepper_.finish_stage()) {
      result_.breakdown = stepper_.breakdown();
      return !result_.breakdown;
    }
    const long n = stepper_.step();
    if (n % kCheckEvery == 0 || n == in_.steps) {
      if (const int disc = stepper_.diverged_disc(bound_); disc >= 0) {
        result_.breakdown = Breakdown{Breakdown::Cause::diverged, n, disc};
        return false;
      }
    }
    recorder_.after_sweep();
    energies_.after_step();
    snapshots_.after_step();
    if (in_.on_progress && n % report_every_ == 0 &&
        !in_.on_progress(static_cast<double>(n) / static_cast<double>(in_.steps))) {
      result_.stopped = true;
      return false;
    }
    stepper_.take_steps(steps_to_take());
    return n < in_.steps;
  }

  void finish() {
    result_.signals = recorder_.take();
    result_.energy_drift = energies_.drift();
    result_.energy = energies_.take();
    result_.snapshots = snapshots_.take();
    result_.wall_seconds -= energies_.seconds() + snapshots_.seconds();
    result_.steps_done = stepper_.step();
    result_.final_state = stepper_.state();
    result_.new_contacts = stepper_.new_contacts();
    if (result_.new_contacts && !result_.breakdown) result_.new_contacts->critical_time_step = 2.0 / largest_frequency(stepper_.all_closed(), in_.contact, in_.held);
  }

 private:
  /// As many as a sweep may take before somebody wants to look at the discs.
  int steps_to_take() const {
    const int most = stepper_.steps_at_once();
    if (most == 1) return 1;
    const long n = stepper_.step(), check = (n / kCheckEvery + 1) * kCheckEvery;
    const long report = in_.on_progress ? (n / report_every_ + 1) * report_every_ : in_.steps;
    const long next = std::min({check, report, in_.steps, energies_.next_step(), snapshots_.next_step()});
    return static_cast<int>(std::clamp<long>(next - n, 1, most));
  }

  const SimulationInput& in_;
  Stepper& stepper_;
  SimulationResult& result_;
  SignalRecorder recorder_;
  EnergyRecorder energies_;
  SnapshotRecorder snapshots_;
  double bound_;
  long report_every_;
};

/// Every thread sweeps a range of slices; the last one to be done finishes the stage. What that throws is thrown here.
void run(Stepper& stepper, Overseer& overseer) {
  bool go_on = true;
  std::exception_ptr failure;
  const auto finish = [&] {
    try {
      go_on = overseer.finish_stage();
    } catch (...) {
      failure = std::current_exception();
      go_on = false;
    }
  };
  Team team(stepper.threads());
  team.run([&](int id) {
    do {
      stepper.advance(id);
      team.meet(id, finish);
    } while (go_on);
  });
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

double EdgeDrive::displacement(double time) const {
  if (time < 0.0 || time >= duration) return 0.0;
  const double s = std::sin(std::numbers::pi * time / duration);
  return amplitude * s * s;
}

void check_input(const Assembly& a, const SimulationInput& in) {
  if (!(in.time_step > 0.0)) throw std::invalid_argument("the time step must be positive");
  if (in.steps < 0) throw std::invalid_argument("the number of steps must not be negative");
  if (in.energy_samples < 0 || in.snapshots < 0) throw std::invalid_argument("energy_samples and snapshots must not be negative");
  if (in.sample_every < 1) throw std::invalid_argument("sample_every must be at least 1");
  const DeformationParameters& deformation = in.deformation;
  if (deformation.evaluations < 1) throw std::invalid_argument("evaluations must be at least 1");
  if (!(deformation.relaxation > 0.0 && deformation.relaxation <= 1.0)) throw std::invalid_argument("relaxation must be in (0, 1]");
  if (deformation.scheme == Scheme::implicit && in.contact.kinematics == Kinematics::nonlinear) {
    throw std::invalid_argument("implicit particle strains need linear kinematics");
  }
  if (in.threads < 1) throw std::invalid_argument("threads must be at least 1");
  for (const auto* v : {&in.initial.ux, &in.initial.uy, &in.initial.theta, &in.initial.vx, &in.initial.vy, &in.initial.omega}) {
    if (!v->empty() && v->size() != a.size()) throw std::invalid_argument("an initial state has not one value a disc");
  }
  for (const auto* v : {&in.held.x, &in.held.y, &in.held.theta}) {
    if (!v->empty() && v->size() != a.size()) throw std::invalid_argument("a mask of held discs has not one value a disc");
  }
  check_rest(in.held.x, in.initial.vx, "vx");
  check_rest(in.held.y, in.initial.vy, "vy");
  check_rest(in.held.theta, in.initial.omega, "omega");
  const auto check_discs = [&](const std::vector<int>& discs) {
    if (discs.empty()) throw std::invalid_argument("a receiver or a driven edge has no disc");
    for (const int d : discs) {
      if (d < 0 || d >= static_cast<int>(a.size())) throw std::invalid_argument("disc index out of range");
    }
  };
  for (const Receiver& r : in.receivers) check_discs(r.discs);
  if (in.drive) check_discs(in.drive->discs);
}

int worthwhile_threads(int threads, std::size_t discs) { return std::max(1, std::min(threads, static_cast<int>(discs / kLeastShare))); }

SimulationResult simulate(const Assembly& assembly, const SimulationInput& input) {
  check_input(assembly, input);
  SimulationResult result;
  Stepper stepper(assembly, input, best_instruction_set());
  Overseer overseer(assembly, input, stepper, result);
  const auto start = std::chrono::steady_clock::now();
  if (input.steps > 0) run(stepper, overseer);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  overseer.finish();
  return result;
}

}  // namespace ddem
