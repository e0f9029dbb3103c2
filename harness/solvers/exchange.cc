#include "harness/solvers/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "dem/assembly/bond_stiffness.h"
#include "dem/assembly/particle_volume.h"
#include "dem/spectra/strain_polynomial.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/json.h"
#include "harness/solvers/solver.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kSameTime = 1e-6;  // of a sample interval: a program may sum its steps, or print nine digits

const char* scheme_name(Scheme scheme) {
  switch (scheme) {
    case Scheme::none: return "none";
    case Scheme::lagged: return "lagged";
    case Scheme::implicit: return "implicit";
  }
  return "";
}

/// As a scene file has it.
std::string scene_word(Correction correction) {
  std::string word = name_of(correction);
  std::ranges::replace(word, '-', '_');
  return word;
}

Json strain_json(const Exchange& e) {
  const DeformationParameters& d = e.input.deformation;
  Json j{{"scheme", scheme_name(d.scheme)},
         {"correction", scene_word(d.correction)},
         {"young_modulus", d.young_modulus},
         {"poisson_ratio", d.poisson_ratio},
         {"plane", d.plane == Plane::stress ? "stress" : "strain"},
         {"evaluations", d.evaluations},
         {"relaxation", d.relaxation},
         {"particle_volume", d.volume == ParticleVolume::disc ? "disc" : "cell"},
         {"volume_over_disc", volume_over_disc(e)}};
  if (d.scheme == Scheme::implicit) {
    j["tolerance"] = d.tolerance;
    if (d.solver == StrainSolver::polynomial)
      j["relaxations"] = e.input.relaxations.empty() ? strain_relaxations(e.assembly, e.input.contact, d) : e.input.relaxations;
  }
  return j;
}

/// A length that is there, or null.
Json if_positive(double value) { return value > 0.0 ? Json(value) : Json(); }

Json scene_json(const Exchange& e) {
  const SimulationInput& in = e.input;
  const Packing& p = e.assembly.packing;
  Json j{{"protocol", kExchangeVersion},
         {"title", e.title},
         {"units", "SI: m, kg, s, N, Pa, rad"},
         {"length", p.length},
         {"width", p.width},
         {"thickness", e.assembly.thickness},
         {"density", e.assembly.density},
         {"period", {{"x", if_positive(p.period.x)}, {"y", if_positive(p.period.y)}}}};
  j["contact"] = {{"normal_stiffness", in.contact.uniform() ? Json(in.contact.normal_stiffness) : Json()},
                  {"contact_modulus", if_positive(in.contact.contact_modulus)},
                  {"stiffness_ratio", in.contact.stiffness_ratio},
                  {"kinematics", in.contact.kinematics == Kinematics::linear ? "linear" : "nonlinear"},
                  {"new_contacts", may_close_gaps(e.assembly, in)}};
  j["deformation"] = in.deformation.active() ? strain_json(e) : Json();
  j["time"] = {{"step", in.time_step}, {"steps", in.steps}, {"sample_every", in.sample_every}, {"samples", sample_count(in)}};
  j["drive"] = Json();
  if (in.drive) j["drive"] = {{"component", in.drive->direction == Direction::x ? "x" : "y"}, {"amplitude", in.drive->amplitude}, {"duration", in.drive->duration}};
  return j;
}

/// A table as text: a header, then rows.
class Rows {
 public:
  explicit Rows(std::string_view header) { fmt::format_to(std::back_inserter(text_), "{}\n", header); }
  template <class First, class... Rest>
  void add(const First& first, const Rest&... rest) {
    fmt::format_to(std::back_inserter(text_), "{}", first);
    (fmt::format_to(std::back_inserter(text_), ",{}", rest), ...);
    text_.push_back('\n');
  }
  void write(const fs::path& file) const { write_file(file, {text_.data(), text_.size()}); }

 private:
  fmt::memory_buffer text_;
};

template <class T>
T at(const std::vector<T>& values, std::size_t d) {
  return values.empty() ? T{} : values[d];
}

void write_discs(const fs::path& file, const Exchange& e) {
  const ddem::Assembly& a = e.assembly;
  const SimulationInput& in = e.input;
  const ddem::InitialState& s = in.initial;
  Rows rows("id,x,y,radius,mass,inertia,held_x,held_y,held_theta,ux,uy,theta,vx,vy,omega");
  for (std::size_t d = 0; d < a.size(); ++d) {
    rows.add(d, a.packing.x[d], a.packing.y[d], a.packing.radius[d], a.mass[d], a.inertia[d], int{at(in.held.x, d)}, int{at(in.held.y, d)},
             int{at(in.held.theta, d)}, at(s.ux, d), at(s.uy, d), at(s.theta, d), at(s.vx, d), at(s.vy, d), at(s.omega, d));
  }
  rows.write(file);
}

/// How many periods the bonded image of j is away from it.
long image(double along, double from, double to, double period) { return period > 0.0 ? std::lround((along - (to - from)) / period) : 0; }

void write_bonds(const fs::path& file, const Exchange& e) {
  const Bonds& b = e.assembly.bonds;
  const Packing& p = e.assembly.packing;
  const std::vector<double> k_n = normal_stiffnesses(e.assembly, e.input.contact);
  Rows rows("i,j,nx,ny,length,arm_i,arm_j,normal_stiffness,shear_stiffness,image_x,image_y");
  for (std::size_t k = 0; k < b.size(); ++k) {
    const int i = b.i[k], j = b.j[k];
    rows.add(i, j, b.nx[k], b.ny[k], b.length[k], b.arm_i[k], b.arm_j[k], k_n[k], e.input.contact.stiffness_ratio * k_n[k],
             image(b.nx[k] * b.length[k], p.x[i], p.x[j], p.period.x), image(b.ny[k] * b.length[k], p.y[i], p.y[j], p.period.y));
  }
  rows.write(file);
}

void write_receivers(const fs::path& file, const Exchange& e) {
  Rows rows("receiver,disc");
  for (std::size_t r = 0; r < e.receivers.size(); ++r) {
    for (const int d : e.input.receivers[r].discs) rows.add(e.receivers[r], d);
  }
  rows.write(file);
}

void write_drive(const fs::path& file, const EdgeDrive& drive) {
  Rows rows("disc");
  for (const int d : drive.discs) rows.add(d);
  rows.write(file);
}

}  // namespace

const char* name_of(Correction correction) {
  switch (correction) {
    case Correction::normal: return "normal";
    case Correction::full: return "full";
    case Correction::normal_only_stress: return "normal-only-stress";
  }
  return "";
}

double volume_over_disc(const Exchange& e) {
  const DeformationParameters& d = e.input.deformation;
  return d.volume == ParticleVolume::disc ? 1.0 : particle_volumes(e.assembly, d).front() / e.assembly.volume.front();
}

long sample_count(const SimulationInput& in) { return in.steps / in.sample_every + 1; }

void write_exchange(const fs::path& folder, const Exchange& e) {
  const Json scene = scene_json(e);
  write_discs(folder / "discs.csv", e);
  write_bonds(folder / "bonds.csv", e);
  write_receivers(folder / "receivers.csv", e);
  if (e.input.drive) write_drive(folder / "drive.csv", *e.input.drive);
  write_json(folder / "scene.json", scene);  // last: with it the folder is whole
}

Signals signals_of(const SignalTable& table, std::span<const std::string> receivers, bool with_rotation, const std::string& path) {
  const auto column = [&](const std::string& name, bool needed) -> std::vector<double> {
    const auto found = std::ranges::find(table.names, name);
    if (found != table.names.end()) return table.channels[static_cast<std::size_t>(found - table.names.begin())];
    if (!needed) return std::vector<double>(table.time.size(), 0.0);
    throw InputError(fmt::format("{}: has no column {}; each receiver has NAME_ux, NAME_uy{}", path, name,
                                 with_rotation ? ", NAME_theta" : ""));
  };
  Signals s;
  s.time = table.time;
  for (const std::string& name : receivers) {
    s.ux.push_back(column(name + "_ux", true));
    s.uy.push_back(column(name + "_uy", true));
    s.theta.push_back(column(name + "_theta", with_rotation));
  }
  return s;
}

Signals read_exchange_signals(const fs::path& path, const Exchange& e) {
  const SignalTable table = read_signals_csv(path);
  const std::string name = path.filename().string();
  const auto samples = static_cast<std::size_t>(sample_count(e.input));
  if (table.time.size() != samples)
    throw InputError(fmt::format("{}: has {} samples, not {}: one at t = 0, and one after every {} of {} steps", name, table.time.size(), samples,
                                 e.input.sample_every, e.input.steps));
  const double interval = e.input.time_step * static_cast<double>(e.input.sample_every);
  for (std::size_t n = 0; n < samples; ++n) {
    const double time = interval * static_cast<double>(n);
    if (!(std::abs(table.time[n] - time) <= kSameTime * interval))
      throw InputError(fmt::format("{}: sample {} is at {:.9g} s, not {:.9g} s", name, n, table.time[n], time));
  }
  Signals signals = signals_of(table, e.receivers, e.input.contact.has_rotation(), name);
  // As the built-in solver tells it, to the last bit.
  for (std::size_t n = 0; n < samples; ++n) signals.time[n] = static_cast<double>(n * static_cast<std::size_t>(e.input.sample_every)) * e.input.time_step;
  return signals;
}

}  // namespace ddem::harness
