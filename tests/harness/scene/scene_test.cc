// What a scene that is right turns into.

#include <gtest/gtest.h>

#include "tests/harness/scene/scene_text.h"

namespace ddem::harness::test {
namespace {

Scene good(std::string_view text, Purpose purpose = Purpose::simulation) {
  const SceneResult result = parse(text, purpose);
  EXPECT_TRUE(result) << to_string(result.violations);
  return result ? *result : Scene{};
}

TEST(Scene, ReadsEveryKeyOfAFullScene) {
  const Scene scene = good(full_scene());
  EXPECT_EQ(scene.title, "bar, DDEM");
  const auto& packing = std::get<RandomPacking>(scene.assembly.packing);
  EXPECT_EQ(packing.length, 16.5e-3);
  EXPECT_EQ(packing.width, 2e-3);
  EXPECT_EQ(packing.discs, 682);
  EXPECT_EQ(packing.seed, 7);
  EXPECT_EQ(packing.radius_ratio, 1.5);
  EXPECT_EQ(packing.walls, Walls::periodic);
  EXPECT_EQ(std::get<BondGap>(scene.assembly.bonding).mean_radii, 0.25);
  EXPECT_FALSE(scene.assembly.periodic.x);
  EXPECT_TRUE(scene.assembly.periodic.y);
  EXPECT_EQ(scene.assembly.edge_band, 1.3);
  EXPECT_EQ(scene.assembly.thickness, 0.02);
  EXPECT_EQ(scene.material->density, 2100.0);
  EXPECT_EQ(std::get<NormalStiffness>(scene.contact->stiffness).k_n, 3e10);
  EXPECT_EQ(scene.contact->stiffness_ratio, 0.35);
  EXPECT_EQ(scene.contact->kinematics, Kinematics::nonlinear);
  EXPECT_EQ(scene.contact->new_contacts, NewContacts::off);
  EXPECT_EQ(scene.deformation->scheme, Scheme::lagged);
  EXPECT_EQ(scene.deformation->evaluations, 1);
  EXPECT_EQ(scene.deformation->relaxation, 1.0);
  EXPECT_EQ(scene.deformation->correction, Correction::normal_only_stress);
  EXPECT_EQ(scene.deformation->young_modulus, 4e10);
  EXPECT_EQ(scene.deformation->poisson_ratio, 0.31);
  EXPECT_EQ(scene.deformation->plane, Plane::strain);
  EXPECT_EQ(scene.boundary.right, Edge::fixed);
  EXPECT_EQ(scene.boundary.left, Edge::fixed_x);
  const auto& pulse = std::get<InitialPulse>(scene.load);
  EXPECT_EQ(pulse.wave, Wave::shear);
  EXPECT_EQ(pulse.shape, PulseShape::gaussian);
  EXPECT_EQ(pulse.width, 2e-3);
  EXPECT_EQ(pulse.center, 3e-3);
  EXPECT_EQ(pulse.amplitude, 1e-6);
  EXPECT_EQ(scene.continuum->young_modulus, 9e9);
  EXPECT_EQ(scene.continuum->poisson_ratio, 0.28);
  EXPECT_EQ(scene.continuum->density, 1700.0);
  EXPECT_EQ(scene.continuum->degree, 3);
  EXPECT_EQ(scene.continuum->elements, (std::array<std::int64_t, 2>{33, 4}));
  EXPECT_EQ(scene.time.integrator, Integrator::verlet);
  EXPECT_EQ(std::get<StepFraction>(scene.time.step).of_critical, 0.1);
  EXPECT_EQ(std::get<EndTime>(scene.time.end).seconds, 2e-5);
  EXPECT_EQ(scene.time.sample_every, 3);
  EXPECT_TRUE(scene.time.allow_above_critical);
  EXPECT_EQ(std::get<ProbePairs>(scene.probes).pairs, 4);
  EXPECT_TRUE(std::get<ProbePairs>(scene.probes).section);
  EXPECT_EQ(scene.run.threads, 2);
  EXPECT_EQ(scene.path, "scene.toml");
  EXPECT_EQ(scene.source_text, full_scene());
}

TEST(Scene, HasTheDefaultsOfTheReference) {
  const Scene scene = good(small_scene());
  EXPECT_EQ(scene.title, "");
  const auto& packing = std::get<RandomPacking>(scene.assembly.packing);
  EXPECT_EQ(packing.seed, 1);
  EXPECT_EQ(packing.radius_ratio, 1.67);
  EXPECT_EQ(packing.walls, Walls::periodic);
  EXPECT_EQ(std::get<BondCoordination>(scene.assembly.bonding).bonds_per_disc, 5.8);
  EXPECT_FALSE(scene.assembly.periodic.x);
  EXPECT_FALSE(scene.assembly.periodic.y);
  EXPECT_EQ(scene.assembly.edge_band, 1.2);
  EXPECT_EQ(scene.assembly.thickness, 1.0);
  EXPECT_EQ(scene.contact->kinematics, Kinematics::linear);
  EXPECT_EQ(scene.contact->new_contacts, NewContacts::automatic);
  EXPECT_FALSE(scene.deformation);
  EXPECT_FALSE(scene.continuum);
  EXPECT_EQ(scene.boundary.left, Edge::free);
  EXPECT_EQ(scene.boundary.right, Edge::fixed_x);
  const auto& pulse = std::get<InitialPulse>(scene.load);
  EXPECT_EQ(pulse.wave, Wave::longitudinal);
  EXPECT_EQ(pulse.shape, PulseShape::column);
  EXPECT_EQ(pulse.center, 0.0);
  EXPECT_EQ(scene.time.integrator, Integrator::verlet);
  EXPECT_EQ(std::get<StepFraction>(scene.time.step).of_critical, 0.2);
  EXPECT_TRUE(std::holds_alternative<UntilLastPeak>(scene.time.end));
  EXPECT_EQ(scene.time.sample_every, 1);
  EXPECT_FALSE(scene.time.allow_above_critical);
  EXPECT_EQ(std::get<ProbePairs>(scene.probes).pairs, 5);
  EXPECT_FALSE(std::get<ProbePairs>(scene.probes).section);
  EXPECT_EQ(scene.run.threads, 1);

  const Scene deformable = good(small_scene() + "[deformation]\nyoung_modulus = 4e10\npoisson_ratio = 0.3\n");
  EXPECT_EQ(deformable.deformation->scheme, Scheme::lagged);
  EXPECT_EQ(deformable.deformation->correction, Correction::normal);
  EXPECT_EQ(deformable.deformation->plane, Plane::stress);
  const Scene continuum = good(small_scene() + "[continuum]\n");
  EXPECT_EQ(continuum.continuum->degree, 4);
  EXPECT_EQ(continuum.continuum->elements, (std::array<std::int64_t, 2>{66, 8}));
  EXPECT_FALSE(continuum.continuum->young_modulus);
}

TEST(Scene, ReadsHexagonalPackings) {
  const std::string start = "[assembly]\npacking = \"hexagonal\"\n";
  const Scene lattice = good(
      start + "columns = 68\nrows = 10\nradius = \"0.1 mm\"\nclose_packed_along = \"y\"\n", Purpose::packing);
  const auto& packing = std::get<HexagonalPacking>(lattice.assembly.packing);
  EXPECT_EQ(packing.close_packed_along, Axis::y);
  EXPECT_EQ(std::get<HexagonalLattice>(packing.size).columns, 68);
  EXPECT_EQ(std::get<HexagonalLattice>(packing.size).rows, 10);
  EXPECT_EQ(std::get<HexagonalLattice>(packing.size).radius, 0.1e-3);
  EXPECT_EQ(std::get<BondGap>(lattice.assembly.bonding).mean_radii, 0.3);

  const Scene rectangle =
      good(start + "length = 1\nwidth = 2\ndiscs = 3\ncoordination = 6\n", Purpose::packing);
  const auto& filled = std::get<HexagonalPacking>(rectangle.assembly.packing);
  EXPECT_EQ(filled.close_packed_along, Axis::x);
  EXPECT_EQ(std::get<HexagonalRectangle>(filled.size).length, 1.0);
  EXPECT_EQ(std::get<HexagonalRectangle>(filled.size).width, 2.0);
  EXPECT_EQ(std::get<HexagonalRectangle>(filled.size).discs, 3);
  EXPECT_EQ(std::get<BondCoordination>(rectangle.assembly.bonding).bonds_per_disc, 6.0);
}

TEST(Scene, AnInfiniteHexagonalLatticeNeedsNoSize) {
  const Scene scene = good("[assembly]\npacking = \"hexagonal\"\nperiodic = \"xy\"\n", Purpose::packing);
  EXPECT_TRUE(scene.assembly.periodic.x);
  EXPECT_TRUE(scene.assembly.periodic.y);
  EXPECT_EQ(scene.boundary.right, Edge::free) << "a cell periodic in x has no edges to hold";
  const auto& packing = std::get<HexagonalPacking>(scene.assembly.packing);
  EXPECT_GT(std::get<HexagonalLattice>(packing.size).columns, 1);
}

TEST(Scene, PeriodicOverridesTopAndBottom) {
  const Scene scene = good(replaced(small_scene(), "discs = 682", "discs = 682\nperiodic = \"y\""));
  EXPECT_TRUE(scene.assembly.periodic.y);
  EXPECT_FALSE(scene.assembly.periodic.x);
}

TEST(Scene, ResolvesFilesInItsOwnFolder) {
  write_file("discs.csv", "x,y,radius\n0,0,1\n");
  write_file("bonds.csv", "i,j\n0,1\n");
  write_file("u0.csv", "ux,uy,theta\n0,0,0\n");
  write_file("v0.csv", "ux,uy,theta\n0,0,0\n");
  const std::string text =
      "[assembly]\npacking = \"file\"\nfile = \"discs.csv\"\nbonds = \"bonds.csv\"\n"
      "[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1\nstiffness_ratio = 0\n"
      "[initial]\ndisplacement = \"u0.csv\"\nvelocity = \"v0.csv\"\n";
  const SceneResult scene = read_scene(write_file("with_files.toml", text));
  ASSERT_TRUE(scene) << to_string(scene.violations);
  const auto& packing = std::get<FilePacking>(scene->assembly.packing);
  EXPECT_EQ(packing.discs, temporary_folder() / "discs.csv");
  EXPECT_FALSE(packing.length);
  EXPECT_EQ(std::get<BondFile>(scene->assembly.bonding).path, temporary_folder() / "bonds.csv");
  const auto& state = std::get<InitialState>(scene->load);
  EXPECT_EQ(state.displacement, temporary_folder() / "u0.csv");
  EXPECT_EQ(state.velocity, temporary_folder() / "v0.csv");

  const std::string absolute = replaced(text, "discs.csv", (temporary_folder() / "discs.csv").string());
  const SceneResult elsewhere = parse_scene(absolute, "x", "/nonexistent", {Purpose::simulation});
  EXPECT_EQ(elsewhere.violations.size(), 3u) << "only the relative ones are missing there";
  const Scene periodic =
      good(replaced(text, "[material]", "length = 2\nwidth = 1\nperiodic = \"xy\"\n[material]"));
  EXPECT_EQ(std::get<FilePacking>(periodic.assembly.packing).width, 1.0);
}

TEST(Scene, ReadsADriveAndTheOtherWaysOfTimeAndProbes) {
  std::string text = replaced(small_scene(), "[initial]", "[drive]\nduration = \"3 us\"");
  const Scene scene = good(text + "[time]\nstep = \"1 ns\"\nsteps = 4000\n[probes]\ndiscs = [12, 40, 681]\n");
  const auto& drive = std::get<Drive>(scene.load);
  EXPECT_EQ(drive.wave, Wave::longitudinal);
  EXPECT_EQ(drive.shape, DriveShape::sin2);
  EXPECT_EQ(drive.duration, 3e-6);
  EXPECT_EQ(drive.amplitude, 1e-6);
  EXPECT_EQ(std::get<StepSeconds>(scene.time.step).seconds, 1e-9);
  EXPECT_EQ(std::get<EndSteps>(scene.time.end).steps, 4000);
  EXPECT_EQ(std::get<ProbeDiscs>(scene.probes).discs, (std::vector<std::int64_t>{12, 40, 681}));

  const Scene points = good(text + "[probes]\npoints = [[0.005, 0.001], [\"6 mm\", \"1 mm\"], [0, 0]]\n");
  const auto& read = std::get<ProbePoints>(points.probes).points;
  ASSERT_EQ(read.size(), 3u);
  EXPECT_EQ(read[0], (std::array<double, 2>{0.005, 0.001}));
  EXPECT_EQ(read[1], (std::array<double, 2>{6e-3, 1e-3}));
}

TEST(Scene, SchemeNoneIsPlainDem) {
  EXPECT_FALSE(good(small_scene() + "[deformation]\nscheme = \"none\"\n").deformation);
}

TEST(Scene, WhatMustBeThereDependsOnThePurpose) {
  const std::string packing = "[assembly]\npacking = \"random\"\nlength = 1\nwidth = 1\ndiscs = 9\n";
  EXPECT_TRUE(parse(packing, Purpose::packing));
  EXPECT_FALSE(parse(packing, Purpose::statics));
  const std::string statics =
      packing + "[material]\ndensity = 1\n[contact]\nnormal_stiffness = 1\nstiffness_ratio = 1\n";
  EXPECT_TRUE(parse(statics, Purpose::statics));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(parse(statics, Purpose::statics)->load));
  EXPECT_FALSE(parse(statics, Purpose::simulation));
  EXPECT_FALSE(parse(statics, Purpose::continuum));
  const std::string load = "[initial]\nwave = \"shear\"\namplitude = 1\n";
  EXPECT_TRUE(parse(statics + load, Purpose::simulation));
  EXPECT_TRUE(parse(statics + load, Purpose::continuum));

  const std::string strip = "[assembly]\nlength = 1\nwidth = 1\n" + load;
  const std::string continuum = strip + "[continuum]\nyoung_modulus = 1\npoisson_ratio = 0.3\n";
  EXPECT_FALSE(parse(continuum, Purpose::continuum))
      << "the density would come from discs that are not there";
  EXPECT_TRUE(parse(continuum + "density = 1\n", Purpose::continuum));
  EXPECT_FALSE(parse(continuum + "density = 1\n", Purpose::simulation));
  // Discs that give the rectangle, or are probes, need what keeps them together.
  const std::string complete = load + "[continuum]\nyoung_modulus = 1\npoisson_ratio = 0.3\ndensity = 1\n";
  const std::string contact = "[material]\ndensity = 1\n[contact]\nnormal_stiffness = 1\nstiffness_ratio = 1\n";
  for (const std::string& discs : {packing + "[probes]\ndiscs = [1, 2]\n", std::string("[assembly]\npacking = \"file\"\nfile = \"discs.csv\"\n"),
                                   std::string("[assembly]\npacking = \"hexagonal\"\ncolumns = 9\nrows = 4\nradius = 1\n")}) {
    EXPECT_FALSE(parse(discs + complete, Purpose::continuum)) << discs;
  }
  EXPECT_TRUE(parse(packing + "[probes]\ndiscs = [1, 2]\n" + complete + contact, Purpose::continuum));
}

TEST(Scene, DottedKeysInlineTablesCarriageReturnsAndByteOrderMarksAreToml) {
  std::string crlf = "\xEF\xBB\xBF";
  for (const char c : small_scene()) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_TRUE(parse(crlf));
  const SceneResult dotted = parse(
      "assembly.packing = \"random\"\nassembly.length = 1\nassembly.width = 1\nassembly.discs = 9\n"
      "material = {density = 1}\ncontact = {normal_stiffness = 1, stiffness_ratio = 0}\n"
      "drive = {wave = \"shear\", duration = 1, amplitude = 1}\n");
  ASSERT_TRUE(dotted) << to_string(dotted.violations);
  EXPECT_EQ(dotted->material->density, 1.0);
}

}  // namespace
}  // namespace ddem::harness::test
