// Every law moves as the built-in solver says. Sums have other orders there: a difference of round-off, 2e-16 a step and term,
// summed as a random walk over hundreds of steps and half a dozen bonds, 1e-14; tolerances leave ten times that.

#include <fmt/format.h>

#include <ostream>

#include "tests/harness/solvers/lammps_runs.h"

namespace ddem::harness::test {
namespace {

constexpr double kDisplacements = 1e-13, kRotations = 1e-12;

struct Case {
  const char* name;
  StripScene scene;
  double displacements = kDisplacements;
};

StripScene strip(const std::string& deformation, const char* edges = "free", double ratio = 0.25) {
  StripScene s;
  s.deformation = deformation, s.edges = edges, s.ratio = ratio;
  return s;
}

StripScene with(StripScene s, const std::function<void(StripScene&)>& change) {
  change(s);
  return s;
}

std::vector<Case> cases() {
  const auto driven = [](StripScene& s) { s.load = kShearDrive; };
  const auto nonlinear = [](StripScene& s) { s.contact += "kinematics = \"nonlinear\"\n"; };
  const auto stiffer = [](StripScene& s) { s.thickness = "0.7"; };
  return {{"rigid", strip("")},
          {"rigid_periodic", strip("", "periodic", 0.6)},
          {"rigid_without_shear", strip("", "free", 0.0)},
          {"rigid_driven", with(strip("", "periodic"), driven)},
          {"rigid_modulus", with(strip(""), [](StripScene& s) { s.contact = "contact_modulus = \"20 GPa\"\n"; })},
          {"normal", strip(lagged("normal"))},
          {"full", strip(lagged("full"), "periodic")},
          {"normal_only_stress", strip(lagged("normal_only_stress"))},
          {"full_without_shear", strip(lagged("full"), "free", 0.0)},
          {"full_driven", with(strip(lagged("full"), "periodic"), driven)},
          {"plane_strain_thin", with(strip(lagged("full", "plane = \"strain\"\n")), stiffer)},
          {"evaluations", strip(lagged("full", "evaluations = 3\nrelaxation = 0.7\n"))},
          {"cell_volume", strip(lagged("normal", "particle_volume = \"cell\"\n"), "periodic")},
          {"implicit_full", strip(implicit("full"), "periodic")},
          {"implicit_normal", strip(implicit("normal"))},
          {"implicit_normal_only_stress", strip(implicit("normal_only_stress"))},
          // Each step leaves round-off of a bond's length in its slip, where linear kinematics leaves that of its displacement.
          {"nonlinear", with(strip("", "periodic"), nonlinear), 1e-12},
          {"nonlinear_full", with(strip(lagged("full")), nonlinear), 1e-12},
          {"nonlinear_evaluations", with(strip(lagged("normal", "evaluations = 3\nrelaxation = 0.7\n")), nonlinear), 1e-12}};
}

void PrintTo(const Case& c, std::ostream* to) { *to << c.name; }

class OnLammpsLaw : public OnLammps, public testing::WithParamInterface<Case> {};

TEST_P(OnLammpsLaw, MovesAsTheBuiltInSolverSays) {
  const PreparedRun run = prepared(GetParam().scene);
  const Motion ours = by_builtin(run);
  const bool turns = run.input.contact.has_rotation();
  const auto expect_alike = [&](const Motion& theirs, const std::string& how) {
    EXPECT_LT(difference(ours.u, theirs.u), GetParam().displacements) << how;
    if (turns) { EXPECT_LT(difference(ours.theta, theirs.theta), 10.0 * GetParam().displacements) << how; }
  };
  expect_alike(by_lammps(run), "one rank");
  expect_alike(by_lammps(run, 2), "two ranks");
  expect_alike(by_lammps(run, 2, newton_on), "two ranks, newton on");
}

INSTANTIATE_TEST_SUITE_P(All, OnLammpsLaw, testing::ValuesIn(cases()), [](const auto& law) { return law.param.name; });

/// 4 ranks, a border in each direction, of a lattice of 1e4 discs.
TEST_F(OnLammps, FourRanksShareALattice) {
  StripScene scene = strip(lagged("full"), "periodic", 0.5);
  scene.assembly = "packing = \"hexagonal\"\ncolumns = 200\nrows = 50\nradius = \"0.1 mm\"\nclose_packed_along = \"x\"\n";
  scene.discs = "0, 399, 4711, 9999";
  scene.load = kShearDrive;
  scene.steps = 200;
  const PreparedRun run = prepared(scene);
  const Motion ours = by_builtin(run);
  for (const Edit& edit : {Edit(), Edit(newton_on)}) {
    const Motion theirs = by_lammps(run, 4, edit);
    EXPECT_LT(difference(ours.u, theirs.u), kDisplacements);
    EXPECT_LT(difference(ours.theta, theirs.theta), kRotations);
  }
}

}  // namespace
}  // namespace ddem::harness::test
