#include "harness/io/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "harness/io/leftovers.h"

namespace ddem::harness {
namespace {

using std::chrono::seconds;

TEST(ProgressLine, FractionAndTimeLeft) {
  EXPECT_EQ(progress_line(10, 20, seconds(80), "shear"),
            "[##########..........]  50 % 10/20 shear, 1 min 20 s left");
  EXPECT_EQ(progress_line(1, 4, seconds(5), ""), "[#####...............]  25 % 1/4, 15 s left");
  EXPECT_EQ(progress_line(1, 3, seconds(3600), ""), "[######..............]  33 % 1/3, 2 h 0 min left");
  // Nothing is known before the first unit, and nothing is left after the last.
  EXPECT_EQ(progress_line(0, 3, seconds(5), ""), "[....................]   0 % 0/3");
  EXPECT_EQ(progress_line(3, 3, seconds(5), ""), "[####################] 100 % 3/3");
  EXPECT_EQ(progress_line(9, 3, seconds(5), ""), "[####################] 100 % 3/3");
  EXPECT_EQ(progress_line(0, 0, seconds(5), ""), "[####################] 100 % 0/0");
}

/// Both ends of a pseudo-terminal; what is written to `terminal` is read from `screen`.
struct PseudoTerminal {
  int screen = ::posix_openpt(O_RDWR | O_NOCTTY), terminal = -1;

  PseudoTerminal() {
    if (screen < 0 || ::grantpt(screen) != 0 || ::unlockpt(screen) != 0) return;
    terminal = ::open(::ptsname(screen), O_RDWR | O_NOCTTY);
    ::fcntl(screen, F_SETFL, O_NONBLOCK);
  }
  ~PseudoTerminal() {
    ::close(terminal);
    ::close(screen);
  }
  /// All up to `end`, or what came within five seconds: the kernel hands over from one end to the other
  /// later, and in pieces.
  std::string shown_until(const std::string& end) const {
    std::string text;
    pollfd watched{screen, POLLIN, 0};
    while (!text.ends_with(end) && ::poll(&watched, 1, 5000) > 0) {
      char block[1 << 12];
      const ssize_t count = ::read(screen, block, sizeof block);
      if (count <= 0) break;
      text.append(block, static_cast<std::size_t>(count));
    }
    return text;
  }
};

TEST(Progress, DrawsOnATerminalNotTooOftenFromAnyThread) {
  const PseudoTerminal pty;
  if (pty.terminal < 0) GTEST_SKIP() << "no pseudo-terminals here";
  constexpr int workers = 4, each = 5000;
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress(workers * each, "cases", pty.terminal);
    std::vector<std::thread> threads;
    for (int w = 0; w < workers; ++w)
      threads.emplace_back([&] {
        for (int n = 0; n < each; ++n) progress.advance();
      });
    for (std::thread& thread : threads) thread.join();
  }
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string wipe = "\r\033[K";
  const std::string shown = pty.shown_until(wipe);
  EXPECT_NE(shown.find("100 % 20000/20000 cases"), std::string::npos) << shown;
  EXPECT_TRUE(shown.ends_with(wipe)) << shown;
  // The first, the last, ten a second, and the wipe.
  const auto drawn = std::count(shown.begin(), shown.end(), '\r');
  EXPECT_LE(static_cast<double>(drawn), 3.0 + 10.0 * elapsed);
}

/// Whatever ends the program, no bar stays in front of the shell's next line.
TEST(Progress, IsWipedWhereASignalEndsTheProgram) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const PseudoTerminal pty;
    if (pty.terminal < 0) GTEST_SKIP() << "no pseudo-terminals here";
    const pid_t child = ::fork();
    if (child == 0) {
      clean_up_on_signals();
      Progress progress(3, "cases", pty.terminal);
      progress.advance();
      ::raise(signal);
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    const std::string wipe = "\r\033[K";
    EXPECT_TRUE(pty.shown_until(wipe).ends_with(wipe)) << signal;
  }
}

TEST(Progress, LeavesDumbTerminalsAlone) {
  const PseudoTerminal pty;
  if (pty.terminal < 0) GTEST_SKIP() << "no pseudo-terminals here";
  const char* kind = ::getenv("TERM");
  const std::string before = kind == nullptr ? "" : kind;
  ::setenv("TERM", "dumb", 1);
  {
    Progress progress(3, "cases", pty.terminal, std::chrono::milliseconds(20));
    progress.advance();
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    wipe_progress(pty.terminal);
  }
  ::setenv("TERM", before.c_str(), 1);
  const std::string shown = pty.shown_until("left\r\n");
  EXPECT_NE(shown.find("1/3 cases"), std::string::npos) << shown;
  EXPECT_EQ(shown.find('\033'), std::string::npos) << shown;
}

TEST(ProgressLine, ForALog) {
  EXPECT_EQ(progress_log_line(10, 20, seconds(80), "shear"), "10/20 shear (50 %), 1 min 20 s left");
  EXPECT_EQ(progress_log_line(1, 4, seconds(5), ""), "1/4 (25 %), 15 s left");
  EXPECT_EQ(progress_log_line(0, 3, seconds(5), "cases"), "0/3 cases (0 %), 5 s so far");
  EXPECT_EQ(progress_log_line(9, 3, seconds(5), "cases"), "3/3 cases (100 %), 5 s so far");
}

/// A line now and then, also while nothing is done: as many as there are intervals, each whole.
TEST(Progress, LinesInALog) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_NONBLOCK), 0);
  const auto start = std::chrono::steady_clock::now();
  {
    Progress progress(3, "cases", ends[1], std::chrono::milliseconds(50));
    progress.advance(2);
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
  }
  const auto elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string shown(4096, '\0');
  const ssize_t bytes = ::read(ends[0], shown.data(), shown.size());
  ASSERT_GT(bytes, 0);
  shown.resize(static_cast<std::size_t>(bytes));
  const auto lines = std::count(shown.begin(), shown.end(), '\n');
  EXPECT_GE(lines, 2);
  EXPECT_LE(static_cast<double>(lines), 1.0 + elapsed / 0.05);
  EXPECT_TRUE(shown.starts_with("2/3 cases (67 %), ")) << shown;
  EXPECT_EQ(shown.find('\r'), std::string::npos);
  EXPECT_EQ(shown.find('\033'), std::string::npos);
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(Progress, ShortWorkIsSilentElsewhere) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_NONBLOCK), 0);
  {
    Progress progress(3, "cases", ends[1]);
    progress.advance(2);
    progress.set_label("more");
    progress.advance();
  }
  char byte;
  EXPECT_EQ(::read(ends[0], &byte, 1), -1);  // nothing there
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace ddem::harness
