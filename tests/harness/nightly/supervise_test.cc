// A unit that crashes is an outcome, and the rest of the campaign goes on.

#include "harness/nightly/supervise.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "harness/io/errors.h"
#include "tests/harness/nightly/toy_units.h"

namespace ddem::harness::nightly {
namespace {

/// Sanitizers catch SIGSEGV, the kernel would write a core.
void die_of(int signal) {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// As ddem validate does it.
int run_supervised(const std::vector<Unit>& units, RunOptions options) {
  const Plan plan = toy_plan(units);
  UnitBoard board(units.size());
  options.board = &board;
  const auto work = [&](bool first_time) -> int {
    options.resume = options.resume || !first_time;
    run_units(units, plan, options, [](std::size_t, const Outcome&) {});
    ::_exit(7);
  };
  return supervise(board, work, [&](std::size_t unit, const std::string& reason) {
    write_unit(options.folder, {plan.units[unit].id, plan.units[unit].identity, {nullptr, reason}});
    options.given_up.push_back(unit);
  });
}

/// Of a supervisor that is asked to end: the child hears of it and may leave by itself; then what `on_interrupt` does is done,
/// and the supervisor has died of the same request.
TEST(Supervise, RequestsToEndReachTheChildFirst) {
  for (const int request : {SIGINT, SIGTERM, SIGHUP}) {
    int said[2];
    ASSERT_EQ(::pipe(said), 0);
    const auto say = [&said](const char* word) { return ::write(said[1], word, 1) == 1; };
    const pid_t supervisor = ::fork();
    if (supervisor == 0) {
      UnitBoard board(1);
      static int heard = said[1];
      const auto work = [&](bool) -> int {
        std::signal(request, [](int signal) {
          if (::write(heard, "c", 1) != 1) ::_exit(1);
          std::signal(signal, SIG_DFL);
          std::raise(signal);
        });
        say("r");
        for (;;) ::pause();
      };
      supervise(board, work, [](std::size_t, const std::string&) {}, [&] { say("i"); });
      ::_exit(1);
    }
    char word = 0;
    ASSERT_EQ(::read(said[0], &word, 1), 1);
    EXPECT_EQ(word, 'r');
    ::kill(supervisor, request);
    int status = 0;
    ::waitpid(supervisor, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == request) << status;
    ::close(said[1]);
    std::string words;
    while (::read(said[0], &word, 1) == 1) words += word;
    EXPECT_EQ(words, "ci");
    ::close(said[0]);
  }
}

TEST(Supervise, ACrashIsAFailureAndTheRestIsThere) {
  for (const int jobs : {1, 2}) {
    const Scratch scratch;
    std::vector<Unit> units = toy_units(12);
    const Outcomes whole = outcomes_of(units, {});
    for (const auto& [k, signal] : {std::pair{3, SIGSEGV}, {7, SIGABRT}, {11, SIGKILL}}) {
      units[k].run = [signal = signal] {
        die_of(signal);
        return nlohmann::json();
      };
    }
    EXPECT_EQ(run_supervised(units, {.folder = scratch / "", .jobs = jobs}), 7);
    const Outcomes found = outcomes_in(scratch / "", units);
    int crashed = 0;
    for (std::size_t k = 0; k < units.size(); ++k) {
      if (found.at(k) == whole.at(k)) continue;
      EXPECT_NE(found.at(k).find("killed by signal"), std::string::npos) << k;
      ++crashed;
    }
    // What ran beside the one that crashed is not trusted either.
    EXPECT_GE(crashed, 3);
    EXPECT_LE(crashed, 3 * jobs);
    EXPECT_NE(found.at(3), whole.at(3));
  }
}

TEST(Supervise, NothingRunning) {
  UnitBoard board(3);
  EXPECT_EQ(supervise(
                board, [](bool) -> int { ::_exit(0); }, [](std::size_t, const std::string&) { FAIL(); }),
            0);
  const auto die = [](bool) -> int {
    die_of(SIGSEGV);
    return 0;
  };
  EXPECT_THROW(supervise(board, die, [](std::size_t, const std::string&) { FAIL(); }), MachineError);
}

}  // namespace
}  // namespace ddem::harness::nightly
