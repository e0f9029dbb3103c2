#include "harness/cli/run_hdf5.h"

#include <functional>

namespace ddem::harness {
namespace {

using OfSnapshot = std::function<const std::vector<double>&(const Snapshot&)>;

/// One dataset, snapshots x discs; none where the simulation has no such field.
void write_field(Hdf5Group& fields, const std::string& name, const std::string& unit, const std::vector<Snapshot>& snapshots,
                 const OfSnapshot& of) {
  std::vector<double> values;
  for (const Snapshot& s : snapshots) values.insert(values.end(), of(s).begin(), of(s).end());
  if (values.empty()) return;
  fields.write(name, values, {snapshots.size(), values.size() / snapshots.size()}).set_attribute("unit", unit);
}

void write_tensor(Hdf5Group& fields, const std::string& name, const std::string& unit, const std::vector<Snapshot>& snapshots,
                  TensorField Snapshot::*tensor) {
  write_field(fields, name + "_xx", unit, snapshots, [&](const Snapshot& s) -> const auto& { return (s.*tensor).xx; });
  write_field(fields, name + "_yy", unit, snapshots, [&](const Snapshot& s) -> const auto& { return (s.*tensor).yy; });
  write_field(fields, name + "_xy", unit, snapshots, [&](const Snapshot& s) -> const auto& { return (s.*tensor).xy; });
}

void write_energy(Hdf5Group& root, const SimulationResult& result) {
  Hdf5Group energy = root.create_group("energy");
  if (result.energy.empty()) {
    energy.set_attribute("status", "not audited: nonlinear kinematics, integrator = \"exact\", or no step");
    return;
  }
  const auto write = [&](const char* name, const char* unit, const auto& of) {
    std::vector<double> values;
    for (const EnergySample& s : result.energy) values.push_back(of(s));
    energy.write(name, values).set_attribute("unit", unit);
  };
  write("time", "s", [](const EnergySample& s) { return s.time; });
  write("kinetic", "J", [](const EnergySample& s) { return s.energies.kinetic; });
  write("contact", "J", [](const EnergySample& s) { return s.energies.contact; });
  write("particle", "J", [](const EnergySample& s) { return s.energies.particle; });
  write("invariant", "J", [](const EnergySample& s) { return s.energies.invariant; });
}

void write_fields(Hdf5Group& root, const DemRun& run) {
  const std::vector<Snapshot>& snapshots = run.result.snapshots;
  if (snapshots.empty()) return;
  Hdf5Group fields = root.create_group("fields");
  const Packing& p = run.assembly.packing;
  fields.write("x", p.x).set_attribute("unit", "m");
  fields.write("y", p.y).set_attribute("unit", "m");
  fields.write("radius", p.radius).set_attribute("unit", "m");
  std::vector<double> times;
  for (const Snapshot& s : snapshots) times.push_back(s.time);
  fields.write("time", times).set_attribute("unit", "s");
  // This namespace has a scene's InitialState, too.
  using State = ddem::InitialState;
  const auto field = [&](const char* name, const char* unit, std::vector<double> State::*component) {
    write_field(fields, name, unit, snapshots, [&](const Snapshot& s) -> const auto& { return s.state.*component; });
  };
  field("displacement_x", "m", &State::ux);
  field("displacement_y", "m", &State::uy);
  field("rotation", "rad", &State::theta);
  field("velocity_x", "m/s", &State::vx);
  field("velocity_y", "m/s", &State::vy);
  field("angular_velocity", "rad/s", &State::omega);
  write_tensor(fields, "stress", "Pa", snapshots, &Snapshot::stress);
  write_tensor(fields, "strain", "1", snapshots, &Snapshot::strain);
}

}  // namespace

void write_energy_and_fields(Hdf5Group& root, const DemRun& run) {
  write_energy(root, run.result);
  write_fields(root, run);
}

}  // namespace ddem::harness
