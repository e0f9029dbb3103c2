#include "dem/simulation/recorders.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddem {
namespace {

constexpr long kNever = std::numeric_limits<long>::max();

}  // namespace

SignalRecorder::SignalRecorder(const SimulationInput& input, const Stepper& stepper) : input_(input), stepper_(stepper) {
  const std::size_t receivers = input.receivers.size(), samples = static_cast<std::size_t>(input.steps / input.sample_every + 1);
  signals_.time.reserve(samples);
  for (auto* s : {&signals_.ux, &signals_.uy, &signals_.theta}) {
    s->resize(receivers);
    for (auto& values : *s) values.reserve(samples);
  }
  for (const Receiver& r : input.receivers) {
    for (const int disc : r.discs) {
      places_.push_back(stepper.place_of(disc));
      slots_.push_back(stepper.taps().slot_of(places_.back()));
    }
  }
}

void SignalRecorder::sample_start() { sample(0, stepper_.data().motion, places_); }

void SignalRecorder::after_sweep() {
  const int steps = stepper_.steps_taken();
  if (steps == 1) return sample(stepper_.step(), stepper_.data().motion, places_);
  for (int level = 0; level < steps; ++level) sample(stepper_.step() - steps + level + 1, stepper_.taps().values(level), slots_);
}

void SignalRecorder::sample(long step, const double* motion, const std::vector<int>& at) {
  if (step % input_.sample_every != 0) return;
  const MotionView u{motion};
  signals_.time.push_back(static_cast<double>(step) * input_.time_step);
  auto next = at.begin();
  for (std::size_t r = 0; r < input_.receivers.size(); ++r) {
    double ux = 0.0, uy = 0.0, theta = 0.0;
    for (const int disc : input_.receivers[r].discs) {
      const int p = *next++;
      ux += u.ux(p);
      uy += u.uy(p);
      if (input_.contact.has_rotation()) theta += u.theta(p, stepper_.radius(disc));
    }
    const double n = static_cast<double>(input_.receivers[r].discs.size());
    signals_.ux[r].push_back(ux / n);
    signals_.uy[r].push_back(uy / n);
    signals_.theta[r].push_back(theta / n);
  }
}

EnergyRecorder::EnergyRecorder(const Assembly& a, const SimulationInput& in, const Stepper& s)
    : stepper_(s), time_step_(in.time_step), last_(in.steps) {
  if (in.contact.kinematics != Kinematics::linear || in.energy_samples == 0) return;
  audit_.emplace(a, in.contact, in.deformation, s.order());
  every_ = std::max<long>(1, in.steps / in.energy_samples);
  // A drive beyond the end of the run, by however much, has no step after it.
  if (in.drive) undriven_ = static_cast<long>(std::ceil(std::min(in.drive->duration / in.time_step, static_cast<double>(last_)))) + 1;
}

void EnergyRecorder::after_step() {
  const long n = stepper_.step();
  const bool first_undriven = !reference_ && n >= undriven_;
  if (!audit_ || !(first_undriven || n % every_ == 0 || n == last_)) return;
  const Stopwatch watch(seconds_);
  const AlignedVector<double> before = stepper_.motion_before();
  const Energies e = audit_->energies({{before.data()}, {stepper_.data().motion}, stepper_.velocities(), stepper_.strains_in_use(), stepper_.contacts_in_use()});
  samples_.push_back({static_cast<double>(n - 1) * time_step_, e});
  if (n < undriven_) return;
  if (!reference_) {
    reference_ = e.invariant;
  } else if (*reference_ > 0.0) {
    drift_ = std::max(drift_, std::abs(e.invariant / *reference_ - 1.0));
  }
}

long EnergyRecorder::next_step() const {
  const long n = stepper_.step();
  if (!audit_) return kNever;
  const long regular = (n / every_ + 1) * every_, next = std::min(regular, last_);
  return reference_ || undriven_ <= n ? next : std::min(next, undriven_);
}

std::optional<double> EnergyRecorder::drift() const {
  return reference_ && std::isfinite(drift_) ? std::optional(drift_) : std::nullopt;
}

SnapshotRecorder::SnapshotRecorder(const Assembly& a, const SimulationInput& in, const Stepper& s)
    : audit_(a, in.contact, in.deformation, s.order()), input_(in), stepper_(s) {}

void SnapshotRecorder::after_step() {
  // Snapshot k of m comes after step k steps / m.
  const long taken = static_cast<long>(snapshots_.size());
  if (taken >= input_.snapshots || stepper_.step() * input_.snapshots < (taken + 1) * input_.steps) return;
  const Stopwatch watch(seconds_);
  const AlignedVector<double> before = stepper_.motion_before();
  const MotionView u{before.data()};
  const StrainView e = stepper_.strains_in_use();
  Snapshot s;
  s.time = static_cast<double>(stepper_.step() - 1) * input_.time_step;
  s.state = stepper_.state_of(u.values);
  if (input_.contact.kinematics == Kinematics::linear) s.stress = audit_.stress(u, e, stepper_.contacts_in_use());
  if (input_.deformation.active()) {
    const auto component = [&](int k) { return stepper_.over_radius(e.values + k, kQuad); };
    s.strain = {component(0), component(1), component(2)};
  }
  snapshots_.push_back(std::move(s));
}

long SnapshotRecorder::next_step() const {
  const long taken = static_cast<long>(snapshots_.size());
  if (taken >= input_.snapshots) return kNever;
  return ((taken + 1) * input_.steps + input_.snapshots - 1) / input_.snapshots;
}

}  // namespace ddem
