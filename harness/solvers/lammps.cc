// LAMMPS: harmonic bonds, which is the particle method without shear stiffness; with the geometry of the moment, so that it agrees
// with linear kinematics to the order of the amplitude. In units of the mean diameter, the mean mass of a disc and the stiffest bond,
// as its bins and tolerances are made for numbers near 1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>

#include "dem/assembly/bond_stiffness.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/solvers/lammps_dump.h"
#include "harness/solvers/ready.h"
#include "harness/solvers/reduced.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

/// Types by value: what agrees to the last digits but two is one type.
class Types {
 public:
  int of(std::vector<double> values) {
    std::vector<long long> key;
    for (const double v : values) key.push_back(std::llround(v * 1e13));
    const auto [place, is_new] = number_.try_emplace(std::move(key), static_cast<int>(values_.size()) + 1);
    if (is_new) values_.push_back(std::move(values));
    return place->second;
  }
  const std::vector<std::vector<double>>& values() const { return values_; }

 private:
  std::map<std::vector<long long>, int> number_;
  std::vector<std::vector<double>> values_;
};

class Input {
 public:
  explicit Input(const Exchange& e) : e_(e), k_n_(normal_stiffnesses(e.assembly, e.input.contact)), units_(reduced_units(e, k_n_)) {}

  std::string data() {
    const ddem::Assembly& a = e_.assembly;
    const Packing& p = a.packing;
    const ddem::InitialState& s = e_.input.initial;
    const auto at = [](const std::vector<double>& v, std::size_t d) { return v.empty() ? 0.0 : v[d]; };
    fmt::memory_buffer atoms, velocities, bonds;
    Types masses;
    for (std::size_t d = 0; d < a.size(); ++d) {
      const double x = p.x[d] + at(s.ux, d), y = p.y[d] + at(s.uy, d);
      write(atoms, "{} 1 {} {:.17g} {:.17g} 0\n", d + 1, masses.of({a.mass[d] / units_.mass}), x / units_.length, y / units_.length);
      write(velocities, "{} {:.17g} {:.17g} 0\n", d + 1, at(s.vx, d) / units_.speed(), at(s.vy, d) / units_.speed());
    }
    for (std::size_t b = 0; b < a.bonds.size(); ++b) {
      // E = K (r - r0)^2 with K = k_n/2.
      const int type = bond_types_.of({0.5 * k_n_[b] / units_.stiffness, a.bonds.length[b] / units_.length});
      write(bonds, "{} {} {} {}\n", b + 1, type, a.bonds.i[b] + 1, a.bonds.j[b] + 1);
    }
    fmt::memory_buffer all;
    write(all, "discs and bonds\n\n{} atoms\n{} bonds\n{} atom types\n{} bond types\n{} xlo xhi\n{} ylo yhi\n-0.5 0.5 zlo zhi\n\nMasses\n\n", a.size(),
          a.bonds.size(), masses.values().size(), bond_types_.values().size(), limits(p.x, p.period.x), limits(p.y, p.period.y));
    for (std::size_t t = 0; t < masses.values().size(); ++t) write(all, "{} {:.17g}\n", t + 1, masses.values()[t][0]);
    const auto text = [](const fmt::memory_buffer& b) { return std::string_view(b.data(), b.size()); };
    write(all, "\nAtoms\n\n{}\nVelocities\n\n{}\nBonds\n\n{}", text(atoms), text(velocities), text(bonds));
    return std::string(text(all));
  }

  /// After data(), which numbers the types of bonds.
  std::string commands() const {
    const SimulationInput& in = e_.input;
    const Packing& p = e_.assembly.packing;
    const double longest = e_.assembly.bonds.size() == 0 ? 0.0 : *std::ranges::max_element(e_.assembly.bonds.length) / units_.length;
    fmt::memory_buffer text;
    // Lists of neighbours are never renewed: nothing but bonds acts.
    write(text, "units lj\ndimension 2\nboundary {} {} p\natom_style bond\nspecial_bonds lj 1 1 1\npair_style none\nbond_style harmonic\n"
                "comm_modify cutoff {:.6g}\nneighbor 0.5 bin\nneigh_modify delay 0 every 100000000 check no\nread_data strip.data\n",
          p.period.x > 0.0 ? "p" : "f", p.period.y > 0.0 ? "p" : "f", std::max(3.0, 1.5 * longest));
    for (std::size_t t = 0; t < bond_types_.values().size(); ++t)
      write(text, "bond_coeff {} {:.17g} {:.17g}\n", t + 1, bond_types_.values()[t][0], bond_types_.values()[t][1]);
    const double dt = in.time_step / units_.time();
    write(text, "timestep {:.17g}\n", dt);
    write_group(text, "driven", in.drive ? in.drive->discs : std::vector<int>());
    write(text, "group free subtract all driven\nfix motion free nve\n");
    if (in.drive) write_drive(text, dt);
    write_held(text, "held_x", in.held.x, "0.0 NULL NULL");
    write_held(text, "held_y", in.held.y, "NULL 0.0 NULL");
    write_group(text, "recorded", recorded_discs(in));
    write(text, "fix plane all enforce2d\nthermo 100000000\ndump all recorded custom {} motion.txt id xu yu\n"
                "dump_modify all sort id format float %.17g\nrun {}\n",
          in.sample_every, in.steps);
    return {text.data(), text.size()};
  }

  const ReducedUnits& units() const { return units_; }

 private:
  template <class... Args>
  static void write(fmt::memory_buffer& to, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(to), format, std::forward<Args>(args)...);
  }

  /// Of the box: a period, or far from all discs.
  std::string limits(const std::vector<double>& places, double period) const {
    if (period > 0.0) return fmt::format("0 {:.17g}", period / units_.length);
    const auto [least, most] = std::ranges::minmax_element(places);
    return fmt::format("{:.17g} {:.17g}", *least / units_.length - 3.0, *most / units_.length + 3.0);
  }

  static void write_group(fmt::memory_buffer& text, const std::string& name, const std::vector<int>& discs) {
    write(text, "group {} empty\n", name);
    int on_line = 0;
    for (const int d : discs) {
      if (on_line++ % 50 == 0) write(text, "{}group {} id", on_line > 1 ? "\n" : "", name);
      write(text, " {}", d + 1);
    }
    write(text, "\n");
  }

  static void write_held(fmt::memory_buffer& text, const std::string& name, const std::vector<std::uint8_t>& held, const char* force) {
    std::vector<int> discs;
    for (std::size_t d = 0; d < held.size(); ++d) {
      if (held[d] != 0) discs.push_back(static_cast<int>(d));
    }
    write_group(text, name, discs);
    if (!discs.empty()) write(text, "fix {0} {0} setforce {1}\n", name, force);
  }

  /// A sin^2(pi t/T) from where the discs are at first, then nothing; their other direction is free.
  void write_drive(fmt::memory_buffer& text, double dt) const {
    const EdgeDrive& drive = *e_.input.drive;
    const double duration = drive.duration / units_.time(), amplitude = drive.amplitude / units_.length;
    write(text, "variable phase equal \"step * {0:.17g} / {1:.17g}\"\nvariable moved equal \"{2:.17g} * sin(PI * v_phase)^2 * (v_phase < 1)\"\n"
                "variable speed equal \"0\"\n",
          dt, duration, amplitude);
    const bool x = drive.direction == Direction::x;
    write(text, "fix drive driven move variable {} {} NULL {} {} NULL\n", x ? "v_moved" : "NULL", x ? "NULL" : "v_moved", x ? "v_speed" : "NULL",
          x ? "NULL" : "v_speed");
  }

  const Exchange& e_;
  std::vector<double> k_n_;
  ReducedUnits units_;
  Types bond_types_;
};

void write_lammps_input(const fs::path& folder, const Exchange& e) {
  Input input(e);
  write_file(folder / "strip.data", input.data());
  write_file(folder / "in.strip", input.commands());
}

/// The positions of a dump, frame by frame, as displacements averaged over receivers.
SimulationResult read_motion(const fs::path& folder, const Exchange& e, const std::string& printed) {
  SimulationResult result;
  result.wall_seconds = number_between(printed, "Loop time of ", " on");
  const Packing& p = e.assembly.packing;
  const double unit = Input(e).units().length;
  SampleMaker samples(e.input);
  std::vector<double> ux(p.size(), 0.0), uy(p.size(), 0.0);
  const std::vector<double> theta(p.size(), 0.0);
  const auto take = [&](std::size_t d, std::span<const double> position) {
    ux[d] = position[0] * unit - p.x[d];
    uy[d] = position[1] * unit - p.y[d];
  };
  read_dump(folder / "motion.txt", p.size(), 2, take, [&] { samples.add(ux, uy, theta); });
  result.signals = samples.take();
  return result;
}

std::string beyond_lammps(const ddem::Assembly&, const SimulationInput& in) { return in.contact.has_rotation() ? "shear stiffness: its bonds are springs" : ""; }

}  // namespace

std::vector<std::string> launcher(int ranks) {
  if (ranks <= 1) return {};
  if (std::getenv("SLURM_JOB_ID") != nullptr) return {"srun", "--ntasks={ranks}"};
  return {"mpirun", "--oversubscribe", "-np", "{ranks}"};
}

std::shared_ptr<const Solver> lammps_solver(const ReadyOptions& o) {
  SolverDescription d;
  d.name = "lammps";
  const std::string program = o.program.empty() ? "lmp" : o.program;
  d.ranks = o.ranks;
  d.command = launcher(o.ranks);
  for (const std::string& word : {program, std::string("-in"), std::string("in.strip"), std::string("-log"), std::string("none")}) d.command.push_back(word);
  d.version_command = {program, "-h"};
  d.abilities.laws = {"dem"};
  return external_solver(std::move(d), {write_lammps_input, read_motion, [](const std::string& said) { return std::string(between(said, "Simulator - ", "\n")); }, beyond_lammps});
}

}  // namespace ddem::harness
