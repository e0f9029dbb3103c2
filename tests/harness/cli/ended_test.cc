// ddem that is ended at any moment by INT, TERM or HUP, or killed: the earlier results are whole, no temporary file, no
// program and no folder stays (of a killed one: not beyond the next run).

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <functional>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Ended : public Cli {
 protected:
  void SetUp() override {
    fs::create_directory(in_folder("tmp"));
    write("scene.toml", with_table(small_scene(), "[time]\nend = \"200 us\""));
    write("fem.toml", "[assembly]\npacking = \"hexagonal\"\ncolumns = 60\nrows = 8\nradius = \"0.1 mm\"\n[material]\ndensity = 2000\n"
                      "[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = 0.25\n[boundary]\ntop_bottom = \"periodic\"\n[drive]\n"
                      "wave = \"shear\"\nduration = \"2 us\"\namplitude = \"10 nm\"\n[probes]\npairs = 3\nsection = true\n"
                      "[continuum]\ndegree = 8\nelements = [400, 48]\n");
    write("campaign.toml", "[[case]]\nid = \"f\"\nscene = \"fem.toml\"\n[[case.criterion]]\nmetric = \"fem.wave_speed\"\nlower = 100\n"
                           "derivation = \"x\"\n");
  }

  pid_t start(const std::vector<std::string>& arguments) const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    ::setenv("TMPDIR", path("tmp").c_str(), 1);
    const int null = ::open("/dev/null", O_WRONLY);
    for (const int stream : {1, 2}) ::dup2(null, stream);
    std::vector<char*> words{const_cast<char*>(DDEM_PROGRAM)};
    for (const std::string& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
    words.push_back(nullptr);
    ::execv(DDEM_PROGRAM, words.data());
    ::_exit(127);
  }

  /// Processes, zombies left aside, that name the test's folder.
  bool something_runs() const {
    for (const auto& entry : fs::directory_iterator("/proc")) {
      try {
        if (read_file(entry.path() / "cmdline").find(path("tmp")) != std::string::npos) return true;
      } catch (const InputError&) {  // no process, or one that has just ended
      }
    }
    return false;
  }

  static bool soon(const std::function<bool()>& holds) {
    for (int k = 0; k < 1000; ++k) {
      if (holds()) return true;  // asked once more, a short run may have ended
      ::usleep(10000);
    }
    return false;
  }

  void expect_nothing_left() const {
    for (const auto& [name, content] : contents()) {
      EXPECT_THAT(name, Not(HasSubstr(".tmp")));
      EXPECT_THAT(name, Not(HasSubstr("tmp/")));
    }
  }
};

TEST_F(Ended, ARunAtAnyMoment) {
  const std::vector<std::string> run{"run", path("scene.toml"), "-o", path("k.h5"), "--signals", path("k.csv"), "--snapshots", "300"};
  const SubprocessResult whole = ddem(run);
  ASSERT_EQ(whole.exit_code, 0) << whole.standard_error;
  const std::string csv = read("k.csv");
  int ended = 0;
  for (int trial = 0; trial < 15; ++trial) {
    const int signal = std::array{SIGTERM, SIGINT, SIGHUP}[static_cast<std::size_t>(trial) % 3];
    const pid_t child = start(run);
    ::usleep(2000 + 15000 * static_cast<unsigned>(trial));
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    const bool by_signal = WIFSIGNALED(status) && WTERMSIG(status) == signal;
    EXPECT_TRUE(by_signal || (WIFEXITED(status) && WEXITSTATUS(status) == 0)) << status;
    ended += by_signal;
    EXPECT_EQ(read("k.csv"), csv);
    EXPECT_THAT(read("k.h5"), testing::StartsWith("\x89HDF"));
    expect_nothing_left();
  }
  EXPECT_GT(ended, 0);
}

#ifdef DDEM_HAS_FEM
TEST_F(Ended, WithAllThatItStarted) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"fem", path("fem.toml")}, {"validate", path("campaign.toml"), "-o", path("night"), "-j", "1"}}) {
    for (const int signal : {SIGTERM, SIGINT, SIGKILL}) {
      const pid_t child = start(command);
      ASSERT_TRUE(soon([&] { return something_runs(); })) << command[0];
      ::usleep(50000);
      ::kill(child, signal);
      int status = 0;
      ::waitpid(child, &status, 0);
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << command[0] << status;
      EXPECT_TRUE(soon([&] { return !something_runs(); })) << command[0] << signal;
      if (signal != SIGKILL) {
        EXPECT_TRUE(soon([&] { return fs::is_empty(in_folder("tmp")); })) << command[0] << signal;
      } else if (command[0] == "fem") {
        EXPECT_FALSE(fs::is_empty(in_folder("tmp"))) << "no test of what is swept";
      }
    }
  }
  // Some were killed: the next that needs such a folder removes theirs.
  const pid_t next = start({"fem", path("fem.toml")});
  ASSERT_TRUE(soon([&] { return something_runs(); }));
  ::kill(next, SIGTERM);
  ::waitpid(next, nullptr, 0);
  expect_nothing_left();
}
#endif

}  // namespace
}  // namespace ddem::harness::test
