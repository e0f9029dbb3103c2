// What is told of memory beforehand, against what the program takes.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "harness/model/memory_need.h"
#include "harness/run/fem_plan.h"
#include "harness/scene/read_scene.h"
#include "tests/harness/cli/program.h"
#include "tests/support/sanitized.h"

namespace ddem::harness::test {
namespace {

/// Most bytes at once of `ddem ARGUMENTS`.
double bytes_taken(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), DDEM_PROGRAM);
  std::vector<char*> words;
  for (std::string& a : arguments) words.push_back(a.data());
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    ::execv(DDEM_PROGRAM, words.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  EXPECT_EQ(status, 0) << testing::PrintToString(arguments);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

class MemoryNeed : public Cli {
 protected:
  /// Of `ddem COMMAND scene.toml` over what is told of its discs.
  double taken_over_told(const std::vector<std::string>& command, const std::string& tables, Purpose purpose, DiscWork work, int rows = 100) const {
    write("scene.toml", "[assembly]\npacking = \"hexagonal\"\ncolumns = 120\nrows = " + std::to_string(rows) + "\nradius = \"0.1 mm\"\n" + tables);
    const SceneResult scene = read_scene(path("scene.toml"), {purpose});
    EXPECT_TRUE(scene) << to_string(scene.violations);
    const double told = memory_of_discs(*scene, planned_discs(*scene).value(), work).bytes;
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.begin() + 1, path("scene.toml"));
    return (bytes_taken(arguments) - bytes_taken({"--version"})) / told;
  }
};

const std::string solid =
    "[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.25\n[boundary]\ntop_bottom = \"periodic\"\n";

// Less than half would let a machine run out of it; more than twice would refuse what fits.
void expect_near_one(double ratio, const std::string& what) { EXPECT_TRUE(ratio > 0.5 && ratio < 2.0) << what << ": " << ratio; }

TEST_F(MemoryNeed, IsWhatDiscsTake) {
  if (ddem::test::kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  const std::string moved = solid + "[drive]\nwave = \"shear\"\nduration = 1e-6\namplitude = 1e-8\n[time]\nsteps = 20\n[probes]\ndiscs = [5, 9]\n";
  const std::string soft = "[deformation]\ncorrection = \"full\"\nyoung_modulus = 4e10\npoisson_ratio = 0.3\nscheme = ";
  expect_near_one(taken_over_told({"pack", "-o", path("discs.csv")}, "", Purpose::packing, DiscWork::packing), "pack");
  expect_near_one(taken_over_told({"run"}, moved, Purpose::simulation, DiscWork::simulation), "run");
  expect_near_one(taken_over_told({"run"}, moved + soft + "\"lagged\"\n", Purpose::simulation, DiscWork::simulation), "run, lagged");
  expect_near_one(taken_over_told({"run"}, moved + soft + "\"implicit\"\n", Purpose::simulation, DiscWork::simulation), "run, implicit");
  const std::string large_step = replaced(moved, "steps = 20", "step_fraction = 0.85\nsteps = 20");
  expect_near_one(taken_over_told({"run"}, large_step + soft + "\"lagged\"\n", Purpose::simulation, DiscWork::limits), "run, lagged, near its limit");
  expect_near_one(taken_over_told({"moduli"}, solid, Purpose::statics, DiscWork::statics), "moduli");
  expect_near_one(taken_over_told({"moduli"}, solid + soft + "\"lagged\"\n", Purpose::statics, DiscWork::statics), "moduli of deformable discs");
  expect_near_one(taken_over_told({"moduli"}, solid, Purpose::statics, DiscWork::statics, 300), "moduli of many");
  expect_near_one(taken_over_told({"moduli"}, solid + soft + "\"lagged\"\n", Purpose::statics, DiscWork::statics, 300), "moduli of many deformable discs");
}

/// With the tables and the HDF5 file, which are made in memory. What more samples, probes and snapshots take, beside few.
TEST_F(MemoryNeed, IsWhatSignalsAndSnapshotsTake) {
  if (ddem::test::kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  std::string probes = "0";
  for (int d = 1; d < 60; ++d) probes += fmt::format(", {}", d);
  const auto scene = [&](const std::string& discs, int steps) {
    return "[assembly]\npacking = \"hexagonal\"\n" + discs + "radius = \"0.1 mm\"\n" + solid +
           fmt::format("[drive]\nwave = \"shear\"\nduration = 1e-6\namplitude = 1e-8\n[time]\nsteps = {}\n[probes]\ndiscs = [{}]\n", steps, probes);
  };
  const auto taken = [&](const std::string& text, const std::vector<std::string>& more) {
    write("scene.toml", text);
    std::vector<std::string> words = {"run", path("scene.toml")};
    words.insert(words.end(), more.begin(), more.end());
    return bytes_taken(words);
  };
  const std::string small = "columns = 30\nrows = 8\n", large = "columns = 120\nrows = 100\n";
  for (const std::vector<std::string>& files : {std::vector<std::string>{}, {"-o", path("a.h5")}, {"--signals", path("a.csv")}, {"-o", path("a.h5"), "--signals", path("a.csv")}}) {
    const double signals = taken(scene(small, 20000), files) - taken(scene(small, 100), files);
    expect_near_one(signals / memory_of_samples(20000.0, 60.0, files.size() > 0 && files[files.size() - 2] == "--signals"), testing::PrintToString(files));
  }
  const double snapshots = taken(scene(large, 150), {"-o", path("a.h5"), "--snapshots", "150"}) - taken(scene(large, 150), {});
  expect_near_one(snapshots / memory_of_snapshots(12000.0, 150), "snapshots");
}

#ifdef DDEM_HAS_FEM
TEST_F(MemoryNeed, IsWhatTheContinuumTakes) {
  if (ddem::test::kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  std::string points = "[1e-3, 1e-3]";
  for (int k = 1; k < 60; ++k) points += fmt::format(", [{}, 1e-3]", 1e-3 + 1e-4 * k);
  const auto taken_and_told = [&](const char* elements, const std::string& time) {
    write("fem.toml", fmt::format("[assembly]\nlength = 0.01\nwidth = 0.002\n[boundary]\ntop_bottom = \"periodic\"\n[drive]\nwave = \"shear\"\nduration = 1e-6\namplitude = 1e-8\n"
                                  "[continuum]\nyoung_modulus = 1e10\npoisson_ratio = 0.25\ndensity = 2000\ndegree = 4\nelements = {}\n[time]\nintegrator = \"verlet\"\n{}\n"
                                  "[probes]\npoints = [{}]\n",
                                  elements, time, points));
    const FemCase fem = plan_fem(*read_scene(path("fem.toml"), {Purpose::continuum}), {}).fem;
    return std::pair(bytes_taken({"fem", path("fem.toml")}), memory_of_elements(fem) + memory_of_signals(fem));
  };
  const auto [few, told_few] = taken_and_told("[5, 1]", "step = 1e-9\nend = 1e-7");
  const auto [samples, told_samples] = taken_and_told("[5, 1]", "step = 1e-9\nend = 4e-5");
  expect_near_one((samples - few) / (told_samples - told_few), "samples");
  const auto [elements, told_elements] = taken_and_told("[300, 60]", "step = 1e-9\nend = 1e-8");
  expect_near_one((elements - few) / (told_elements - told_few), "elements");
  // Of a step that is a share of the critical one, as many samples as there are at least.
  const auto [fraction, told_fraction] = taken_and_told("[5, 1]", "step_fraction = 0.002\nend = 2e-5");
  EXPECT_GT((fraction - few) / (told_fraction - told_few), 0.5);
}
#endif

/// Of the packing, with the statics of as many variants at a time as there are cores.
TEST_F(MemoryNeed, IsWhatCalibrationTakes) {
  if (ddem::test::kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  write("scene.toml", "[assembly]\npacking = \"hexagonal\"\ncolumns = 60\nrows = 40\nradius = \"0.1 mm\"\nperiodic = \"xy\"\n");
  const std::vector<std::string> command = {"calibrate", "--young", "30 GPa", "--poisson", "0.25", "--density", "2400", "--assembly", path("scene.toml")};
  const double taken = bytes_taken(command) - bytes_taken({"--version"});
  expect_near_one(taken / memory_of_packings(2400.0, 1, std::min(6, static_cast<int>(std::thread::hardware_concurrency()))), "calibrate");
}

/// A little more than there is, not only what no machine has.
TEST_F(MemoryNeed, BeyondTheLimitOfTheProcessIsRefused) {
  if (ddem::test::kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  write("scene.toml", "[assembly]\npacking = \"hexagonal\"\ncolumns = 2000\nrows = 400\nradius = \"0.1 mm\"\n" + solid +
                          "[drive]\nwave = \"shear\"\nduration = 1e-6\namplitude = 1e-8\n[time]\nsteps = 20\n[probes]\ndiscs = [5, 9]\n");
  const auto run = run_program("/bin/sh", {"-c", "ulimit -v 800000; exec \"$0\" run \"$1\"", DDEM_PROGRAM, path("scene.toml")});
  EXPECT_EQ(run.exit_code, 2) << run.standard_error;
  EXPECT_THAT(run.standard_error, testing::HasSubstr("would take 1.2 GB of memory"));
  // 800 MB less what the program takes, over 1500 bytes.
  EXPECT_THAT(run.standard_error, testing::ContainsRegex("are left, enough for [345]\\.?[0-9]?e\\+05; take fewer discs"));
}

TEST_F(MemoryNeed, OfTheJobsOfACampaignIsToldBeforeAnyRuns) {
  if (ddem::test::kSanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  write("scene.toml", "[assembly]\npacking = \"hexagonal\"\ncolumns = 2000\nrows = 400\nradius = \"0.1 mm\"\n" + solid +
                          "[drive]\nwave = \"shear\"\nduration = 1e-6\namplitude = 1e-8\n[time]\nsteps = 20\n[probes]\ndiscs = [5, 9]\n");
  write("cases.toml", "[[case]]\nid = \"a\"\nscene = \"scene.toml\"\n[case.matrix]\n\"contact.stiffness_ratio\" = [0.1, 0.2, 0.3]\n[[case.criterion]]\nmetric = \"bonds\"\nlower = 1\n"
                      "derivation = \"d\"\n");
  // 1.2 GB each.
  const auto run = run_program("/bin/sh", {"-c", "ulimit -v 2900000; exec \"$0\" validate \"$1\" -j 3 -o \"$2\"", DDEM_PROGRAM, path("cases.toml"), path("out")});
  EXPECT_EQ(run.exit_code, 2) << run.standard_error;
  EXPECT_THAT(run.standard_error, testing::HasSubstr("--jobs: 3 of the campaign's simulations at a time would take 3.6 GB of memory, and "));
  EXPECT_THAT(run.standard_error, testing::HasSubstr("take --jobs 2"));
  EXPECT_TRUE(contents().count("out/summary.json") == 0);
}

}  // namespace
}  // namespace ddem::harness::test
