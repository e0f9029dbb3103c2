// pair_style ddem: discs that are not bonded and touch move as the built-in solver says, and what users of LAMMPS rely on.

#include <cmath>
#include <ostream>

#include "harness/solvers/lammps_ddem.h"
#include "harness/solvers/ready.h"
#include "tests/harness/solvers/lammps_runs.h"
#include "tests/support/assemblies.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;

constexpr const char* kNonlinear = "kinematics = \"nonlinear\"\n";

struct Case {
  const char* name;
  StripScene scene;
  double displacements = 1e-13;  // as without contacts (lammps_laws_test.cc): forces are continuous where a gap closes
};

void PrintTo(const Case& c, std::ostream* to) { *to << c.name; }

std::vector<Case> cases() {
  StripScene modulus = touching(), driven = touching(lagged("full"), "", "periodic");
  modulus.contact = "contact_modulus = 1e14\n";
  driven.load = kShearDrive;
  return {{"rigid", touching()},
          {"rigid_periodic", touching("", "", "periodic")},
          {"rigid_modulus", modulus},
          {"normal", touching(lagged("normal"))},
          {"full", touching(lagged("full"), "", "periodic")},
          {"normal_only_stress", touching(lagged("normal_only_stress"))},
          {"evaluations", touching(lagged("full", "evaluations = 3\nrelaxation = 0.7\n"))},
          {"full_driven", driven},
          {"nonlinear", touching("", kNonlinear, "periodic"), 1e-12},
          {"nonlinear_full", touching(lagged("full"), kNonlinear), 1e-12}};
}

/// What the built-in solver finds, and that contacts have their part in it.
Motion by_builtin_touching(const PreparedRun& run) {
  const SimulationResult result = builtin_solver().solve(run.run.assembly, run.input);
  EXPECT_TRUE(result.new_contacts.has_value());
  if (result.new_contacts) { EXPECT_GT(result.new_contacts->most, 10u); }
  PreparedRun without = run;
  without.input.new_contacts = ContactWatch::off;
  const Motion motion = by_builtin(run);
  EXPECT_GT(difference(motion.u, by_builtin(without).u), 1e-3);
  return motion;
}

class OnLammpsContact : public OnLammps, public testing::WithParamInterface<Case> {};

TEST_P(OnLammpsContact, MovesAsTheBuiltInSolverSays) {
  const PreparedRun run = shaken(GetParam().scene);
  const Motion ours = by_builtin_touching(run);
  for (const int ranks : {1, 2, 4}) {
    for (const Edit& edit : {Edit(), Edit(newton_on)}) {
      if (ranks == 4 && edit) continue;  // ContactsChangeRanks has both
      const Motion theirs = by_lammps(run, ranks, edit);
      EXPECT_LT(difference(ours.u, theirs.u), GetParam().displacements) << ranks << (edit ? ", newton on" : "");
      EXPECT_LT(difference(ours.theta, theirs.theta), 10.0 * GetParam().displacements) << ranks << (edit ? ", newton on" : "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, OnLammpsContact, testing::ValuesIn(cases()), [](const auto& law) { return law.param.name; });


void expect_as_builtin(const PreparedRun& run, double displacements) {
  const Motion ours = by_builtin(run);
  PreparedRun without = run;
  without.input.new_contacts = ContactWatch::off;
  EXPECT_GT(difference(ours.u, by_builtin(without).u), 1e-3);
  for (const int ranks : {1, 2}) EXPECT_LT(difference(ours.u, by_lammps(run, ranks).u), displacements) << ranks;
}

/// While no gap can have closed no pair is looked at: here the narrowest is wide at first, and motion closes it. Discs that are
/// displaced at first have ghosts across the period.
TEST_F(OnLammps, MotionClosesAGap) {
  StripScene scene = touching("", "", "periodic");
  scene.assembly += "coordination = 4.4\n";
  scene.load = "[initial]\nwave = \"longitudinal\"\nshape = \"column\"\namplitude = \"100 um\"\n";
  expect_as_builtin(prepared(scene), 1e-13);
}

/// ... and here a strain: nothing moves but the disc that is pushed off.
TEST_F(OnLammps, AStrainAloneClosesAGap) {
  PreparedRun run = prepared(touching(lagged("full")));
  run.run.assembly = ddem::test::three_discs(1e-4, 2e-8);
  SimulationInput& in = run.input;
  in.initial = {.ux = {-1e-6, 0.0, 0.0}, .uy = {}, .theta = {}, .vx = {}, .vy = {}, .omega = {}};
  in.held.x = in.held.y = in.held.theta = {1, 1, 0};
  in.receivers = {{{0}}, {{1}}, {{2}}};
  in.time_step = 1e-8;
  expect_as_builtin(run, 1e-13);
}

/// Whoever keeps a bond, and whatever LAMMPS leaves out of its lists: pairs that are bonded are no contacts, all others are.
TEST_F(OnLammps, BondedPairsAreNoContacts) {
  const PreparedRun run = shaken(touching(lagged("full"), "", "periodic"));
  const Motion ours = by_builtin_touching(run);
  for (const auto& [old, by] : {std::pair{"newton off", "newton on off"},
                                {"newton off", "newton off on"},
                                {"lj/coul 1 1 1", "lj/coul 0 1 1"},
                                {"lj/coul 1 1 1", "lj/coul 0.5 0.5 0.5"},
                                {"pair_style ddem", "pair_style hybrid/overlay zero 1e-4 ddem"}}) {
    const Motion theirs = by_lammps(run, 2, [old = std::string(old), by = std::string(by)](std::string script) {
      if (by.starts_with("pair_style")) script = replaced(std::move(script), "pair_coeff * *", "pair_coeff * * zero\npair_coeff * * ddem");
      return replaced(std::move(script), old, by);
    });
    EXPECT_LT(difference(ours.u, theirs.u), 1e-13) << by;
    EXPECT_LT(difference(ours.theta, theirs.theta), 1e-12) << by;
  }
}

/// Lists made anew every ten steps, while cuts between ranks move, and discs with them.
TEST_F(OnLammps, ContactsChangeRanks) {
  for (const char* contact : {"", kNonlinear}) {
    const PreparedRun run = shaken(touching(lagged("full"), contact, "periodic"));
    const Motion ours = by_builtin_touching(run);
    for (const bool newton : {false, true}) {
      const Motion theirs = by_lammps(run, 4, [newton](std::string script) {
        script = replaced(std::move(script), "every 1 check yes", "every 10 check no");
        script = replaced(std::move(script), "run 400\n",
                          "variable w atom \"1 + 0.8 * sin(step * 0.05 + x * 2000)\"\nfix cuts all balance 20 1.0 shift xy 10 1.0 weight var w\nrun 400\n");
        return newton ? newton_on(std::move(script)) : script;
      });
      EXPECT_LT(difference(ours.u, theirs.u), 1e-12) << contact << newton;
      EXPECT_LT(difference(ours.theta, theirs.theta), 1e-11) << contact << newton;
    }
  }
}

/// Forces at the setup of a run leave strains as they are, and add up in the same order.
TEST_F(OnLammps, PiecesWithContactsHaveTheBitsOfOneRun) {
  const PreparedRun run = shaken(touching(lagged("full"), "", "periodic"));
  for (const int ranks : {1, 2}) {
    const Motion whole = by_lammps(run, ranks);
    const Motion pieces = by_lammps(run, ranks, [](std::string script) { return replaced(std::move(script), "run 400\n", "run 110\nrun 0\nrun 1\nrun 289\n"); });
    EXPECT_EQ(pieces.u, whole.u) << ranks;
    EXPECT_EQ(pieces.theta, whole.theta) << ranks;
  }
}

/// Stiffness and reach of pairs are in the file.
TEST_F(OnLammps, RunsWithContactsGoOnFromARestart) {
  for (const char* contact : {"", kNonlinear}) {
    const PreparedRun run = shaken(touching(lagged("full"), contact, "periodic"));
    const Motion whole = by_lammps(run);
    const LammpsFolder folder(run);
    ASSERT_TRUE(folder.run(2, [](std::string script) { return replaced(std::move(script), "run 400\n", "run 150\nrun 50\nwrite_restart state.restart\n"); }).succeeded());
    const SubprocessResult done = folder.run(1, [](const std::string& script) {
      const std::string rest = replaced(replaced(script.substr(script.find("fix ddem")), " displacement v_ux NULL NULL", ""), "run 400\n", "run 200\n");
      return "comm_modify cutoff 6e-4\nneighbor 1e-4 bin\nneigh_modify delay 0 every 1 check yes\natom_modify map array\nread_restart state.restart\n" + rest;
    });
    ASSERT_TRUE(done.succeeded()) << done.standard_output;
    const Motion rest = folder.motion();
    ASSERT_EQ(rest.theta.size(), 11u * 10u);
    const auto tail = [](const std::vector<double>& values, std::size_t size) { return std::vector<double>(values.end() - static_cast<std::ptrdiff_t>(size), values.end()); };
    EXPECT_LT(difference(tail(whole.u, rest.u.size()), rest.u), 1e-12) << contact;
    EXPECT_LT(difference(tail(whole.theta, rest.theta.size()), rest.theta), 1e-11) << contact;
  }
}

/// Of pairs, of bonds, and of motion and turning: the sum oscillates by the square of the step, and does not drift, although
/// contacts that close and open bend the potential.
TEST_F(OnLammps, EnergiesWithContactsAddUp) {
  for (const char* contact : {"", kNonlinear}) {
    std::vector<double> changes;
    for (const double fraction : {0.1, 0.05}) {
      StripScene scene = touching("", contact);
      scene.step_fraction = fraction, scene.steps = static_cast<int>(80.0 / fraction);
      double first = 0.0, change = 0.0, most = 0.0;
      for (const std::vector<double>& row : thermo(shaken(scene), 2, "", "evdwl ebond f_ddem[1] f_ddem[2]")) {
        ASSERT_EQ(row.size(), 5u);
        const double all = row[1] + row[2] + row[3] + row[4];
        if (first == 0.0) first = all;
        change = std::max(change, std::abs(all / first - 1.0));
        most = std::max(most, row[1] / all);
      }
      EXPECT_GT(most, 0.01) << contact;
      changes.push_back(change);
    }
    EXPECT_LT(changes[0], 1e-2) << contact;
    EXPECT_LT(changes[1], changes[0] / 2.5) << contact;
  }
}

/// The virial of pairs and bonds is minus the sum of the discs' s (x) F, found by the loop that makes their strains; of single discs
/// as well, with the contacts' parts of both halves. Energies of single pairs add up to that of all.
TEST_F(OnLammps, StressOfContactsIsInTheVirial) {
  const PreparedRun run = shaken(touching(lagged("full"), "", "periodic"));
  for (const Edit& edit : {Edit(), Edit(newton_on)}) {
    for (const int ranks : {1, 2}) {
      const auto rows = thermo(run, ranks,
                               "compute p all pressure NULL pair bond\ncompute s all reduce sum f_ddem[7] f_ddem[8] f_ddem[9]\n"
                               "compute a all stress/atom NULL pair bond\ncompute sa all reduce sum c_a[1] c_a[2] c_a[4]\n"
                               "compute e all pe/atom pair\ncompute se all reduce sum c_e\n"
                               "compute l all pair/local eng\n"  // newer ones want to know what is summed
                               "if \"$(version) > 20230000\" then \"compute sl all reduce sum c_l inputs local\" else \"compute sl all reduce sum c_l\"\n",
                               "vol c_p[1] c_p[2] c_p[4] c_s[1] c_s[2] c_s[3] c_sa[1] c_sa[2] c_sa[3] evdwl c_se c_sl", edit);
      ASSERT_GT(rows.size(), 10u);
      double largest = 0.0, apart = 0.0, energy = 0.0, energy_apart = 0.0;
      for (const auto& row : rows) {
        ASSERT_EQ(row.size(), 14u);
        for (std::size_t k = 2; k < 5; ++k) {
          largest = std::max(largest, std::abs(row[k + 3]));
          apart = std::max({apart, std::abs(row[k] * row[1] + row[k + 3]), std::abs(row[k + 6] - row[k + 3])});
        }
        energy = std::max(energy, row[11]);
        energy_apart = std::max({energy_apart, std::abs(row[12] - row[11]), std::abs(row[13] - row[11])});
      }
      EXPECT_GT(largest, 0.0);
      EXPECT_LT(apart, 1e-12 * largest);
      EXPECT_GT(energy, 0.0);
      EXPECT_LT(energy_apart, 1e-12 * energy);
    }
  }
}

/// What nobody looked at is not left out silently.
TEST_F(OnLammps, ContactsThatNoListKnowsAreRefused) {
  PreparedRun run = shaken(touching());
  for (double& v : run.input.initial.vx) v *= 20.0;
  const LammpsFolder folder(run);
  const SubprocessResult done = folder.run(2, [](std::string script) { return replaced(std::move(script), "delay 0 every 1 check yes", "once yes"); });
  EXPECT_FALSE(done.succeeded());
  EXPECT_THAT(done.standard_output + done.standard_error, HasSubstr("renew the lists more often"));
}

TEST_F(OnLammps, WrongPairCommandsSayWhatToWrite) {
  const PreparedRun run = shaken(touching(lagged("full")));
  const LammpsFolder folder(run);
  for (const auto& [old, by, said] : {std::array{"pair_coeff * * 1", "pair_coeff 1 1 1e10\npair_coeff 2* 2* 1", "has no pair_coeff"},
                                      {"pair_coeff * * 1", "pair_coeff * * -1", "must be above 0"},
                                      {"pair_style ddem ", "pair_style ddem 1e-5 ", "give by how much strains"},
                                      {"pair_style ddem ", "pair_style ddem -", "at least 0"}}) {
    const SubprocessResult done = folder.run(1, [old = old, by = by](std::string script) { return replaced(std::move(script), old, by); });
    EXPECT_FALSE(done.succeeded()) << by;
    EXPECT_THAT(done.standard_output, HasSubstr(said));
  }
  const SubprocessResult implicit = folder.run(1, [](std::string script) { return replaced(std::move(script), "strain lagged full", "weights 1 1 strain implicit full"); });
  EXPECT_FALSE(implicit.succeeded());
  EXPECT_THAT(implicit.standard_output, HasSubstr("implicit strains know of bonds only"));
}

TEST_F(OnLammps, ASolverTakesNewContacts) {
  PreparedRun run = shaken(touching(lagged("full"), "", "periodic"));
  run.input.energy_samples = 0;
  const auto solver = lammps_ddem_solver({kLammps, 2});
  EXPECT_EQ(refusal(*solver, run.run.assembly, run.input), "");
  const SimulationResult theirs = solver->solve(run.run.assembly, run.input), ours = builtin_solver().solve(run.run.assembly, run.input);
  for (std::size_t r = 0; r < ours.signals.ux.size(); ++r) EXPECT_LT(difference(ours.signals.ux[r], theirs.signals.ux[r]), 1e-12);
  run.input.deformation.scheme = Scheme::implicit;
  EXPECT_THAT(refusal(*solver, run.run.assembly, run.input), HasSubstr("implicit strains with new contacts"));
}

}  // namespace
}  // namespace ddem::harness::test
