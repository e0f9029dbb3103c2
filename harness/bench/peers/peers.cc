#include "harness/bench/peers/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/bench/kernels.h"
#include "harness/bench/lattice.h"
#include "harness/io/errors.h"
#include "harness/io/temporary_folder.h"

namespace ddem::harness::bench {
namespace {

constexpr double kAmplitude = 1e-6;    // of displacements, about, diameters: geometrically linear to about as much
constexpr double kStepFraction = 0.1;  // of the critical step

/// Neighbours start unlike each other, so that every bond is strained from the first step on and a wrong force shows.
ddem::InitialState struck(const ddem::Assembly& a, double unit_of_time) {
  const double speed = kAmplitude * 2.0 * kRadius / unit_of_time;
  ddem::InitialState state;
  for (std::size_t d = 0; d < a.size(); ++d) {
    const double place = static_cast<double>(d);
    state.vx.push_back(speed * std::cos(2.4 * place));
    state.vy.push_back(speed * std::sin(1.7 * place));
  }
  return state;
}

double difference(const PeerRun& peer, const ddem::InitialState& end) {
  double largest = 0.0, worst = 0.0;
  for (std::size_t d = 0; d < peer.ux.size(); ++d) {
    largest = std::max({largest, std::abs(end.ux[d]), std::abs(end.uy[d])});
    worst = std::max({worst, std::abs(peer.ux[d] - end.ux[d]), std::abs(peer.uy[d] - end.uy[d])});
  }
  return worst / largest;
}

SimulationResult run_ddem(const Peer& peer, const PeerScene& scene) {
  SimulationInput in;
  in.contact = rigid(peer.shear).contact;
  in.initial = scene.start;
  in.time_step = scene.time_step;
  in.steps = scene.steps;
  in.energy_samples = 0;
  return simulate(scene.assembly, in);
}

PeerTime compare(const Peer& peer, const std::string& version, const PeerSize& size) {
  const auto [columns, rows] = lattice_size(size.discs);
  const ddem::Assembly a = lattice(columns, rows);
  const TemporaryFolder folder("ddem-peer");
  PeerScene scene{a, {}, size.steps, lattice_step(kStepFraction), folder.path()};
  scene.start = struck(a, scene.unit_of_time());
  std::vector<double> theirs, ours, ratios;
  PeerTime time{peer.name, version, peer.law, a.size(), a.bonds.size(), size.steps, 0.0, 0.0, 0.0, 0.0};
  const double nanoseconds = 1e9 / (static_cast<double>(a.bonds.size()) * static_cast<double>(size.steps));
  for (int round = 0; round < size.rounds; ++round) {
    const PeerRun run = peer.run(peer.program, scene);
    const SimulationResult ddem = run_ddem(peer, scene);
    theirs.push_back(run.seconds * nanoseconds);
    ours.push_back(ddem.wall_seconds * nanoseconds);
    ratios.push_back(theirs.back() / ours.back());
    time.difference = difference(run, ddem.final_state);
  }
  time.nanoseconds_per_bond_step = median(theirs);
  time.ddem_nanoseconds_per_bond_step = median(ours);
  time.ratio = median(ratios);
  return time;
}

/// Empty if there is no such program.
std::optional<std::string> version_of(const Peer& peer) {
  try {
    return peer.version(peer.program);
  } catch (const MachineError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<PeerPlan> peer_plans() {
  return {{lammps(), {{682, 20000, 3}, {100000, 150, 3}, {1000000, 32, 2}}}, {yade(), {{682, 2000, 3}, {100000, 16, 2}, {1000000, 4, 1}}}};
}

Peers time_peers(const std::vector<PeerPlan>& plans, const std::function<void()>& progress) {
  Peers peers;
  for (const auto& [peer, sizes] : plans) {
    const auto version = version_of(peer);
    std::string reason;
    if (!version) reason = fmt::format("{} ({}) is not on the PATH; on Debian: sudo apt-get install {}", peer.program, peer.name, peer.package);
    for (const PeerSize& size : sizes) {
      if (reason.empty()) {
        try {
          peers.times.push_back(compare(peer, *version, size));
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
