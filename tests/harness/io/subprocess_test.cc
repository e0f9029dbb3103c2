#include "harness/io/subprocess.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/io/errors.h"
#include "tests/support/sanitized.h"
#include "scratch.h"

namespace ddem::harness {
namespace {

double seconds_of(const std::function<void()>& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

SubprocessResult shell(const std::string& script, const LineCallback& on_line = {}) {
  return run_program("/bin/sh", {"-c", script}, on_line);
}

TEST(Subprocess, CapturesBothStreamsAndTheExitCode) {
  const SubprocessResult result = shell("echo data; echo oops >&2; exit 3");
  EXPECT_EQ(result.standard_output, "data\n");
  EXPECT_EQ(result.standard_error, "oops\n");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_FALSE(result.succeeded());
  EXPECT_EQ(result.status(), "exit code 3");
  EXPECT_TRUE(shell("true").succeeded());
}

// A shell that holds 60 MB of text, and one that holds nothing.
TEST(Subprocess, TellsItsPeakMemory) {
  if (ddem::test::kSanitized) GTEST_SKIP() << "this process takes more";
  const double nothing = shell("true").peak_memory, text = shell("x=$(head -c 60000000 /dev/zero | tr '\\0' a); :").peak_memory;
  EXPECT_GT(nothing, 1e5);
  EXPECT_TRUE(text - nothing > 5.5e7 && text - nothing < 3e8) << text << " " << nothing;
}

TEST(Subprocess, ArgumentsAreNotInterpreted) {
  const std::vector<std::string> arguments{"%s|", "a b", "$HOME", "*", "", "\"'; rm x"};
  EXPECT_EQ(run_program("printf", arguments).standard_output, "a b|$HOME|*||\"'; rm x|");
}

TEST(Subprocess, StandardInputIsEmpty) {
  EXPECT_EQ(run_program("cat", {}).standard_output, "");
}

TEST(Subprocess, SignalsAreReported) {
  const SubprocessResult result = shell("kill -9 $$");
  EXPECT_EQ(result.signal, SIGKILL);
  EXPECT_FALSE(result.succeeded());
  EXPECT_EQ(result.status(), "killed by signal 9 (Killed)");
}

TEST(Subprocess, LinesComeAsTheyAreWritten) {
  std::vector<std::string> lines;
  shell("printf 'one\\ntw' >&2; sleep 0.1; printf 'o\\n\\nlast' >&2",
        [&](std::string_view line) { lines.emplace_back(line); });
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "two", "", "last"}));
}

TEST(Subprocess, MuchOutputOnBothStreamsDoesNotBlock) {
  // 4 MB on each: far beyond what a pipe holds; the last megabyte is kept.
  const SubprocessResult result =
      shell("yes 0123456 | head -c 4000000 >&2; yes abcdefg | head -c 4000000; echo end; echo end >&2");
  EXPECT_TRUE(result.succeeded());
  EXPECT_EQ(result.standard_output.size(), std::size_t{1} << 20);
  EXPECT_EQ(result.standard_error.substr(result.standard_error.size() - 12), "0123456\nend\n");
}

TEST(Subprocess, AMissingProgramIsTheMachinesFailure) {
  const std::string reason = message_of<MachineError>([] { run_program("/no/such/program", {}); });
  EXPECT_NE(reason.find("/no/such/program: cannot be started: No such file or directory"), std::string::npos)
      << reason;
  EXPECT_THROW(run_program("ddem-no-such-program", {}), MachineError);
}

TEST(Subprocess, AThrowingCallbackKillsTheProgram) {
  const Scratch scratch;
  const std::string mark = (scratch / "alive").string();
  const double elapsed = seconds_of([&] {
    EXPECT_THROW(shell("echo $$ >&2; sleep 20; touch " + mark,
                       [](std::string_view line) { throw std::runtime_error(std::string(line)); }),
                 std::runtime_error);
  });
  EXPECT_LT(elapsed, 10.0);
  EXPECT_EQ(scratch.entries(), 0);
  // The process itself is gone, too: its number is the message.
  std::string pid;
  try {
    shell("echo $$ >&2; exec sleep 20",
          [](std::string_view line) { throw std::runtime_error(std::string(line)); });
  } catch (const std::runtime_error& error) {
    pid = error.what();
  }
  EXPECT_EQ(::kill(std::stoi(pid), 0), -1);
}

TEST(Subprocess, EndsWithTheProgramNotWithWhatItLeftBehind) {
  SubprocessResult result;
  const double elapsed = seconds_of([&] { result = shell("(sleep 30) & echo done"); });
  EXPECT_EQ(result.standard_output, "done\n");
  EXPECT_LT(elapsed, 15.0);
}

}  // namespace
}  // namespace ddem::harness
