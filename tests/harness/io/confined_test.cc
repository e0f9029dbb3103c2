// Programs that are not trusted: they end, they leave nothing behind, and they write nowhere else.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/subprocess.h"
#include "scratch.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Confined : public testing::Test {
 protected:
  Confined() {
    fs::create_directory(scratch_ / "own");
    fs::create_directory(scratch_ / "other");
  }
  SubprocessResult shell(const std::string& script, double seconds = 20.0, std::vector<fs::path> may_write = {}) const {
    return run_confined("/bin/sh", {"-c", script}, {scratch_ / "own", std::move(may_write), seconds});
  }
  fs::path own(const char* name) const { return scratch_ / "own" / name; }
  fs::path other(const char* name) const { return scratch_ / "other" / name; }

  /// Whether a process still writes a line a moment into that file.
  static bool grows(const fs::path& file) {
    std::error_code ignored;
    const auto before = fs::file_size(file, ignored);
    ::usleep(100000);
    return fs::file_size(file, ignored) != before;
  }

  Scratch scratch_;
};

constexpr const char* kWriteForEver = "while :; do echo x >> ticks; sleep 0.01; done";

TEST_F(Confined, WorksInItsFolder) {
  EXPECT_TRUE(shell("echo here > file && test -w \"$TMPDIR\"").succeeded());
  EXPECT_EQ(read_file(own("file")), "here\n");
}

TEST_F(Confined, EndsAtItsLimit) {
  for (const char* script : {"sleep 60", "trap '' TERM INT HUP; while :; do :; done", "exec >&- 2>&-; sleep 60", "sleep 60 & wait", "yes"}) {
    const auto start = std::chrono::steady_clock::now();
    const SubprocessResult run = shell(script, 0.3);
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2.3) << script;
    EXPECT_TRUE(run.timed_out) << script;
    EXPECT_EQ(run.status(), "killed at its time limit");
    EXPECT_FALSE(run.succeeded());
  }
  EXPECT_FALSE(shell("exit 0", 0.0 + 20.0).timed_out);
}

TEST_F(Confined, LeavesNoProcess) {
  for (const std::string start : {"", "setsid ", "nohup setsid "}) {
    fs::remove(own("ticks"));
    const SubprocessResult run = shell(start + "sh -c '" + kWriteForEver + "' >/dev/null 2>&1 & sleep 0.1");
    EXPECT_TRUE(run.succeeded()) << start << run.standard_error;
    EXPECT_TRUE(fs::exists(own("ticks"))) << start << "no test of what is killed";
    EXPECT_FALSE(grows(own("ticks"))) << start;
  }
}

TEST_F(Confined, WritesNowhereElse) {
  if (::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) < 0) GTEST_SKIP() << "this system has no Landlock";
  write_file(other("theirs"), "kept");
  const std::string there = other("new").string();
  const SubprocessResult run = shell("echo x > '" + there + "'");
  EXPECT_FALSE(run.succeeded());
  EXPECT_THAT(run.standard_error, HasSubstr("Permission denied"));
  EXPECT_FALSE(shell("ln -s '" + (scratch_ / "other").string() + "' link && echo x > link/new").succeeded());
  EXPECT_FALSE(shell("rm '" + other("theirs").string() + "'").succeeded());
  EXPECT_FALSE(shell("mkdir ../beside").succeeded());
  EXPECT_FALSE(fs::exists(there));
  EXPECT_EQ(read_file(other("theirs")), "kept");
  EXPECT_TRUE(shell("echo x > '" + there + "' && echo y > /dev/null", 20.0, {scratch_ / "other"}).succeeded());
  EXPECT_TRUE(fs::exists(there));
}

TEST_F(Confined, NoSuchProgram) {
  EXPECT_THROW(run_confined("ddem-no-such-program", {}, {scratch_ / "own", {}, 1.0}), MachineError);
}

}  // namespace
}  // namespace ddem::harness
