#include "dem/core/team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace ddem {
namespace {

TEST(Team, ThrowsWhatAThreadThrowsAndGoesOn) {
  Team team(3);
  for (const int thrower : {0, 2}) {
    const auto job = [&](int thread) {
      if (thread == thrower) throw std::runtime_error("no");
    };
    EXPECT_THROW(team.run(job), std::runtime_error);
    std::atomic<int> done = 0;
    team.run([&](int) { ++done; });
    EXPECT_EQ(done, 3);
  }
}

TEST(Team, MeetsBeforeAnyoneGoesOn) {
  // More threads than cores, too: who is late must get its turn.
  for (const int threads : {2, 5}) {
    Team team(threads);
    std::vector<int> steps(static_cast<std::size_t>(threads), 0);
    std::atomic<int> apart = 0;
    team.run([&](int thread) {
      for (int step = 1; step <= 200; ++step) {
        steps[static_cast<std::size_t>(thread)] = step;
        team.meet(thread);
        for (const int other : steps) apart += other != step;
        team.meet(thread);
      }
    });
    EXPECT_EQ(apart, 0);
  }
}

}  // namespace
}  // namespace ddem
