// Other programs as solvers, from outside: export, run --solver, measure.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "harness/io/json.h"
#include "harness/io/signals_csv.h"
#include "tests/harness/cli/numpy.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class OtherSolver : public Cli {
 protected:
  /// 200 discs by chance, periodic above and below, released at the left; `contact` and `more`: lines of tables; `probes`: a line.
  static std::string random_scene(double ratio, const std::string& deformation, const std::string& probes) {
    return fmt::format("[assembly]\npacking = \"random\"\nlength = \"7 mm\"\nwidth = \"1.4 mm\"\ndiscs = 200\nseed = 3\n[material]\ndensity = 2000\n"
                       "[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = {}\n{}[boundary]\ntop_bottom = \"periodic\"\n[drive]\nwave = \"shear\"\n"
                       "duration = \"1.2 us\"\namplitude = \"1 nm\"\n[probes]\n{}\n",
                       ratio, deformation, probes);
  }
  static std::string lagged(const char* correction) {
    return fmt::format("[deformation]\nscheme = \"lagged\"\ncorrection = \"{}\"\nyoung_modulus = 4e10\npoisson_ratio = 0.3\n", correction);
  }
  static std::string all_discs() {
    std::string list = "discs = [0";
    for (int d = 1; d < 200; ++d) list += fmt::format(", {}", d);
    return list + "]\n[time]\nend = \"2.5 us\"";
  }
  SignalTable signals(const std::string& scene, const std::string& solver) const {
    write("scene.toml", scene);
    const auto run = ddem({"run", path("scene.toml"), "--signals", path("s.csv"), "--solver", solver});
    EXPECT_EQ(run.exit_code, 0) << run.standard_error;
    return run.exit_code == 0 ? read_signals_csv(in_folder("s.csv")) : SignalTable{};
  }
};

double largest(const SignalTable& t, const std::string& ending) {
  double most = 0.0;
  for (std::size_t c = 0; c < t.names.size(); ++c) {
    if (!t.names[c].ends_with(ending)) continue;
    for (const double v : t.channels[c]) most = std::max(most, std::abs(v));
  }
  return most;
}

/// Of the largest value with this ending.
double difference(const SignalTable& a, const SignalTable& b, const std::string& ending) {
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.time, b.time);
  double most = 0.0;
  for (std::size_t c = 0; c < std::min(a.names.size(), b.names.size()); ++c) {
    if (!a.names[c].ends_with(ending)) continue;
    for (std::size_t n = 0; n < a.time.size(); ++n) most = std::max(most, std::abs(a.channels[c].at(n) - b.channels[c].at(n)));
  }
  const double scale = largest(a, ending);
  return scale > 0.0 ? most / scale : most;
}

constexpr const char* kExample = DDEM_SOURCES "/harness/solvers/examples/ddem_numpy.toml";

/// The example reads nothing but the exported folder, and shares no code with the solver.
TEST_F(OtherSolver, TheExampleMovesAlike) {
  NEEDS_NUMPY();
  for (const auto& [ratio, law] : {std::pair{0.0, std::string()}, {0.5, std::string()}, {0.5, lagged("normal")}, {0.5, lagged("full")},
                                   {0.5, lagged("normal_only_stress")}, {0.0, lagged("full")}}) {
    const std::string scene = random_scene(ratio, law, all_discs());
    const SignalTable ours = signals(scene, "builtin"), theirs = signals(scene, kExample);
    for (const char* ending : {"_ux", "_uy", "_theta"}) EXPECT_LT(difference(ours, theirs, ending), 1e-12) << ratio << law << ending;
    EXPECT_GT(largest(ours, "_uy"), 1e-10);
  }
}

TEST_F(OtherSolver, TheExampleTakesEvaluationsAndRelaxation) {
  NEEDS_NUMPY();
  for (const char* more : {"evaluations = 3\n", "relaxation = 0.6\n", "evaluations = 2\nrelaxation = 0.5\n", "plane = \"strain\"\n"}) {
    const std::string scene = random_scene(0.3, lagged("full") + more, all_discs());
    const SignalTable ours = signals(scene, "builtin"), theirs = signals(scene, kExample);
    for (const char* ending : {"_ux", "_uy", "_theta"}) EXPECT_LT(difference(ours, theirs, ending), 1e-12) << more << ending;
  }
}

TEST_F(OtherSolver, ReleasedAndHeldAndFree) {
  NEEDS_NUMPY();
  std::string scene = random_scene(0.4, "", all_discs());
  scene = replaced(scene, "[drive]\nwave = \"shear\"\nduration = \"1.2 us\"\namplitude = \"1 nm\"\n", "[initial]\nwave = \"longitudinal\"\namplitude = \"1 nm\"\n");
  scene = replaced(scene, "top_bottom = \"periodic\"\n", "top_bottom = \"free\"\nright = \"fixed\"\n");
  const SignalTable ours = signals(scene, "builtin"), theirs = signals(scene, kExample);
  for (const char* ending : {"_ux", "_uy", "_theta"}) EXPECT_LT(difference(ours, theirs, ending), 1e-12) << ending;
}

TEST_F(OtherSolver, MeasuredByHandAsByRun) {
  NEEDS_NUMPY();
  write("scene.toml", random_scene(0.5, lagged("full"), "pairs = 3\nsection = true"));
  const auto run = ddem({"run", path("scene.toml"), "--signals", path("ours.csv"), "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.standard_error;
  ASSERT_EQ(ddem({"export", path("scene.toml"), "-o", path("exported")}).exit_code, 0);
  ASSERT_TRUE(run_program("python3", {DDEM_SOURCES "/harness/solvers/examples/ddem_numpy.py", path("exported")}).succeeded());
  const Json ours = Json::parse(run.standard_output);
  ASSERT_TRUE(ours["wave_speed"].is_number()) << ours["wave_speed_status"];
  for (const auto& [file, tolerance] : {std::pair{path("ours.csv"), 0.0}, {path("exported/signals.csv"), 1e-12}}) {
    const auto measured = ddem({"measure", path("scene.toml"), file, "--json"});
    ASSERT_EQ(measured.exit_code, 0) << measured.standard_error;
    const Json theirs = Json::parse(measured.standard_output);
    for (const char* key : {"wave_speed", "wave_speed_stddev", "wave_speed_by_centroid", "wave_speed_by_correlation"}) {
      const double expected = ours[key].get<double>();
      EXPECT_NEAR(theirs[key].get<double>(), expected, tolerance * (key == std::string("wave_speed_stddev") ? 100.0 : 1.0) * std::abs(expected)) << key << file;
    }
    EXPECT_EQ(theirs["pairs"].size(), 3u);
  }
}

/// Springs with the geometry of the moment: as linear kinematics to the order of the amplitude. Of releases, drives, free and periodic edges.
TEST_F(OtherSolver, LammpsMovesAlike) {
  if (std::system("lmp -h >/dev/null 2>&1") != 0) GTEST_SKIP() << "lmp is not on the PATH (Debian: lammps)";
  const std::string driven = random_scene(0.0, "", all_discs());
  const std::string released = replaced(replaced(driven, "[drive]\nwave = \"shear\"\nduration = \"1.2 us\"\namplitude = \"1 nm\"\n",
                                                 "[initial]\nwave = \"longitudinal\"\namplitude = \"1 nm\"\n"),
                                        "top_bottom = \"periodic\"\n", "top_bottom = \"free\"\nright = \"fixed\"\n");
  for (const std::string& scene : {driven, released}) {
    const SignalTable ours = signals(scene, "builtin"), theirs = signals(scene, "lammps");
    for (const char* ending : {"_ux", "_uy"}) EXPECT_LT(difference(ours, theirs, ending), 1e-4) << ending << scene;
    EXPECT_GT(largest(ours, "_uy"), 1e-11);
  }
  write("scene.toml", random_scene(0.5, "", "pairs = 3"));
  const auto refused = ddem({"run", path("scene.toml"), "--solver", "lammps"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.standard_error, HasSubstr("lammps cannot do shear stiffness"));
}

TEST_F(OtherSolver, YadeMovesAlike) {
  if (std::system("yade --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "yade is not on the PATH (Debian: yade)";
  std::string scene = replaced(small_scene(), "[initial]\nwave = \"longitudinal\"\namplitude = \"1 um\"\n",
                               "[drive]\nwave = \"shear\"\nduration = \"1 us\"\namplitude = \"0.1 nm\"\n[time]\nend = \"2 us\"\n");
  scene = replaced(scene, "top_bottom = \"periodic\"\n", "top_bottom = \"free\"\n");
  scene = replaced(scene, "pairs = 3", "discs = [0, 1, 35, 100, 101, 150, 239]");
  const SignalTable ours = signals(scene, "builtin"), theirs = signals(scene, "yade");
  for (const char* ending : {"_ux", "_uy", "_theta"}) EXPECT_LT(difference(ours, theirs, ending), 1e-4) << ending;
  EXPECT_GT(largest(ours, "_theta"), 1e-9);
  write("scene.toml", random_scene(0.5, "", "pairs = 3"));
  EXPECT_THAT(ddem({"run", path("scene.toml"), "--solver", "yade"}).standard_error, HasSubstr("yade cannot do"));
}

/// A shell as a solver: `script` finds the folder of the scene in $0, and good signals in $GOOD.
class BadSolver : public OtherSolver {
 protected:
  void SetUp() override {
    write("scene.toml", with_table(small_scene(), "[time]\nend = \"2 us\""));
    ASSERT_EQ(ddem({"run", path("scene.toml"), "--signals", path("k.csv")}).exit_code, 0);
    std::string good = read("k.csv"), header = "time";
    for (int r = 0; r < 6; ++r) header += fmt::format(",r{0}_ux,r{0}_uy,r{0}_theta", r);
    write("good.csv", header + good.substr(good.find('\n')));
  }
  void describe(const std::string& script, const std::string& more = "time_limit = 1\n") const {
    write("solver.toml", fmt::format("name = \"odd\"\ncommand = [\"sh\", \"-c\", '''{}''', \"{{folder}}\"]\n{}laws = [\"dem\"]\n",
                                     replaced_all(script, "GOOD", path("good.csv")), more));
  }
  static std::string replaced_all(std::string text, const std::string& mark, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += by.size()) text.replace(at, mark.size(), by);
    return text;
  }
  SubprocessResult run() const { return ddem({"run", path("scene.toml"), "--solver", path("solver.toml"), "--signals", path("k.csv")}); }
};

TEST_F(BadSolver, AGoodOneIsTaken) {
  describe("cp GOOD \"$0/signals.csv\"");
  const std::string before = read("k.csv");
  const auto good = run();
  EXPECT_EQ(good.exit_code, 0) << good.standard_error;
  EXPECT_EQ(read("k.csv"), before);
}

TEST_F(BadSolver, WhateverItDoesIsAnErrorWithItsReason) {
  struct Way {
    const char *script, *reason;
    int exit_code = 4;
  };
  const Way kWays[] = {
      {"sleep 600", "killed at its time limit"},
      {"trap '' TERM INT HUP; while :; do :; done", "killed at its time limit"},
      {"(sleep 0.2; cp GOOD \"$0/signals.csv\"; sleep 600) & exit 0", "left no signals.csv"},
      {"setsid sh -c 'sleep 600' >/dev/null 2>&1 & exit 0", "left no signals.csv"},
      {"exit 0", "left no signals.csv"},
      {"echo no licence >&2; exit 3", "exit code 3; it said: no licence"},
      {"kill -9 $$", "killed by signal 9"},
      {"kill -SEGV $$", "killed by signal 11"},
      {"yes >&2", "killed at its time limit"},
      {"head -c $(($(wc -c < GOOD) - 30)) GOOD > \"$0/signals.csv\"", "signals.csv:"},
      {"head -n 5 GOOD > \"$0/signals.csv\"", "signals.csv: has 4 samples"},
      {"cat GOOD > \"$0/signals.csv\"; tail -n 1 GOOD >> \"$0/signals.csv\"", "does not increase"},
      {"sed '4s/,[^,]*/,nan/' GOOD > \"$0/signals.csv\"", "signals.csv:4:", 3},
      {"sed '4s/,[^,]*/,inf/' GOOD > \"$0/signals.csv\"", "is not a finite number", 3},
      {"echo '{\"status\": \"diverged\"}' > \"$0/solver.json\"; exit 0", "says that it is not ok: \"diverged\"", 3},
      {"sed '4s/,[^,]*/,x/' GOOD > \"$0/signals.csv\"", "is not a finite number"},
      {"sed 's/^time/t/' GOOD > \"$0/signals.csv\"", "the first column must be 'time'"},
      {"sed 's/r1_uy/r7_uy/' GOOD > \"$0/signals.csv\"", "has no column r1_uy"},
      {"sed 's/r1_uy/r1_ux/' GOOD > \"$0/signals.csv\"", "repeated name"},
      {"awk -F, -v OFS=, 'NR>1 {$1 *= 1.001} 1' GOOD > \"$0/signals.csv\"", "sample 1 is at"},
      {"ln -s GOOD \"$0/signals.csv\"", "no regular file"},
      {"mkdir \"$0/signals.csv\"", "no regular file"},
      {"mkfifo \"$0/signals.csv\"", "no regular file"},
      {": > \"$0/signals.csv\"", "signals.csv:1:"},
      {"head -c 5000 /dev/urandom > \"$0/signals.csv\"", "signals.csv:1:"},
      {"truncate -s 20G \"$0/signals.csv\"", "more than"},
      {"cp GOOD \"$0/signals.csv\"; echo '{\"wall_seconds\": -1}' > \"$0/solver.json\"", "wall_seconds"},
      {"cp GOOD \"$0/signals.csv\"; echo '{' > \"$0/solver.json\"", "solver.json"},
      {"cp GOOD \"$0/signals.csv\"; echo '[1]' > \"$0/solver.json\"", "solver.json: not an object"},
      {"rm -r \"$0\"; rm \"$0\"/*; exit 0", "left no signals.csv"},
  };
  const std::string before = read("k.csv");
  const std::string sleep = "sleep 600." + std::to_string(::getpid());  // told from anybody else's
  for (const auto& [words, reason, exit_code] : kWays) {
    std::string script = words;
    if (const auto at = script.find("sleep 600"); at != std::string::npos) script.replace(at, std::string_view("sleep 600").size(), sleep);
    describe(script);
    const auto start = std::chrono::steady_clock::now();
    const auto odd = run();
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 3.0) << script;
    EXPECT_EQ(odd.exit_code, exit_code) << script << odd.standard_error;
    EXPECT_THAT(odd.standard_error, HasSubstr("odd: ")) << script;
    EXPECT_THAT(odd.standard_error, HasSubstr(reason)) << script;
    EXPECT_EQ(read("k.csv"), before) << script;
  }
  EXPECT_NE(std::system(("pgrep -x -f '" + sleep + "' >/dev/null").c_str()), 0) << "something was left behind";
}

TEST_F(BadSolver, AGigabyteOfWords) {
  describe("yes | head -c 1000000000; exit 0", "time_limit = 60\n");
  const auto odd = run();
  EXPECT_EQ(odd.exit_code, 4);
  EXPECT_THAT(odd.standard_error, HasSubstr("left no signals.csv"));
  EXPECT_LT(odd.standard_error.size(), 10000u);
}

TEST_F(BadSolver, WhatCannotBeStartedIsTheMachines) {
  write("solver.toml", "name = \"odd\"\ncommand = [\"ddem-no-such-program\", \"{folder}\"]\nlaws = [\"dem\"]\n");
  const auto none = run();
  EXPECT_EQ(none.exit_code, 4);
  EXPECT_THAT(none.standard_error, HasSubstr("cannot be started"));
}

TEST_F(BadSolver, WhatItCannotDoIsRefused) {
  describe("cp GOOD \"$0/signals.csv\"");
  write("scene.toml", with_table(small_scene(), "[time]\nend = \"2 us\"\n[deformation]\nscheme = \"lagged\"\nyoung_modulus = 4e10\npoisson_ratio = 0.3"));
  const auto refused = run();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.standard_error, HasSubstr("odd has no law lagged-normal; it has dem"));
}

TEST_F(BadSolver, ProblemsOfADescriptionAreToldAtOnce) {
  write("solver.toml", "nam = \"odd\"\ncommand = [\"sh\"]\ntime_limit = -1\nranks = 0\nlaws = [\"dme\"]\nperiodc = true\nheld_discs = 1\n[cant]\nx = 1\n");
  const auto bad = run();
  EXPECT_EQ(bad.exit_code, 2);
  for (const char* part : {":1: nam", "did you mean name?", "name: is missing", "names no {folder}", ":3: time_limit", ":4: ranks", ":5: laws",
                           "did you mean \"dem\"?", ":6: periodc", "did you mean periodic?", ":7: held_discs", ":8: cant"}) {
    EXPECT_THAT(bad.standard_error, HasSubstr(part));
  }
  for (const char* name : {"builtn", "nothing", "no/such.toml"}) {
    const auto unknown = ddem({"run", path("scene.toml"), "--solver", name});
    EXPECT_EQ(unknown.exit_code, 2) << name;
    EXPECT_THAT(unknown.standard_error, HasSubstr(name));
  }
}

TEST_F(OtherSolver, ExportsWhatIsAskedForAndNothingElse) {
  write("scene.toml", small_scene());
  ASSERT_EQ(ddem({"export", path("scene.toml"), "-o", path("out")}).exit_code, 0);
  for (const char* file : {"scene.json", "discs.csv", "bonds.csv", "receivers.csv"}) EXPECT_TRUE(std::filesystem::exists(in_folder("out") / file)) << file;
  EXPECT_FALSE(std::filesystem::exists(in_folder("out/drive.csv")));
  EXPECT_EQ(ddem({"export", path("scene.toml"), "-o", path("out")}).exit_code, 0) << "its own files are replaced";
  write("out/discs.csv", "mine\n");
  const auto refused = ddem({"export", path("scene.toml"), "-o", path("out")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.standard_error, HasSubstr("discs.csv"));
  EXPECT_EQ(read("out/discs.csv"), "mine\n");
  write("scene.toml", replaced(small_scene(), "[probes]", "[time]\nintegrator = \"exact\"\n[probes]"));
  EXPECT_EQ(ddem({"export", path("scene.toml"), "-o", path("exact")}).exit_code, 2);
}

TEST_F(OtherSolver, SignalsThatAreNoneAreRefused) {
  write("scene.toml", small_scene());
  ASSERT_EQ(ddem({"run", path("scene.toml"), "--signals", path("s.csv")}).exit_code, 0);
  const std::string good = read("s.csv");
  const auto expect = [&](const std::string& text, const char* reason) {
    write("bad.csv", text);
    const auto bad = ddem({"measure", path("scene.toml"), path("bad.csv")});
    EXPECT_EQ(bad.exit_code, 2) << reason;
    EXPECT_THAT(bad.standard_error, HasSubstr("bad.csv"));
    EXPECT_THAT(bad.standard_error, HasSubstr(reason));
  };
  expect("", "time");
  expect(good.substr(0, good.find('\n') + 1), "no signals");
  expect(replaced(good, good.substr(5, good.find(',', 5) - 5), "other_ux"), "has no column");
  const std::size_t second = good.find('\n', good.find('\n', good.find('\n') + 1) + 1);
  expect(good.substr(0, good.find('\n', good.find('\n') + 1) + 1) + good.substr(second + 1), "equal steps");
  EXPECT_EQ(ddem({"measure", path("scene.toml")}).exit_code, 2);
  EXPECT_EQ(ddem({"measure", path("scene.toml"), path("none.csv")}).exit_code, 2);
}

}  // namespace
}  // namespace ddem::harness::test
