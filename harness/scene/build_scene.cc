#include "harness/scene/build_scene.h"

#include "harness/scene/fill.h"

namespace ddem::harness {
namespace {

HexagonalPacking build_hexagonal(const Values& values) {
  auto packing = filled<HexagonalPacking>(values, "assembly");
  if (values.given("assembly.columns")) {
    packing.size = filled<HexagonalLattice>(values, "assembly");
  } else if (values.given("assembly.length")) {
    packing.size = filled<HexagonalRectangle>(values, "assembly");
  } else {
    // An infinite lattice without any size: its moduli are those of every cell.
    packing.size = HexagonalLattice{8, 8, 1e-4};
  }
  return packing;
}

Assembly build_assembly(const Values& values) {
  auto assembly = filled<Assembly>(values, "assembly");
  const bool random = !values.given("assembly.packing") || values.is("assembly.packing", "random");
  if (random) {
    assembly.packing = filled<RandomPacking>(values, "assembly");
  } else if (values.is("assembly.packing", "hexagonal")) {
    assembly.packing = build_hexagonal(values);
  } else {
    assembly.packing = filled<FilePacking>(values, "assembly");
  }
  if (values.given("assembly.bonds")) {
    assembly.bonding = filled<BondFile>(values, "assembly");
  } else if (values.given("assembly.coordination") || (random && !values.given("assembly.bond_gap"))) {
    assembly.bonding = filled<BondCoordination>(values, "assembly");
  } else {
    assembly.bonding = filled<BondGap>(values, "assembly");
  }
  assembly.periodic.x = values.is("assembly.periodic", "xy");
  assembly.periodic.y = assembly.periodic.x || values.is("assembly.periodic", "y") ||
                        values.is("boundary.top_bottom", "periodic");
  return assembly;
}

Contact build_contact(const Values& values) {
  auto contact = filled<Contact>(values, "contact");
  if (values.given("contact.contact_modulus")) {
    contact.stiffness = filled<ContactModulus>(values, "contact");
  } else {
    contact.stiffness = filled<NormalStiffness>(values, "contact");
  }
  return contact;
}

Load build_load(const Values& values) {
  if (values.table_given("drive")) return filled<Drive>(values, "drive");
  if (!values.table_given("initial")) return {};
  if (values.given("initial.displacement") || values.given("initial.velocity")) return filled<InitialState>(values, "initial");
  auto pulse = filled<InitialPulse>(values, "initial");
  if (pulse.shape == PulseShape::column) pulse.width = 0.0;
  return pulse;
}

Continuum build_continuum(const Values& values) {
  auto continuum = filled<Continuum>(values, "continuum");
  const std::vector<std::int64_t>& elements = values.integers("continuum.elements");
  continuum.elements = {elements[0], elements[1]};
  return continuum;
}

Time build_time(const Values& values) {
  auto time = filled<Time>(values, "time");
  if (values.given("time.step")) {
    time.step = filled<StepSeconds>(values, "time");
  } else {
    time.step = filled<StepFraction>(values, "time");
  }
  if (values.given("time.end")) time.end = filled<EndTime>(values, "time");
  if (values.given("time.steps")) time.end = filled<EndSteps>(values, "time");
  return time;
}

Probes build_probes(const Values& values) {
  if (values.given("probes.discs")) return ProbeDiscs{values.integers("probes.discs")};
  if (values.given("probes.points")) return ProbePoints{values.points("probes.points")};
  return filled<ProbePairs>(values, "probes");
}

}  // namespace

Scene build_scene(const Values& values) {
  auto scene = filled<Scene>(values, "");
  scene.assembly = build_assembly(values);
  if (values.table_given("material")) scene.material = filled<Material>(values, "material");
  if (values.table_given("contact")) scene.contact = build_contact(values);
  const bool deformable = values.table_given("deformation") && !values.is("deformation.scheme", "none");
  if (deformable) scene.deformation = filled<DeformationParameters>(values, "deformation");
  scene.boundary = scene.assembly.periodic.x ? Boundary{Edge::free, Edge::free} : filled<Boundary>(values, "boundary");
  scene.load = build_load(values);
  if (values.table_given("continuum")) scene.continuum = build_continuum(values);
  scene.time = build_time(values);
  scene.probes = build_probes(values);
  scene.run = filled<Run>(values, "run");
  return scene;
}

}  // namespace ddem::harness
