#include "harness/scene/build_scene.h"

namespace ddem::harness {
namespace {

std::optional<double> optional_number(const Values& values, std::string_view dotted) {
  return values.has(dotted) ? std::optional(values.number(dotted)) : std::nullopt;
}

std::optional<std::filesystem::path> optional_file(const Values& values, std::string_view dotted) {
  return values.has(dotted) ? std::optional(values.file(dotted)) : std::nullopt;
}

HexagonalPacking build_hexagonal(const Values& values) {
  HexagonalPacking packing;
  packing.close_packed_along = values.choice<Axis>("assembly.close_packed_along");
  if (values.given("assembly.columns")) {
    packing.size = HexagonalLattice{values.integer("assembly.columns"), values.integer("assembly.rows"),
                                    values.number("assembly.radius")};
  } else if (values.given("assembly.length")) {
    packing.size = HexagonalRectangle{values.number("assembly.length"), values.number("assembly.width"),
                                      values.integer("assembly.discs")};
  } else {
    // An infinite lattice without any size: its moduli are those of every cell.
    packing.size = HexagonalLattice{8, 8, 1e-4};
  }
  return packing;
}

RandomPacking build_random(const Values& values) {
  RandomPacking packing;
  packing.length = values.number("assembly.length");
  packing.width = values.number("assembly.width");
  if (values.has("assembly.discs")) packing.discs = values.integer("assembly.discs");
  packing.seed = values.integer("assembly.seed");
  packing.radius_ratio = values.number("assembly.radius_ratio");
  packing.walls = values.choice<Walls>("assembly.walls");
  return packing;
}

Assembly build_assembly(const Values& values) {
  Assembly assembly;
  const bool random = !values.given("assembly.packing") || values.is("assembly.packing", "random");
  if (random) {
    assembly.packing = build_random(values);
  } else if (values.is("assembly.packing", "hexagonal")) {
    assembly.packing = build_hexagonal(values);
  } else {
    assembly.packing = FilePacking{values.file("assembly.file"), optional_number(values, "assembly.length"),
                                   optional_number(values, "assembly.width")};
  }
  if (values.given("assembly.bonds")) {
    assembly.bonding = BondFile{values.file("assembly.bonds")};
  } else if (values.given("assembly.coordination") || (random && !values.given("assembly.bond_gap"))) {
    assembly.bonding = BondCoordination{values.number("assembly.coordination")};
  } else {
    assembly.bonding = BondGap{values.number("assembly.bond_gap")};
  }
  assembly.periodic.x = values.is("assembly.periodic", "xy");
  assembly.periodic.y = assembly.periodic.x || values.is("assembly.periodic", "y") ||
                        values.is("boundary.top_bottom", "periodic");
  assembly.edge_band = values.number("assembly.edge_band");
  assembly.thickness = values.number("assembly.thickness");
  return assembly;
}

Contact build_contact(const Values& values) {
  Contact contact;
  if (values.given("contact.contact_modulus")) {
    contact.stiffness = ContactModulus{values.number("contact.contact_modulus")};
  } else {
    contact.stiffness = NormalStiffness{values.number("contact.normal_stiffness")};
  }
  contact.stiffness_ratio = values.number("contact.stiffness_ratio");
  contact.kinematics = values.choice<Kinematics>("contact.kinematics");
  contact.new_contacts = values.choice<NewContacts>("contact.new_contacts");
  return contact;
}

DeformationParameters build_deformation(const Values& values) {
  DeformationParameters deformation;
  deformation.scheme = values.choice<Scheme>("deformation.scheme");
  deformation.correction = values.choice<Correction>("deformation.correction");
  deformation.young_modulus = values.number("deformation.young_modulus");
  deformation.poisson_ratio = values.number("deformation.poisson_ratio");
  deformation.plane = values.choice<Plane>("deformation.plane");
  deformation.evaluations = static_cast<int>(values.integer("deformation.evaluations"));
  deformation.relaxation = values.number("deformation.relaxation");
  deformation.tolerance = values.number("deformation.tolerance");
  deformation.solver = values.choice<StrainSolver>("deformation.solver");
  deformation.volume = values.choice<ParticleVolume>("deformation.particle_volume");
  return deformation;
}

Load build_load(const Values& values) {
  if (values.table_given("drive")) {
    return Drive{values.choice<Wave>("drive.wave"), values.choice<DriveShape>("drive.shape"),
                 values.number("drive.duration"), values.number("drive.amplitude")};
  }
  if (!values.table_given("initial")) return {};
  if (values.given("initial.displacement") || values.given("initial.velocity")) {
    return InitialState{optional_file(values, "initial.displacement"),
                        optional_file(values, "initial.velocity")};
  }
  InitialPulse pulse;
  pulse.wave = values.choice<Wave>("initial.wave");
  pulse.shape = values.choice<PulseShape>("initial.shape");
  if (pulse.shape != PulseShape::column) pulse.width = values.number("initial.width");
  pulse.center = values.number("initial.center");
  pulse.amplitude = values.number("initial.amplitude");
  return pulse;
}

Continuum build_continuum(const Values& values) {
  Continuum continuum;
  continuum.young_modulus = optional_number(values, "continuum.young_modulus");
  continuum.poisson_ratio = optional_number(values, "continuum.poisson_ratio");
  continuum.density = optional_number(values, "continuum.density");
  continuum.degree = values.integer("continuum.degree");
  const std::vector<std::int64_t>& elements = values.integers("continuum.elements");
  continuum.elements = {elements[0], elements[1]};
  continuum.plane = values.choice<Plane>("continuum.plane");
  if (values.given("continuum.mesh")) continuum.mesh = values.file("continuum.mesh");
  return continuum;
}

Time build_time(const Values& values) {
  Time time;
  time.integrator = values.choice<Integrator>("time.integrator");
  if (values.given("time.step")) {
    time.step = StepSeconds{values.number("time.step")};
  } else {
    time.step = StepFraction{values.number("time.step_fraction")};
  }
  if (values.given("time.end")) time.end = EndTime{values.number("time.end")};
  if (values.given("time.steps")) time.end = EndSteps{values.integer("time.steps")};
  time.sample_every = values.integer("time.sample_every");
  time.allow_above_critical = values.flag("time.allow_above_critical");
  return time;
}

Probes build_probes(const Values& values) {
  if (values.given("probes.discs")) return ProbeDiscs{values.integers("probes.discs")};
  if (values.given("probes.points")) return ProbePoints{values.points("probes.points")};
  return ProbePairs{values.integer("probes.pairs"), values.flag("probes.section")};
}

}  // namespace

Scene build_scene(const Values& values) {
  Scene scene;
  scene.title = values.text("title");
  scene.assembly = build_assembly(values);
  if (values.table_given("material")) scene.material = Material{values.number("material.density")};
  if (values.table_given("contact")) scene.contact = build_contact(values);
  const bool deformable = values.table_given("deformation") && !values.is("deformation.scheme", "none");
  if (deformable) scene.deformation = build_deformation(values);
  if (!scene.assembly.periodic.x) {
    scene.boundary.right = values.choice<Edge>("boundary.right");
    scene.boundary.left = values.choice<Edge>("boundary.left");
  } else {
    scene.boundary = {Edge::free, Edge::free};
  }
  scene.load = build_load(values);
  if (values.table_given("continuum")) scene.continuum = build_continuum(values);
  scene.time = build_time(values);
  scene.probes = build_probes(values);
  scene.run.threads = values.integer("run.threads");
  return scene;
}

}  // namespace ddem::harness
