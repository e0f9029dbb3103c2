// Closed, full and broken streams, and limits of the system: errors with a code and a line, never a signal, and no result lost.

#include <fmt/format.h>

#include "tests/harness/cli/program.h"

namespace ddem::harness::test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

class Streams : public Cli {
 protected:
  void SetUp() override {
    write("scene.toml", small_scene());
    // An even number of evaluations is warned of.
    write("warned.toml", with_table(small_scene(), "[deformation]\nevaluations = 2\nyoung_modulus = 4e10\npoisson_ratio = 0.3"));
  }

  /// A line for the shell in the test's folder, in which $D is ddem.
  SubprocessResult shell(const std::string& line) const {
    return run_program("/bin/sh", {"-c", "cd \"$1\" && D=\"$2\" && " + line, "sh", path(""), DDEM_PROGRAM});
  }

  void expect_code(const std::string& line, int code) const {
    const auto run = shell(line);
    EXPECT_EQ(run.signal, 0) << line;
    EXPECT_EQ(run.exit_code, code) << line << '\n' << run.standard_error;
  }

  void expect_nothing_temporary() const {
    for (const auto& [name, content] : contents()) EXPECT_THAT(name, Not(HasSubstr(".tmp")));
  }
};

TEST_F(Streams, MessagesThatNobodyTakes) {
  for (const char* error : {"2>/dev/full", "2>&-", "2</dev/null", ">&- 2>&-", "<&- 2>&-"}) {
    expect_code(std::string("$D run nofile.toml ") + error, 2);
    expect_code(std::string("$D bogus ") + error, 2);
  }
  for (const char* error : {"2>/dev/full", "2>&-"}) {
    const auto whole = shell("$D run warned.toml -o a.h5 --signals a.csv --json");
    EXPECT_THAT(whole.standard_error, HasSubstr("warning"));
    const auto run = shell(std::string("$D run warned.toml -o r.h5 --signals r.csv --json ") + error);
    EXPECT_EQ(run.exit_code, 0) << run.status();
    EXPECT_EQ(read("r.csv"), read("a.csv"));
    EXPECT_THAT(read("r.h5"), testing::StartsWith("\x89HDF"));
    EXPECT_THAT(run.standard_output, HasSubstr("\"status\": \"ok\""));
    expect_code(std::string("$D pack scene.toml -o p.csv ") + error, 0);
    EXPECT_THAT(read("p.csv"), testing::StartsWith("x,y,radius\n"));
  }
}

TEST_F(Streams, DataThatNobodyTakes) {
  for (const char* output : {">/dev/full", ">&-", "1</dev/null"}) {
    for (const char* command : {"run scene.toml", "run scene.toml --json", "moduli scene.toml", "moduli scene.toml --json", "stability scene.toml",
                                "scene-reference", "--help", "run --help", "--version", "pack scene.toml --json -o p.csv --force"}) {
      const auto run = shell(std::string("$D ") + command + " " + output);
      EXPECT_EQ(run.signal, 0) << command << output;
      EXPECT_EQ(run.exit_code, 4) << command << output;
      EXPECT_THAT(run.standard_error, HasSubstr("standard output")) << command << output;
    }
  }
  // What goes to files is there all the same.
  expect_code("$D run scene.toml -o r.h5 --signals r.csv --json >/dev/full", 4);
  EXPECT_THAT(read("r.h5"), testing::StartsWith("\x89HDF"));
  EXPECT_THAT(read("r.csv"), testing::StartsWith("time,"));
}

TEST_F(Streams, APipeWithoutReader) {
  for (const char* command : {"scene-reference", "run scene.toml --json", "run scene.toml --signals /dev/stdout"}) {
    const auto run = shell(std::string("rm -f code; { sleep 0.1; $D ") + command +
                           " 2>error; echo $? >code; } | true; until [ -s code ]; do sleep 0.02; done; cat code error");
    EXPECT_THAT(run.standard_output, AllOf(testing::StartsWith("4\n"), HasSubstr("ddem: "), HasSubstr("Broken pipe"))) << command;
  }
}

TEST_F(Streams, NoFileTakesTheNumberOfAClosedStream) {
  expect_code("$D run warned.toml -o r.h5 --signals r.csv <&- >&- 2>&-", 4);  // its summary has no place to go
  ASSERT_EQ(shell("$D run warned.toml -o a.h5 --signals a.csv").exit_code, 0);
  EXPECT_EQ(read("r.csv"), read("a.csv"));
  EXPECT_EQ(read("r.h5").size(), read("a.h5").size());
}

TEST_F(Streams, SignalsToStandardOutput) {
  ASSERT_EQ(shell("$D run scene.toml --signals a.csv --json >a.json").exit_code, 0);
  const auto both = [](const std::string& printed, const std::string& signals) {
    return printed.starts_with(signals) && printed.substr(signals.size()).starts_with("{\n");
  };
  const std::string signals = read("a.csv");
  for (const char* name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    const std::string command = std::string("$D run scene.toml --json --signals ") + name;
    EXPECT_TRUE(both(shell(command).standard_output, signals)) << name;
    ASSERT_EQ(shell(command + " >all.txt").exit_code, 0) << name;
    EXPECT_TRUE(both(read("all.txt"), signals)) << name;
  }
  expect_code("$D run scene.toml -o /dev/stdout >x.h5", 2);
  expect_code("$D run scene.toml --signals /dev/full", 4);
}

TEST_F(Streams, AFileBeyondItsLimit) {
  write("f.csv", "");
  const auto before = contents();
  for (const char* command : {"run scene.toml --signals f.csv", "run scene.toml --signals new.csv", "pack scene.toml -o new.csv",
                              "run scene.toml --snapshots 2 --signals f.csv -o g.h5"}) {
    const auto run = shell(std::string("ulimit -f 4; $D ") + command);
    EXPECT_EQ(run.signal, 0) << command << run.status();
    EXPECT_EQ(run.exit_code, 4) << command;
    EXPECT_THAT(run.standard_error, AllOf(HasSubstr(".csv"), HasSubstr("File too large (this process may write files of 2048 bytes: ulimit -f)"))) << command;
    expect_contents(before);
  }
}

#ifdef DDEM_HAS_FEM
TEST_F(Streams, AProgramOfOursBeyondThatLimit) {
  write("fem.toml", replaced(small_scene(), "[probes]", "[continuum]\ndegree = 4\nelements = [30, 8]\n[probes]"));
  const auto before = contents();
  for (const int limit : {0, 1, 2, 8, 64}) {  // the case file does not fit, the mesh, or the signals
    const auto run = shell(fmt::format("ulimit -f {}; TMPDIR=. $D fem fem.toml", limit));
    EXPECT_EQ(run.exit_code, 4) << run.status();
    EXPECT_THAT(run.standard_error, AllOf(HasSubstr("ddem-fem"), AnyOf(HasSubstr("cases.json"), HasSubstr("strip.msh"), HasSubstr("signals.h5")), HasSubstr("File too large"),
                                          HasSubstr(fmt::format("files of {} bytes: ulimit -f", 512 * limit))))
        << limit;
    expect_contents(before);
  }
}
#endif

TEST_F(Streams, NothingOfANameReachesTheTerminal) {
  const auto run = ddem({"run", path("\x1b[2J\xc2\x9b" "31m.toml")});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.standard_error, AllOf(HasSubstr("\\x1b[2J\\x9b31m"), Not(HasSubstr("\x1b"))));
}

}  // namespace
}  // namespace ddem::harness::test
