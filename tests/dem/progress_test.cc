// Who watches a run may stop it, and what they throw reaches the caller, on any number of threads.

#include <gtest/gtest.h>

#include <stdexcept>

#include "dem/simulation/simulation.h"
#include "dem/spectra/spectra.h"
#include "tests/support/parameters.h"

namespace ddem {
namespace {

SimulationInput watched_input(const Assembly& a, int threads) {
  SimulationInput in;
  in.contact = test::linear_contact(0.5);
  in.time_step = 0.5 * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = 4000;
  in.threads = threads;
  in.initial.ux = test::Noise(1).vector(a.size(), 1e-9);
  return in;
}

TEST(Progress, IsToldAndStopsTheRun) {
  const Assembly a = test::random_free_strip();
  for (const int threads : {1, 2}) {
    SimulationInput in = watched_input(a, threads);
    double told = 0.0;
    in.on_progress = [&told](double done) {
      EXPECT_GT(done, told);
      told = done;
      return done < 0.5;
    };
    const SimulationResult r = simulate(a, in);
    EXPECT_TRUE(r.stopped);
    EXPECT_EQ(r.steps_done, 2000);
    EXPECT_DOUBLE_EQ(told, 0.5);
  }
}

TEST(Progress, WhatItThrowsReachesTheCaller) {
  const Assembly a = test::random_free_strip();
  for (const int threads : {1, 2}) {
    SimulationInput in = watched_input(a, threads);
    in.on_progress = [](double) -> bool { throw std::runtime_error("enough"); };
    EXPECT_THROW(simulate(a, in), std::runtime_error) << threads;
  }
}

}  // namespace
}  // namespace ddem
