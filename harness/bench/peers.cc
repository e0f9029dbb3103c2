#include "harness/bench/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>

#include "harness/bench/kernels.h"
#include "harness/bench/lattice.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/subprocess.h"
#include "harness/io/temporary_folder.h"

namespace ddem::harness::bench {
namespace {

constexpr double kAmplitude = 1e-6;     // of the displacement, diameters: geometrically linear to about as much
constexpr double kStepFraction = 0.1;   // of the critical step
constexpr double kDiameter = 2.0 * kRadius;

// LAMMPS is given diameters, disc masses and k_n as units: its tolerances and bins are made for numbers near 1.
double step_in_units() { return kStepFraction * 2.0 / std::sqrt(6.0); }

std::string input_text(long steps) {
  // E = K (r - r0)^2 with K = k_n/2. Lists of neighbours are never renewed: nothing but bonds acts.
  return fmt::format("units lj\ndimension 2\nboundary f f p\natom_style bond\nspecial_bonds lj 1 1 1\n"
                     "pair_style none\nbond_style harmonic\ncomm_modify cutoff 3.0\nneighbor 0.5 bin\n"
                     "neigh_modify delay 0 every 100000000 check no\nread_data strip.data\nbond_coeff 1 0.5 1.0\n"
                     "fix motion all nve\nfix plane all enforce2d\ntimestep {:.17g}\nthermo 100000000\nrun {}\n"
                     "write_dump all custom end.txt id x y modify sort id format float %.17g\n",
                     step_in_units(), steps);
}

std::string data_text(const ddem::Assembly& a, const ddem::InitialState& start) {
  std::string text = fmt::format("discs and bonds\n\n{} atoms\n{} bonds\n1 atom types\n1 bond types\n", a.size(), a.bonds.size());
  const double margin = 2.0;
  text += fmt::format("{} {} xlo xhi\n{} {} ylo yhi\n-0.5 0.5 zlo zhi\n\nMasses\n\n1 1.0\n\nAtoms\n\n", -margin,
                      a.packing.length / kDiameter + margin, -margin, a.packing.width / kDiameter + margin);
  for (std::size_t d = 0; d < a.size(); ++d) {
    text += fmt::format("{} 1 1 {:.17g} {:.17g} 0\n", d + 1, (a.packing.x[d] + start.ux[d]) / kDiameter, (a.packing.y[d] + start.uy[d]) / kDiameter);
  }
  text += "\nBonds\n\n";
  for (std::size_t b = 0; b < a.bonds.size(); ++b) text += fmt::format("{} 1 {} {}\n", b + 1, a.bonds.i[b] + 1, a.bonds.j[b] + 1);
  return text;
}

/// The displacement in both directions, a smooth wave over the lattice, m.
ddem::InitialState displaced(const ddem::Assembly& a) {
  ddem::InitialState state = smooth_state(a);
  double largest = 0.0;
  for (const auto* u : {&state.ux, &state.uy}) {
    for (const double value : *u) largest = std::max(largest, std::abs(value));
  }
  for (auto* u : {&state.ux, &state.uy}) {
    for (double& value : *u) value *= kAmplitude * kDiameter / largest;
  }
  state.theta.clear();
  return state;
}

struct Scene {
  const ddem::Assembly& assembly;
  ddem::InitialState start;
  const TemporaryFolder& folder;
};

struct LammpsRun {
  double seconds = 0.0;
  std::vector<double> x, y;  ///< at the end, m
};

/// What stands in a text between two marks; not empty.
std::optional<std::string_view> between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t mark = text.find(before);
  if (mark == std::string_view::npos) return std::nullopt;
  text.remove_prefix(mark + before.size());
  const std::size_t end = text.find(after);
  if (end == std::string_view::npos || end == 0) return std::nullopt;
  return text.substr(0, end);
}

/// All of it, finite.
std::optional<double> number_in(std::optional<std::string_view> text) {
  double value = 0.0;
  if (!text) return std::nullopt;
  const auto [rest, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc{} || rest != text->data() + text->size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Throws MachineError with what it said.
LammpsRun run_lammps(const std::string& program, const Scene& scene, long steps) {
  const auto& folder = scene.folder.path();
  write_file(folder / "in.strip", input_text(steps));
  const SubprocessResult run = run_program("/bin/sh", {"-c", "cd \"$1\" && exec \"$2\" -in in.strip -log none", "sh", folder.string(), program});
  const std::string& said = run.standard_output;
  const std::optional<double> seconds = number_in(between(said, "Loop time of ", " on"));
  if (!run.succeeded() || !seconds) {
    const std::string& last = run.standard_error.empty() ? said : run.standard_error;
    throw MachineError(program + ": " + run.status() + ": " + last.substr(last.size() - std::min<std::size_t>(last.size(), 300)));
  }
  LammpsRun result;
  result.seconds = *seconds;
  std::istringstream lines(read_file(folder / "end.txt"));
  std::string line;
  while (std::getline(lines, line) && !line.starts_with("ITEM: ATOMS")) {}
  for (double id, x, y; lines >> id >> x >> y;) result.x.push_back(x * kDiameter), result.y.push_back(y * kDiameter);
  if (result.x.size() != scene.assembly.size()) throw MachineError(program + ": its last positions cannot be read");
  return result;
}

double difference(const ddem::Assembly& a, const LammpsRun& lammps, const ddem::InitialState& end) {
  double largest = 0.0, worst = 0.0;
  for (std::size_t d = 0; d < a.size(); ++d) {
    largest = std::max({largest, std::abs(end.ux[d]), std::abs(end.uy[d])});
    worst = std::max({worst, std::abs(lammps.x[d] - a.packing.x[d] - end.ux[d]), std::abs(lammps.y[d] - a.packing.y[d] - end.uy[d])});
  }
  return worst / largest;
}

SimulationResult run_ddem(const Scene& scene, long steps) {
  SimulationInput in;
  in.contact = rigid(false).contact;
  in.initial = scene.start;
  in.time_step = lattice_step(kStepFraction);
  in.steps = steps;
  in.energy_samples = 1;
  return simulate(scene.assembly, in);
}

PeerTime compare(const std::string& program, const std::string& version, const PeerPlan& plan) {
  const auto [columns, rows] = lattice_size(plan.discs);
  const ddem::Assembly a = lattice(columns, rows);
  const TemporaryFolder folder("ddem-peer");
  const Scene scene{a, displaced(a), folder};
  write_file(folder.path() / "strip.data", data_text(a, scene.start));
  std::vector<double> theirs, ours, ratios;
  PeerTime time{"LAMMPS", version, "harmonic bonds, k_t = 0", a.size(), a.bonds.size(), plan.steps, 0.0, 0.0, 0.0, 0.0};
  const double nanoseconds = 1e9 / (static_cast<double>(a.bonds.size()) * static_cast<double>(plan.steps));
  for (int round = 0; round < plan.rounds; ++round) {
    const LammpsRun lammps = run_lammps(program, scene, plan.steps);
    const SimulationResult ddem = run_ddem(scene, plan.steps);
    theirs.push_back(lammps.seconds * nanoseconds);
    ours.push_back(ddem.wall_seconds * nanoseconds);
    ratios.push_back(theirs.back() / ours.back());
    time.difference = difference(a, lammps, ddem.final_state);
  }
  time.nanoseconds_per_bond_step = median(theirs);
  time.ddem_nanoseconds_per_bond_step = median(ours);
  time.ratio = median(ratios);
  return time;
}

/// The version's date from the head of its help; empty if there is no such program.
std::optional<std::string> version_of(const std::string& program) {
  SubprocessResult help;
  try {
    help = run_program(program, {"-h"});
  } catch (const MachineError&) {
    return std::nullopt;
  }
  return std::string(between(help.standard_output, "Simulator - ", "\n").value_or("version unknown"));
}

}  // namespace

std::vector<PeerPlan> peer_plans() { return {{682, 20000, 3}, {100000, 150, 3}, {1000000, 32, 2}}; }

Peers time_peers(const std::vector<PeerPlan>& plans, const std::function<void()>& progress, const std::string& program) {
  Peers peers;
  const auto version = version_of(program);
  if (!version) peers.reason = program + " (LAMMPS) is not on the PATH; on Debian: sudo apt-get install lammps";
  for (const PeerPlan& plan : plans) {
    if (peers.reason.empty()) {
      try {
        peers.times.push_back(compare(program, *version, plan));
      } catch (const MachineError& error) {
        peers.reason = error.what();
      }
    }
    progress();
  }
  return peers;
}

}  // namespace ddem::harness::bench
