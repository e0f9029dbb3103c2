#include "harness/bench/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/bench/assemblies.h"
#include "harness/bench/kernels.h"
#include "harness/io/errors.h"
#include "harness/measure/median.h"

namespace ddem::harness::bench {
namespace {

constexpr double kPeerAmplitude = 1e-6;    // of displacements, about, diameters: geometrically linear to about as much
constexpr double kPeerStepFraction = 0.1;  // of the critical step

/// Neighbours start unlike each other, so that every bond is strained from the first step on and a wrong force shows.
ddem::InitialState struck(const ddem::Assembly& a, double unit_of_time) {
  const double speed = kPeerAmplitude * 2.0 * kRadius / unit_of_time;
  ddem::InitialState state;
  for (std::size_t d = 0; d < a.size(); ++d) {
    const double place = static_cast<double>(d);
    state.vx.push_back(speed * std::cos(2.4 * place));
    state.vy.push_back(speed * std::sin(1.7 * place));
  }
  return state;
}

/// Of the last displacements.
double difference(const Signals& theirs, const ddem::InitialState& ours) {
  double largest = 0.0, worst = 0.0;
  for (std::size_t d = 0; d < ours.ux.size(); ++d) {
    largest = std::max({largest, std::abs(ours.ux[d]), std::abs(ours.uy[d])});
    worst = std::max({worst, std::abs(theirs.ux[d].back() - ours.ux[d]), std::abs(theirs.uy[d].back() - ours.uy[d])});
  }
  return worst / largest;
}

SimulationInput input_of(const ddem::Assembly& a, bool shear, long steps) {
  SimulationInput in;
  in.contact = rigid(shear).contact;
  in.initial = struck(a, std::sqrt(a.mass.front() / in.contact.normal_stiffness));
  in.time_step = lattice_step(kPeerStepFraction);
  in.steps = in.sample_every = steps;
  in.energy_samples = 0;
  return in;
}

/// `in` with every disc as a receiver.
SimulationInput all_recorded(SimulationInput in, std::size_t discs) {
  for (std::size_t d = 0; d < discs; ++d) in.receivers.push_back({{static_cast<int>(d)}});
  return in;
}

PeerTime compare(const PeerPlan& plan, const Solver& peer, const PeerSize& size) {
  const auto [columns, rows] = lattice_size(size.discs);
  const ddem::Assembly a = lattice(columns, rows);
  const SimulationInput in = input_of(a, plan.shear, size.steps), recorded = all_recorded(in, a.size());
  std::vector<double> theirs, ours, ratios;
  PeerTime time{plan.name, peer.version(), plan.law, a.size(), a.bonds.size(), size.steps, 0.0, 0.0, 0.0, 0.0};
  const double nanoseconds = 1e9 / (static_cast<double>(a.bonds.size()) * static_cast<double>(size.steps));
  for (int round = 0; round < size.rounds; ++round) {
    const SimulationResult run = peer.solve(a, recorded);
    const SimulationResult ddem = simulate(a, in);
    theirs.push_back(run.wall_seconds * nanoseconds);
    ours.push_back(ddem.wall_seconds * nanoseconds);
    ratios.push_back(theirs.back() / ours.back());
    time.difference = difference(run.signals, ddem.final_state);
  }
  time.nanoseconds_per_bond_step = median(theirs);
  time.ddem_nanoseconds_per_bond_step = median(ours);
  time.ratio = median(ratios);
  return time;
}

}  // namespace

std::vector<PeerPlan> peer_plans() {
  return {{"LAMMPS", "harmonic bonds, k_t = 0", false, "lmp", "lammps", lammps_solver, {{682, 20000, 3}, {100000, 150, 3}, {1000000, 32, 2}}},
          {"Yade", "cohesive bonds, k_t and rotations", true, "yade", "yade", yade_solver, {{682, 2000, 3}, {100000, 16, 2}, {1000000, 4, 1}}}};
}

Peers time_peers(const std::vector<PeerPlan>& plans, const std::function<void()>& progress) {
  Peers peers;
  for (const PeerPlan& plan : plans) {
    std::string reason;
    std::shared_ptr<const Solver> peer;
    try {
      peer = plan.solver({plan.program, 1});
    } catch (const MachineError& error) {
      reason = fmt::format("{} ({}) is not on the PATH, or does not start; on Debian: sudo apt-get install {} ({})", plan.program, plan.name, plan.package, error.what());
    }
    for (const PeerSize& size : plan.sizes) {
      if (reason.empty()) {
        try {
          peers.times.push_back(compare(plan, *peer, size));
        } catch (const MachineError& error) {
          reason = error.what();
        }
      }
      progress();
    }
    if (!reason.empty()) peers.reason += (peers.reason.empty() ? "" : "; ") + reason;
  }
  return peers;
}

}  // namespace ddem::harness::bench
