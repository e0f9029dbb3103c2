#include "harness/solvers/lammps_ddem.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include "dem/spectra/strain_polynomial.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/own_files.h"
#include "harness/solvers/lammps_dump.h"
#include "harness/solvers/ready.h"
#include "harness/solvers/reduced.h"
#include "harness/solvers/solver.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

/// What is asked of a disc; discs of one role are one type of atoms, and groups are made of types.
enum Role : unsigned { held_x = 1, held_y = 2, held_theta = 4, driven = 8, recorded = 16 };
constexpr std::array<std::pair<Role, const char*>, 5> kGroups{
    {{held_x, "held_x"}, {held_y, "held_y"}, {held_theta, "held_theta"}, {driven, "driven"}, {recorded, "recorded"}}};

constexpr const char* kMark = "ddem export --format lammps: ";  // at the beginning of every file (harness/io/output_kind.cc)
constexpr std::size_t kPiece = 1 << 16;  // bytes
constexpr double kRoom = 8.0;  // radii between discs and the walls of a box that is not periodic

double at(const std::vector<double>& values, std::size_t d) { return values.empty() ? 0.0 : values[d]; }

double longest_bond(const ddem::Assembly& a) { return a.bonds.size() == 0 ? 0.0 : *std::ranges::max_element(a.bonds.length); }

class DdemInput {
 public:
  explicit DdemInput(const Exchange& e) : e_(e), role_(e.assembly.size(), 0u), largest_(std::ranges::max(e.assembly.packing.radius)), touching_(may_close_gaps(e.assembly, e.input)) {
    const SimulationInput& in = e.input;
    const auto mark = [this](const std::vector<std::uint8_t>& held, Role role) {
      for (std::size_t d = 0; d < held.size(); ++d) {
        if (held[d] != 0) role_[d] |= role;
      }
    };
    mark(in.held.x, held_x), mark(in.held.y, held_y), mark(in.held.theta, held_theta);
    if (in.drive) {
      for (const int d : in.drive->discs) role_[static_cast<std::size_t>(d)] |= driven;
    }
    for (const int d : recorded_discs(in)) role_[static_cast<std::size_t>(d)] |= recorded;
    for (const unsigned role : role_) type_.try_emplace(role, 0);
    int number = 0;
    for (auto& [role, type] : type_) type = ++number;
  }

  /// In pieces: at 1e6 discs the whole is a quarter of a gigabyte.
  void write_data(const fs::path& path) const {
    AtomicFile file(path);
    const ddem::Assembly& a = e_.assembly;
    const Packing& p = a.packing;
    const ddem::InitialState& s = e_.input.initial;
    fmt::memory_buffer text;
    write(text, "{}{} discs and {} bonds, SI units. Atoms: id type x y z diameter density molecule\n\n{} atoms\n{} bonds\n{} atom types\n1 bond types\n", kMark, a.size(), a.bonds.size(),
          a.size(), a.bonds.size(), type_.size());
    write(text, "{} xlo xhi\n{} ylo yhi\n{} {} zlo zhi\n\nAtoms # hybrid\n\n", limits(p.x, p.period.x), limits(p.y, p.period.y),
          -largest_, largest_);
    const auto line = [&]<class... Args>(fmt::format_string<Args...> format, Args&&... args) {
      write(text, format, std::forward<Args>(args)...);
      if (text.size() < kPiece) return;
      file.append({text.data(), text.size()});
      text.clear();
    };
    for (std::size_t d = 0; d < a.size(); ++d) line("{} {} {} {} 0 {} {} 1\n", d + 1, type_.at(role_[d]), p.x[d], p.y[d], 2.0 * p.radius[d], a.density);
    line("\nVelocities\n\n");
    for (std::size_t d = 0; d < a.size(); ++d) line("{} {} {} 0 0 0 {}\n", d + 1, at(s.vx, d), at(s.vy, d), at(s.omega, d));
    if (a.bonds.size() > 0) line("\nBonds\n\n");
    for (std::size_t b = 0; b < a.bonds.size(); ++b) line("{} 1 {} {}\n", b + 1, a.bonds.i[b] + 1, a.bonds.j[b] + 1);
    file.append({text.data(), text.size()});
    file.commit();
  }

  /// Of discs that are displaced at first; empty where none is.
  static std::string displaced(const std::vector<double>& values) {
    fmt::memory_buffer text;
    std::size_t count = 0;
    for (std::size_t d = 0; d < values.size(); ++d) {
      if (values[d] != 0.0) write(text, "{} {}\n", d + 1, values[d]), ++count;
    }
    return count == 0 ? std::string() : fmt::format("# {}displacements at first\n{}\n{}", kMark, count, std::string_view(text.data(), text.size()));
  }

  std::string commands() const {
    const SimulationInput& in = e_.input;
    const Packing& p = e_.assembly.packing;
    fmt::memory_buffer text;
    write(text, "# {}{}\n# mpirun -np 2 ddem-lammps -in {}\nunits si\ndimension 2\n# Both ranks of a bond find its force: one exchange a step.\nnewton off\n", kMark, title(), kLammpsScript);
    write(text, "boundary {} {} p\natom_style hybrid sphere bond\n", p.period.x > 0.0 ? "p" : "f", p.period.y > 0.0 ? "p" : "f");
    // Discs are sorted at the start of a run: neighbours in space are neighbours in memory.
    write(text, "atom_modify map array sort 1000 {}\n{}\nspecial_bonds lj/coul 1 1 1\nbond_style ddem {}\n", 4.0 * largest_, pair_style(), in.contact.kinematics == Kinematics::linear ? "linear" : "nonlinear");
    const double skin = 0.5 * largest_;
    write(text, "# Ghosts reach beyond the longest bond.\ncomm_modify cutoff {}\nneighbor {} bin\n{}", std::max(3.0 * largest_, 1.1 * longest_bond(e_.assembly)) + 2.0 * skin,
          skin, touching_ ? "neigh_modify delay 0 every 1 check yes\n"
                          : "# Bonds have the geometry of the reference: lists need no renewal while nothing else acts.\nneigh_modify once yes\n");
    write(text, "read_data {}\n# Discs, of this density times the thickness\nset group all density/disc {}\n{}\n", kLammpsData,
          e_.assembly.density * e_.assembly.thickness, stiffness());
    if (touching_) write(text, "pair_coeff * * {}\n", in.contact.uniform() ? fmt::to_string(in.contact.normal_stiffness) : fmt::format("modulus {}", in.contact.contact_modulus));
    write_groups(text);
    write(text, "{}\ntimestep {}\n", fix(), in.time_step);
    write(text, "thermo 100000000\nthermo_modify lost ignore norm no\n"
                "dump motion recorded custom {} motion.txt id f_ddem[1] f_ddem[2] f_ddem[3]\ndump_modify motion sort id format float %.17g\nrun {}\n",
          in.sample_every, in.steps);
    return {text.data(), text.size()};
  }

 private:
  template <class... Args>
  static void write(fmt::memory_buffer& to, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(to), format, std::forward<Args>(args)...);
  }

  /// In one line: a line that ends with & would go on.
  std::string title() const {
    std::string title = e_.title.empty() ? "discs and bonds" : e_.title;
    std::ranges::replace_if(title, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '&' || c == '$'; }, ' ');
    return title;
  }

  /// Of the box: a period, or away from all discs.
  std::string limits(const std::vector<double>& places, double period) const {
    if (period > 0.0) return fmt::format("0 {}", period);
    const auto [least, most] = std::ranges::minmax(places);
    return fmt::format("{} {}", least - kRoom * largest_, most + kRoom * largest_);
  }

  /// Discs that are not bonded and may touch. Strains up to a tenth move boundaries by a fifth of a radius; and in linear kinematics
  /// discs that pass each other are further apart than along the normal of the reference. Displacements of a radius are its end.
  std::string pair_style() const {
    if (!touching_) return "pair_style none";
    const double touching = 2.0 * std::ranges::min(e_.assembly.packing.radius), displacement = std::min(2.0 * displacement_put_in(e_.input), largest_);
    const double aside = e_.input.contact.kinematics == Kinematics::linear ? std::hypot(touching, 2.0 * displacement) - touching : 0.0;
    return fmt::format("pair_style ddem {}", 0.2 * largest_ + aside);
  }

  std::string stiffness() const {
    const ContactParameters& c = e_.input.contact;
    return c.uniform() ? fmt::format("bond_coeff 1 {} {}", c.normal_stiffness, c.stiffness_ratio)
                       : fmt::format("bond_coeff 1 modulus {} {}", c.contact_modulus, c.stiffness_ratio);
  }

  void write_groups(fmt::memory_buffer& text) const {
    for (const auto& [role, name] : kGroups) {
      std::vector<int> types;
      for (const auto& [roles, type] : type_) {
        if ((roles & role) != 0) types.push_back(type);
      }
      if (!types.empty()) write(text, "group {} type {}\n", name, fmt::join(types, " "));
    }
  }

  bool some(Role role) const {
    return std::ranges::any_of(type_, [role](const auto& entry) { return (entry.first & role) != 0; });
  }

  std::string fix() const {
    const SimulationInput& in = e_.input;
    fmt::memory_buffer variables, words;
    write(words, "fix ddem all ddem");
    const std::vector<double>* initial[] = {&in.initial.ux, &in.initial.uy, &in.initial.theta};
    std::string names;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::string name = fs::path(kLammpsInitial[c]).stem().string();
      const bool there = std::ranges::any_of(*initial[c], [](double v) { return v != 0.0; });
      if (there) write(variables, "variable {} atomfile {}\n", name, kLammpsInitial[c]);
      names += there ? " v_" + name : " NULL";
    }
    if (variables.size() > 0) write(words, " displacement{}", names);
    for (const auto& [role, what] : {std::pair{held_x, "x"}, std::pair{held_y, "y"}, std::pair{held_theta, "theta"}}) {
      if (some(role)) write(words, " hold {0} held_{0}", what);
    }
    if (in.drive) write(words, " drive {} driven {} {}", in.drive->direction == Direction::x ? "x" : "y", in.drive->amplitude, in.drive->duration);
    if (in.deformation.active()) write(words, " &\n    {}", strain());
    return std::string(variables.data(), variables.size()) + std::string(words.data(), words.size());
  }

  std::string strain() const;

  const Exchange& e_;
  std::vector<unsigned> role_;
  std::map<unsigned, int> type_;  // of each set of roles that some disc has
  double largest_;                // radius
  bool touching_;                 // the load may close gaps
};

std::string DdemInput::strain() const {
  const DeformationParameters& d = e_.input.deformation;
  const bool lagged = d.scheme == Scheme::lagged;
  std::string text = fmt::format("strain {} {} {} {} plane {} thickness {} volume {}", lagged ? "lagged" : "implicit", name_of(d.correction), d.young_modulus,
                                 d.poisson_ratio, d.plane == Plane::stress ? "stress" : "strain", e_.assembly.thickness, volume_over_disc(e_));
  if (lagged) return fmt::format("{} evaluations {} relaxation {}", text, d.evaluations, d.relaxation);
  const std::vector<double> weights = e_.input.relaxations.empty() ? strain_relaxations(e_.assembly, e_.input.contact, d) : e_.input.relaxations;
  return fmt::format("{} &\n    weights {} {}", text, weights.size(), fmt::join(weights, " "));
}

/// What the script left, as displacements and rotations averaged over receivers.
SimulationResult read_ddem_motion(const fs::path& folder, const Exchange& e, const std::string& printed) {
  SimulationResult result;
  result.wall_seconds = number_between(printed, "Loop time of ", " on");
  SampleMaker samples(e.input);
  const std::size_t discs = e.assembly.size();
  std::vector<double> ux(discs, 0.0), uy(discs, 0.0), theta(discs, 0.0);
  const auto take = [&](std::size_t d, std::span<const double> u) { ux[d] = u[0], uy[d] = u[1], theta[d] = u[2]; };
  read_dump(folder / "motion.txt", discs, 3, take, [&] { samples.add(ux, uy, theta); });
  result.signals = samples.take();
  if (!e.input.contact.has_rotation()) {
    for (std::vector<double>& signal : result.signals.theta) std::ranges::fill(signal, 0.0);  // as rotations drop out
  }
  return result;
}

/// Beside this program, where both were built.
std::string lammps_ddem_program() { return (program_folder() / "ddem-lammps").string(); }

}  // namespace

std::string lammps_ddem_refusal(const ddem::Assembly& a, const SimulationInput& in) {
  const DeformationParameters& d = in.deformation;
  const bool implicit = d.scheme == Scheme::implicit;
  if (implicit && d.solver != StrainSolver::polynomial) return "implicit strains by conjugate gradients (use solver = \"polynomial\")";
  if (implicit && in.contact.kinematics == Kinematics::nonlinear) return "implicit strains with nonlinear kinematics, of which their polynomial is not made";
  if (implicit && may_close_gaps(a, in)) return "implicit strains with new contacts, which this load may close (or set contact.new_contacts = \"off\")";
  for (const double period : {a.packing.period.x, a.packing.period.y}) {
    if (period > 0.0 && !(period > 2.0 * longest_bond(a))) return "a period that is not above twice the longest bond";
  }
  return "";
}

void write_lammps_ddem(const fs::path& folder, const Exchange& e) {
  if (const std::string reason = lammps_ddem_refusal(e.assembly, e.input); !reason.empty()) throw UnsupportedError("ddem-lammps cannot do " + reason);
  const DdemInput input(e);
  const std::vector<double>* initial[] = {&e.input.initial.ux, &e.input.initial.uy, &e.input.initial.theta};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string text = DdemInput::displaced(*initial[c]);
    if (text.empty()) fs::remove(folder / kLammpsInitial[c]);  // of another scene
    else write_file(folder / kLammpsInitial[c], text);
  }
  input.write_data(folder / kLammpsData);
  write_file(folder / kLammpsScript, input.commands());
}

std::shared_ptr<const Solver> lammps_ddem_solver(const ReadyOptions& o) {
  SolverDescription d;
  d.name = "lammps-ddem";
  const std::string program = o.program.empty() ? lammps_ddem_program() : o.program;
  if (!fs::exists(program))
    throw MachineError(program + " is missing: it was not built (ninja ddem-lammps in its build folder; it needs LAMMPS and MPI, Debian packages lammps, liblammps-dev and libopenmpi-dev)");
  d.ranks = o.ranks;
  d.command = launcher(o.ranks);
  for (const std::string& word : {program, std::string("-in"), std::string(kLammpsScript), std::string("-log"), std::string("none")}) d.command.push_back(word);
  d.version_command = {program, "--version"};
  d.abilities.laws = builtin_solver().abilities().laws;
  d.abilities.nonlinear = true;
  d.abilities.new_contacts = true;
  return external_solver(std::move(d), {write_lammps_ddem, read_ddem_motion, {}, lammps_ddem_refusal});
}

}  // namespace ddem::harness
