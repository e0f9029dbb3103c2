// What a process that ends before its time leaves behind: nothing where a signal asked it to end, and what the next one
// removes where it was killed.

#include "harness/io/leftovers.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <string>
#include <thread>

#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/process_stamp.h"
#include "harness/io/subprocess.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

int ready[2];  // a pipe on which a child says that its work is done

void sleep_for_ever() {
  [[maybe_unused]] const ssize_t told = ::write(ready[1], "x", 1);
  for (;;) ::pause();
}

void wait_for_child(pid_t) {
  char byte = 0;
  EXPECT_EQ(::read(ready[0], &byte, 1), 1);
}

/// Forks; the child does `work` in a thread of its own until the signal comes, after `before_the_signal`. How it ended.
int end_by(int signal, const std::function<void()>& work, const std::function<void(pid_t)>& before_the_signal = wait_for_child) {
  EXPECT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    CleanupSection().forget_all();
    clean_up_on_signals();
    std::thread worker([&] {
      work();
      ::_exit(99);
    });
    for (;;) ::pause();
  }
  before_the_signal(child);
  ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  for (const int end : ready) ::close(end);
  return status;
}

TEST(Leftovers, SignalsRemoveFilesAndFolders) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Scratch scratch;
    ::setenv("TMPDIR", (scratch / "").c_str(), 1);
    put(scratch / "a", "old");
    const int status = end_by(
        signal,
        [&] {
          AtomicFile one(scratch / "a"), two(scratch / "b");
          one.append("half");
          const TemporaryFolder folder("ddem-test");
          fs::create_directories(folder.path() / "deep/deeper");
          for (int k = 0; k < 500; ++k) put(folder.path() / ("deep/" + std::string(40, 'x') + std::to_string(k)), "x");
          put(folder.path() / "deep/deeper/file", "x");
          sleep_for_ever();
        },
        [&](pid_t child) {
          wait_for_child(child);
          EXPECT_EQ(scratch.entries(), 4);
        });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
    EXPECT_EQ(scratch.entries(), 1);
    EXPECT_EQ(content_of(scratch / "a"), "old");
    ::unsetenv("TMPDIR");
  }
}

TEST(Leftovers, NotWhatIsDone) {
  const Scratch scratch;
  end_by(SIGTERM, [&] {
    write_file(scratch / "done", "whole");
    { const AtomicFile dropped(scratch / "dropped"); }
    sleep_for_ever();
  });
  EXPECT_EQ(scratch.entries(), 1);
  EXPECT_EQ(content_of(scratch / "done"), "whole");
}

TEST(Leftovers, AnIgnoredSignalStaysIgnored) {
  const Scratch scratch;
  ::signal(SIGHUP, SIG_IGN);
  int status = end_by(
      SIGTERM, [&] { const AtomicFile file(scratch / "a"); sleep_for_ever(); },
      [](pid_t child) {
        wait_for_child(child);
        ::kill(child, SIGHUP);
        ::usleep(20000);
        EXPECT_EQ(::waitpid(child, nullptr, WNOHANG), 0);
      });
  ::signal(SIGHUP, SIG_DFL);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
  EXPECT_EQ(scratch.entries(), 0);
}

/// Many at random moments of a process that makes, drops and commits files in two threads.
TEST(Leftovers, AtAnyMoment) {
  const Scratch scratch;
  for (int trial = 0; trial < 60; ++trial) {
    const pid_t child = ::fork();
    if (child == 0) {
      CleanupSection().forget_all();
      clean_up_on_signals();
      const auto work = [&](const std::string& name) {
        for (int k = 0;; ++k) {
          AtomicFile file(scratch / name);
          file.append(std::string(static_cast<std::size_t>(k % 3000), 'x') + "end");
          if (k % 3 > 0) file.commit(Flush::none);
        }
      };
      std::thread other([&] { work("b"); });
      work("a");
    }
    ::usleep(500 + 137 * static_cast<unsigned>(trial));
    ::kill(child, SIGTERM);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
  }
  for (const auto& entry : fs::directory_iterator(scratch / "")) {
    EXPECT_EQ(entry.path().filename().string().size(), 1U) << entry.path();
    EXPECT_TRUE(content_of(entry.path()).ends_with("end"));
  }
}

bool runs(const std::string& mark) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    try {
      if (read_file(entry.path() / "cmdline").find(mark) != std::string::npos) return true;
    } catch (const InputError&) {  // no process, or one that has just ended
    }
  }
  return false;
}

void expect_starts(const std::string& mark) {
  for (int k = 0; k < 500 && !runs(mark); ++k) ::usleep(10000);
  EXPECT_TRUE(runs(mark));
}

bool ends_soon(const std::string& mark) {
  for (int k = 0; k < 200 && runs(mark); ++k) ::usleep(10000);
  return !runs(mark);
}

TEST(Leftovers, ProgramsEndWithTheirCaller) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGKILL}) {
    const std::string mark = fmt::format("3{}.{}", signal + 1000, ::getpid());
    const int status = end_by(
        signal, [&] { run_program("sleep", {mark}); }, [&](pid_t) { expect_starts(mark); });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
    // Also where the signal comes between the fork and its entry in our list: then by the system, when its parent has died.
    EXPECT_TRUE(ends_soon(mark)) << signal;
  }
}

TEST(Leftovers, AlsoWhatProgramsStarted) {
  const std::string mark = fmt::format("4000.{}", ::getpid());
  end_by(SIGTERM, [&] { run_program("/bin/sh", {"-c", "sleep " + mark + " & wait"}); }, [&](pid_t) {
    expect_starts(mark);
    ::usleep(50000);  // for the second of them
  });
  EXPECT_TRUE(ends_soon(mark));
}

TEST(Leftovers, OfAKilledProcessTheNextRemoves) {
  const Scratch scratch;
  ::setenv("TMPDIR", (scratch / "").c_str(), 1);
  const auto work = [&] {
    const AtomicFile file(scratch / "a");
    const TemporaryFolder folder("ddem-test");
    put(folder.path() / "inside", "x");
    sleep_for_ever();
  };
  end_by(SIGKILL, work);
  EXPECT_EQ(scratch.entries(), 2);
  // Of another machine, of a living process, of a person: all stay.
  const std::string stamp = process_stamp(), process = stamp.substr(stamp.find('-'));
  put(scratch / (".ddem-00000000" + process + "-0.tmp"), "x");
  put(scratch / (".ddem-" + stamp + "-7.tmp"), "x");
  put(scratch / ".ddem-mine.tmp", "x");
  put(scratch / "ddem-report-of-2024-07-01.html", "x");
  end_by(SIGTERM, work);
  EXPECT_EQ(scratch.entries(), 4);
  EXPECT_FALSE(fs::exists(scratch / "a"));
  ::unsetenv("TMPDIR");
}

TEST(ProcessStamp, TellsTheLivingFromTheDead) {
  const std::string mine = process_stamp();
  EXPECT_FALSE(is_of_ended_process(".ddem-" + mine + "-0.tmp"));
  EXPECT_FALSE(is_of_ended_process("ddem-fem-" + mine + "-AbCdEf"));
  // The same number, given to another process later.
  EXPECT_TRUE(is_of_ended_process(".ddem-" + mine + "1-0.tmp"));
  std::string ended;
  int channel[2];
  ASSERT_EQ(::pipe(channel), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string stamp = process_stamp();
    [[maybe_unused]] const ssize_t told = ::write(channel[1], stamp.data(), stamp.size());
    ::_exit(0);
  }
  char text[100];
  const ssize_t length = ::read(channel[0], text, sizeof text);
  ASSERT_GT(length, 0);
  ended.assign(text, static_cast<std::size_t>(length));
  EXPECT_NE(ended, mine);
  // Nobody has waited for it yet: where a killed program's parent is a process that never does, it stays so.
  siginfo_t how;
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &how, WEXITED | WNOWAIT), 0);
  EXPECT_TRUE(is_of_ended_process(".ddem-" + ended + "-12.tmp"));
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(is_of_ended_process(".ddem-" + ended + "-12.tmp"));
  EXPECT_TRUE(is_of_ended_process("ddem-fem-" + ended + "-AbCdEf"));
  for (const char* other : {"", "a", "ddem-", "ddem-a-b-c-d", ".ddem-00000000-1-1-1.tmp", "ddem-2024-07-01-x"})
    EXPECT_FALSE(is_of_ended_process(other)) << other;
  const std::string machine = mine.substr(0, mine.find('-'));
  for (const char* number : {"0", "-1", "", "99999999999999", "12x"})
    EXPECT_FALSE(is_of_ended_process("ddem-" + machine + "-" + number + "-5-0.tmp")) << number;
}

}  // namespace
}  // namespace ddem::harness
