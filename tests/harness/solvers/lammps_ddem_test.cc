// What users of the styles rely on besides the laws: runs in pieces, restart files, migration, other integrators, energies,
// stress; and that faults are seen.

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "harness/io/atomic_file.h"
#include "harness/io/digest.h"
#include "harness/io/errors.h"
#include "harness/solvers/lammps_ddem.h"
#include "harness/solvers/ready.h"
#include "tests/harness/solvers/lammps_runs.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

constexpr const char* kNonlinear = "kinematics = \"nonlinear\"\n";
constexpr const char* kDisplaced = " displacement v_ux NULL NULL";

StripScene soft_strip(const std::string& contact = "") {
  StripScene s;
  s.deformation = lagged("full"), s.edges = "periodic", s.contact += contact;
  return s;
}

TEST(Launcher, IsSrunWithinAJobOfSlurm) {
  ::unsetenv("SLURM_JOB_ID");
  EXPECT_TRUE(launcher(1).empty());
  EXPECT_EQ(launcher(4).front(), "mpirun");
  ::setenv("SLURM_JOB_ID", "1", 1);
  EXPECT_TRUE(launcher(1).empty());
  EXPECT_EQ(launcher(4), (std::vector<std::string>{"srun", "--ntasks={ranks}"}));
  ::unsetenv("SLURM_JOB_ID");
}

/// Forces at the setup of a run leave strains and slip as they are.
TEST_F(OnLammps, PiecesHaveTheBitsOfOneRun) {
  for (const char* contact : {"", kNonlinear}) {
    StripScene scene = soft_strip(contact);
    scene.deformation = lagged("full", "evaluations = 3\nrelaxation = 0.7\n");
    const PreparedRun run = prepared(scene);
    for (const int ranks : {1, 2}) {
      const Motion whole = by_lammps(run, ranks);
      const Motion pieces = by_lammps(run, ranks, [](std::string script) { return replaced(std::move(script), "run 400\n", "run 110\nrun 0\nrun 1\nrun 289\n"); });
      EXPECT_EQ(pieces.u, whole.u) << contact << ranks;
      EXPECT_EQ(pieces.theta, whole.theta) << contact << ranks;
    }
  }
}

/// On another number of ranks: all that a disc and a bond remember is in the file.
TEST_F(OnLammps, RestartedRunsGoOn) {
  for (const char* contact : {"", kNonlinear}) {
    const PreparedRun run = prepared(soft_strip(contact));
    const Motion whole = by_lammps(run);
    const LammpsFolder folder(run);
    ASSERT_TRUE(folder.run(2, [](std::string script) { return replaced(std::move(script), "run 400\n", "run 200\nwrite_restart state.restart\n"); }).succeeded());
    const SubprocessResult done = folder.run(1, [](const std::string& script) {
      const std::string rest = replaced(replaced(script.substr(script.find("fix ddem")), kDisplaced, ""), "run 400\n", "run 200\n");
      return "comm_modify cutoff 6e-4\nneighbor 1e-4 bin\natom_modify map array\nread_restart state.restart\n" + rest;
    });
    ASSERT_TRUE(done.succeeded()) << done.standard_output;
    const Motion rest = folder.motion();
    ASSERT_EQ(rest.theta.size(), 11u * 10u);
    const auto tail = [](const std::vector<double>& values, std::size_t size) { return std::vector<double>(values.end() - static_cast<std::ptrdiff_t>(size), values.end()); };
    EXPECT_LT(difference(tail(whole.u, rest.u.size()), rest.u), 1e-12) << contact;
    EXPECT_LT(difference(tail(whole.theta, rest.theta.size()), rest.theta), 1e-11) << contact;
  }
}

/// Cuts between ranks move every 20 steps, and discs with them from rank to rank.
TEST_F(OnLammps, DiscsChangeRanks) {
  const auto moving = [](std::string script) {
    script = replaced(std::move(script), "neigh_modify once yes", "neigh_modify delay 0 every 10 check no");
    return replaced(std::move(script), "run 400\n", "variable w atom \"1 + 0.8 * sin(step * 0.05 + x * 2000)\"\nfix cuts all balance 20 1.0 shift xy 10 1.0 weight var w\nrun 400\n");
  };
  for (const char* contact : {"", kNonlinear}) {
    const PreparedRun run = prepared(soft_strip(contact));
    const Motion still = by_lammps(run);
    for (const bool newton : {false, true}) {
      const LammpsFolder folder(run);
      const SubprocessResult done = folder.run(4, [&](std::string script) { return moving(newton ? newton_on(std::move(script)) : std::move(script)); });
      ASSERT_TRUE(done.succeeded()) << done.standard_output;
      EXPECT_LT(difference(still.u, folder.motion().u), 1e-12) << contact << newton;
      EXPECT_LT(difference(still.theta, folder.motion().theta), 1e-11) << contact << newton;
    }
  }
}

/// An integrator of LAMMPS' own in the place of that of the fix; with the inertia of spheres, 4/5 of the discs', it is seen.
TEST_F(OnLammps, OtherIntegratorsMoveDiscs) {
  const PreparedRun run = prepared(soft_strip());
  const Motion ours = by_lammps(run);
  const auto integrated = [&](const std::string& by) {
    return by_lammps(run, 2, [&](std::string script) {
      script = replaced(std::move(script), "fix ddem all", "fix hold held_x setforce 0 NULL NULL\nfix nve all " + by + "\nfix ddem all");
      return replaced(std::move(script), " hold x held_x", " integrate no");
    });
  };
  const Motion theirs = integrated("nve/sphere disc");
  EXPECT_LT(difference(ours.u, theirs.u), 1e-13);
  EXPECT_LT(difference(ours.theta, theirs.theta), 1e-12);
  EXPECT_GT(difference(ours.theta, integrated("nve/sphere").theta), 1e-2);
}

/// Contact, strain and kinetic energy, of motion and of turning: their sum oscillates by the square of the step, and does not drift.
TEST_F(OnLammps, EnergiesAddUp) {
  for (const std::string& law : {std::string(), implicit("full"), implicit("normal_only_stress")}) {
    StripScene scene;
    scene.deformation = law;
    scene.load = "[initial]\nwave = \"longitudinal\"\nshape = \"cosine\"\nwidth = \"2 mm\"\namplitude = \"1 um\"\n";
    std::vector<double> changes;
    for (const double fraction : {0.2, 0.1}) {
      scene.step_fraction = fraction, scene.steps = static_cast<int>(80.0 / fraction);
      double first = 0.0, change = 0.0;
      for (const std::vector<double>& row : thermo(prepared(scene), 2, "", "ebond f_ddem f_ddem[1] f_ddem[2]")) {
        ASSERT_EQ(row.size(), 5u);
        const double all = row[1] + row[2] + row[3] + row[4];
        if (first == 0.0) first = all;
        change = std::max(change, std::abs(all / first - 1.0));
        if (!law.empty()) { EXPECT_GT(row[2], 0.01 * row[1]); }
      }
      changes.push_back(change);
    }
    EXPECT_LT(changes[0], 1e-2) << law;
    EXPECT_NEAR(changes[0] / changes[1], 4.0, 0.6) << law;
  }
}

/// The virial, found from bonds, is minus the sum of the discs' s (x) F, found by the loop that makes their strains.
TEST_F(OnLammps, StressIsTheVirial) {
  const PreparedRun run = prepared(soft_strip());
  for (const int ranks : {1, 2}) {
    const auto rows = thermo(run, ranks, "compute p all pressure NULL bond\ncompute s all reduce sum f_ddem[7] f_ddem[8] f_ddem[9]\n",
                             "vol c_p[1] c_p[2] c_p[4] c_s[1] c_s[2] c_s[3]");
    ASSERT_GT(rows.size(), 10u);
    double largest = 0.0, apart = 0.0;
    for (const auto& row : rows) {
      ASSERT_EQ(row.size(), 8u);
      for (std::size_t k = 2; k < 5; ++k) {
        largest = std::max(largest, std::abs(row[k + 3]));
        apart = std::max(apart, std::abs(row[k] * row[1] + row[k + 3]));
      }
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_LT(apart, 1e-12 * largest);
  }
}

TEST_F(OnLammps, WrongCommandsSayWhatToWrite) {
  const PreparedRun run = prepared(soft_strip());
  const LammpsFolder folder(run);
  for (const auto& [old, by, said] : {std::array{"lagged full", "lagged fall", "the correction is fall; there are full, normal, normal-only-stress"},
                                      {"hold x held_x", "hold x nobody", "there is no group nobody"},
                                      {"ddem linear", "ddem curved", "give linear or nonlinear"},
                                      {"strain lagged", "strain implicit", "need weights"},
                                      {" plane stress", " plain stress", "there is no keyword plain; there are hold"},
                                      {"bond_style ddem linear", "bond_style none", "give bond_style ddem before it"}}) {
    const SubprocessResult done = folder.run(1, [old = old, by = by](std::string script) {
      if (std::string(by) == "bond_style none") script = replaced(std::move(script), "bond_coeff 1 10000000000 0.25\n", "");
      return replaced(std::move(script), old, by);
    });
    EXPECT_FALSE(done.succeeded()) << by;
    EXPECT_THAT(done.standard_output, HasSubstr(said));
  }
}

/// Ghosts that end before the longest bond does.
TEST_F(OnLammps, AShortReachOfGhostsIsSeen) {
  const PreparedRun run = prepared(soft_strip());
  const LammpsFolder folder(run);
  const SubprocessResult done = folder.run(2, [](const std::string& script) {
    const std::size_t at = script.find("comm_modify cutoff "), end = script.find('\n', script.find("neighbor ", at));
    return script.substr(0, at) + "comm_modify cutoff 5e-5\nneighbor 1e-6 bin" + script.substr(end);
  });
  EXPECT_FALSE(done.succeeded());
  EXPECT_THAT(done.standard_output + done.standard_error, HasSubstr("Bond atom"));
}

TEST_F(OnLammps, IsASolver) {
  PreparedRun run = prepared(soft_strip());
  run.input.energy_samples = 0;
  const auto solver = lammps_ddem_solver({kLammps, 2});
  EXPECT_THAT(solver->version(), HasSubstr("LAMMPS"));
  const SimulationResult theirs = solver->solve(run.run.assembly, run.input), ours = builtin_solver().solve(run.run.assembly, run.input);
  EXPECT_EQ(theirs.signals.time, ours.signals.time);
  for (std::size_t r = 0; r < ours.signals.ux.size(); ++r) EXPECT_LT(difference(ours.signals.ux[r], theirs.signals.ux[r]), 1e-12);
  EXPECT_GT(theirs.wall_seconds, 0.0);

  run.input.time_step *= 10.0;
  EXPECT_THROW(lammps_ddem_solver({kLammps, 1})->solve(run.run.assembly, run.input), SolverError);
}

#ifdef DDEM_OTHER_VERSION
TEST_F(OnLammps, AnotherVersionIsRefused) {
  const TemporaryFolder folder("ddem-lammps-test");
  const SubprocessResult done = run_confined("env", {"LD_PRELOAD=" DDEM_OTHER_VERSION, kLammps, "-in", "/dev/null", "-log", "none"}, {folder.path(), {}, 60.0});
  EXPECT_EQ(done.exit_code, 4) << done.status();
  EXPECT_THAT(done.standard_error, testing::AllOf(HasSubstr("this library is 20300101"), HasSubstr("build ddem-lammps anew")));
}
#endif

/// The stock program takes the styles through its Python, and moves discs to the same bits.
TEST_F(OnLammps, TheStockProgramLoadsTheStyles) {
#ifdef DDEM_LMP
  const PreparedRun run = prepared(soft_strip());
  const Motion ours = by_lammps(run);
  const LammpsFolder folder(run);
  const SubprocessResult done = folder.run(1, [](const std::string& script) { return "include " DDEM_STYLES "\n" + script; }, DDEM_LMP);
  if (done.standard_output.find("PYTHON") != std::string::npos && !done.succeeded()) GTEST_SKIP() << "this lmp has no Python: " << done.standard_output;
  ASSERT_TRUE(done.succeeded()) << done.standard_output << done.standard_error;
  EXPECT_EQ(folder.motion().u, ours.u);
#else
  GTEST_SKIP() << "no lmp on the PATH (Debian: lammps)";
#endif
}

#ifdef DDEM_PLUGIN_HOST
/// By LAMMPS' interface of plugins, to the same bits; a script that uses all three styles.
TEST_F(OnLammps, APluginHostIsGivenTheStyles) {
  const PreparedRun run = shaken(touching(lagged("full")));
  const Motion ours = by_lammps(run);
  const LammpsFolder folder(run);
  write_file(folder.path() / "in.test", folder.read(kLammpsScript));
  const SubprocessResult done = run_confined(DDEM_PLUGIN_HOST, {DDEM_PLUGIN, "-in", "in.test", "-log", "none"}, {folder.path(), {}, 60.0});
  ASSERT_TRUE(done.succeeded()) << done.standard_output << done.standard_error;
  for (const char* style : {"bond", "pair", "fix"}) EXPECT_THAT(done.standard_output, HasSubstr(std::string("registered: ") + style + " ddem, "));
  EXPECT_EQ(folder.motion().u, ours.u);
}

TEST_F(OnLammps, APluginHostOfAnotherVersionIsGivenNothing) {
  const TemporaryFolder folder("ddem-lammps-test");
  const SubprocessResult done = run_confined("env", {"LD_PRELOAD=" DDEM_OTHER_VERSION, DDEM_PLUGIN_HOST, DDEM_PLUGIN, "-in", "/dev/null", "-log", "none"}, {folder.path(), {}, 60.0});
  EXPECT_THAT(done.standard_error, testing::AllOf(HasSubstr("this is 20300101"), HasSubstr("build them anew")));
  EXPECT_THAT(done.standard_output, testing::Not(HasSubstr("registered")));
}
#endif

/// theory section 2: 2G of the lattice, variant F; a pulse of 10 diameters between samples of 1 % of the time that it takes.
TEST_F(OnLammps, TheExampleMeasuresItsWave) {
  const TemporaryFolder folder("ddem-lammps-test");
  const SubprocessResult done = run_confined(kLammps, {"-in", DDEM_SOURCES "/dem/lammps/example/in.pulse", "-log", "none"}, {folder.path(), {}, 120.0});
  ASSERT_TRUE(done.succeeded()) << done.standard_output;
  std::ifstream file(folder.path() / "sections.txt");
  double near = 0.0, far = 0.0, near_time = 0.0, far_time = 0.0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    std::istringstream words(line);
    double step = 0.0, us = 0.0, a = 0.0, b = 0.0;
    ASSERT_TRUE(words >> step >> us >> a >> b) << line;
    if (a > near) near = a, near_time = us;
    if (b > far) far = b, far_time = us;
  }
  const double pi = std::numbers::pi, k_n = 1e10, ratio = 0.25, young = 4e10, nu = 0.3, density = 2000.0;
  const double a = 2.0 * std::sqrt(3.0) * k_n, fraction = pi / (2.0 * std::sqrt(3.0)), disc = young / (1.0 + nu);
  const double shear = a * (1.0 + ratio) / 4.0, twice_g = shear / (1.0 + shear / (fraction * disc));
  const double speed = std::sqrt(0.5 * twice_g / (density * fraction));
  EXPECT_NEAR(50.0 * 2e-4 / (far_time - near_time) * 1e6, speed, 0.015 * speed);
}

/// Digests of the files as they were while their text was made in one piece: 8000 discs are many pieces.
TEST(LammpsDdem, FilesAreThoseOfBefore) {
  StripScene scene;
  scene.assembly = "packing = \"hexagonal\"\ncolumns = 200\nrows = 40\nradius = \"0.1 mm\"\nclose_packed_along = \"x\"\n";
  scene.deformation = lagged("full"), scene.edges = "periodic", scene.thickness = "1.5", scene.load = kShearDrive, scene.discs = "0, 399, 4711";
  PreparedRun run = prepared(scene);
  run.input.time_step = 1e-8;
  const TemporaryFolder folder("ddem-lammps-test");
  write_lammps_ddem(folder.path(), {run.run.assembly, run.input, {}, ""});
  EXPECT_EQ(sha256_of_file(folder.path() / kLammpsData), "0f9d0069129da062a0a76128b52dbb135075b7d70d28a3d633b990875aa0bc11");
  EXPECT_EQ(sha256_of_file(folder.path() / kLammpsScript), "9f1641b43d04268dd50259e182e02d6d7dca36e260a1b04c7297849354b639fd");
}

TEST(LammpsDdem, RefusesWhatItCannotDo) {
  StripScene scene = soft_strip(kNonlinear);
  EXPECT_EQ(lammps_ddem_refusal(prepared(scene).run.assembly, prepared(scene).input), "");
  scene = soft_strip();
  scene.deformation = implicit("full") + "solver = \"conjugate_gradients\"\n";
  EXPECT_THAT(lammps_ddem_refusal(prepared(scene).run.assembly, prepared(scene).input), HasSubstr("polynomial"));
  PreparedRun long_bond = prepared(soft_strip());
  long_bond.run.assembly.bonds.length[0] = 0.6 * long_bond.run.assembly.packing.period.y;
  EXPECT_THAT(lammps_ddem_refusal(long_bond.run.assembly, long_bond.input), HasSubstr("twice the longest bond"));
  EXPECT_THROW(lammps_ddem_solver({"/no/such/ddem-lammps", 1}), MachineError);
}

}  // namespace
}  // namespace ddem::harness::test
