// Timing: laws take turns, and the numbers are what they say.

#include "harness/bench/kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "harness/bench/triad.h"
#include "harness/measure/median.h"

namespace ddem::harness::bench {
namespace {

TEST(Median, OfOddAndEvenNumbersOfValues) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
  EXPECT_EQ(median({7.0}), 7.0);
  EXPECT_TRUE(std::isnan(median({})));
}

TEST(Kernels, EveryLawIsTimedOnceForEachNumberOfThreads) {
  int heard = 0;
  const auto times = time_kernels({{Arrangement::lattice, 240, 30, 3, true, true, {1, 2}}}, [&] { ++heard; });
  EXPECT_EQ(heard, 1);
  std::set<std::tuple<std::string, bool, int>> seen;
  for (const KernelTime& k : times) {
    EXPECT_TRUE(seen.insert({k.law, k.per_bond_stiffness, k.threads}).second) << k.law;
    EXPECT_GT(k.best, 0.0);
    EXPECT_LE(k.best, k.nanoseconds_per_bond_step);
    EXPECT_LT(k.nanoseconds_per_bond_step, 1e6);  // a step of 700 bonds below a second
    EXPECT_GT(k.over_dem, 0.0);
    EXPECT_NEAR(static_cast<double>(k.discs), 240.0, 20.0);
    EXPECT_GT(k.bonds, 2 * k.discs);
    EXPECT_GT(k.bytes_per_bond, 60.0);  // two half-bonds of 20 bytes, and more than a third of a disc's 60
    EXPECT_LT(k.bytes_per_bond, 600.0);
    if (k.law == "DEM" && !k.per_bond_stiffness) {
      EXPECT_EQ(k.over_dem, 1.0);
    }
  }
  EXPECT_EQ(seen.size(), 2u * (2u * 4u + 2u));
}

TEST(Kernels, DeformableOnesAreComparedWithDemOfAsMuchShear) {
  std::map<std::string, KernelTime> times;
  for (const KernelTime& k : time_kernels({{Arrangement::lattice, 240, 10, 1, true, false, {1}}}, [] {})) {
    if (!k.per_bond_stiffness) times[k.law] = k;
  }
  for (const std::string law : {"lagged", "implicit"}) {  // of one round, the ratio of the times
    for (const std::string shear : {"", ", k_t = 0"}) {
      const KernelTime& k = times.at(law + shear);
      EXPECT_NEAR(k.over_dem, k.nanoseconds_per_bond_step / times.at("DEM" + shear).nanoseconds_per_bond_step, 1e-12 * k.over_dem);
    }
  }
}

TEST(Kernels, RigidDiscsAlone) {
  const auto times = time_kernels({{Arrangement::lattice, 240, 10, 1, false, false, {1}}}, [] {});
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].law, "DEM, k_t = 0");
  EXPECT_EQ(times[1].law, "DEM");
}

TEST(Kernels, OfARandomPackingAsWell) {
  const auto times = time_kernels({{Arrangement::random, 682, 2, 1, true, false, {1}}}, [] {});
  ASSERT_EQ(times.size(), 6u);
  for (const KernelTime& k : times) {
    EXPECT_EQ(k.arrangement, Arrangement::random);
    EXPECT_EQ(k.discs, 682u);
    // 5.8 inside; of 682 discs a quarter stand at free edges, which have about two bonds fewer.
    EXPECT_NEAR(2.0 * static_cast<double>(k.bonds) / static_cast<double>(k.discs), 5.8 - 0.25 * 2.0, 0.2);
    EXPECT_GT(k.nanoseconds_per_bond_step, 0.0);
  }
}

TEST(Triad, IsBetweenADiskAndACache) {
  for (const int threads : {1, 3}) {
    const double rate = triad_gb_per_s(threads);
    EXPECT_GT(rate, 0.1);
    EXPECT_LT(rate, 1e4);
  }
}

}  // namespace
}  // namespace ddem::harness::bench
