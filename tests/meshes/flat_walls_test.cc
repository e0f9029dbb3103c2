// Packings between flat walls: all discs inside, touching every wall, jammed.

#include "meshes/packings/flat_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/assembly/contacts.h"
#include "meshes/packings/random.h"
#include "meshes/packings/statistics.h"

namespace ddem::packings {
namespace {

struct Extent {
  double low, high;
};

Extent extent(const std::vector<double>& centre, const std::vector<double>& radius) {
  Extent e{centre[0], centre[0]};
  for (std::size_t i = 0; i < centre.size(); ++i) {
    e.low = std::min(e.low, centre[i] - radius[i]);
    e.high = std::max(e.high, centre[i] + radius[i]);
  }
  return e;
}

class BetweenWalls : public testing::TestWithParam<double> {};

TEST_P(BetweenWalls, FillsTheBoxAndIsJammed) {
  for (const FlatWalls walls : {FlatWalls{true, true}, FlatWalls{true, false}}) {
    const RandomSpec spec{.length = 16.5e-3, .width = 2e-3, .discs = 682, .seed = 2, .radius_ratio = GetParam(), .walls = walls};
    const Packing packing = random_jammed(spec);
    ASSERT_EQ(packing.size(), 682u);
    EXPECT_EQ(packing.length, 16.5e-3);
    EXPECT_EQ(packing.width, 2e-3);
    EXPECT_EQ(packing.period.x, 0.0);
    EXPECT_EQ(packing.period.y, walls.y ? 0.0 : 2e-3);

    const PackingStatistics s = statistics_of(packing, walls);
    // The discs end at the walls, within the largest overlap.
    const double overlap = 1e-3 * s.mean_radius;
    const Extent x = extent(packing.x, packing.radius), y = extent(packing.y, packing.radius);
    EXPECT_TRUE(std::abs(x.low) <= overlap && std::abs(x.high - 16.5e-3) <= overlap);
    const bool ends_at_walls = std::abs(y.low) <= overlap && std::abs(y.high - 2e-3) <= overlap;
    EXPECT_EQ(ends_at_walls, walls.y);
    EXPECT_LE(s.largest_overlap, 1e-3);
    EXPECT_LE(s.unbalanced_force, 1.01e-4);
    // Rigid without friction: as many contacts as degrees of freedom (walls hold the sample, unless it slides along y).
    EXPECT_GE(s.contacts, 2 * (682 - s.rattlers) - 1);
    EXPECT_GT(s.porosity, 0.12);
    EXPECT_LT(s.porosity, 0.19);
  }
}

TEST_P(BetweenWalls, HasTheCoordinationAskedForInside) {
  const FlatWalls walls{true, true};
  const Packing packing = random_jammed(
      {.length = 16.5e-3, .width = 2e-3, .discs = 682, .seed = 1, .radius_ratio = GetParam(), .walls = walls});
  const std::vector<char> inner = inner_discs(packing, walls);
  const auto counted = std::count(inner.begin(), inner.end(), 1);
  EXPECT_GT(counted, 400);
  EXPECT_LT(counted, 640);
  for (const double wanted : {4.6, 5.2, 5.9}) {
    const Bonds bonds = bonds_within_gap(packing, gap_for_coordination(packing, wanted, inner));
    EXPECT_NEAR(coordination(bonds, inner), wanted, 1.0 / static_cast<double>(counted) + 1e-9);
    EXPECT_LT(coordination(bonds, packing.size()), wanted);  // discs at a wall have neighbours on one side only
  }
}

INSTANTIATE_TEST_SUITE_P(RadiusRatios, BetweenWalls, testing::Values(1.67, 10.0));

TEST(FlatWalls, EqualDiscsJamToo) {
  const FlatWalls walls{true, true};
  const PackingStatistics s = statistics_of(
      random_jammed({.length = 16.5e-3, .width = 2e-3, .discs = 682, .radius_ratio = 1.0, .walls = walls}), walls);
  EXPECT_LE(s.largest_overlap, 1e-3);
  EXPECT_GT(s.ordered_fraction, kCrystalFraction);
}

TEST(FlatWalls, InnerDiscsAreAwayFromThem) {
  const Packing packing{{1.0, 5.0, 2.5}, {3.0, 3.0, 3.0}, {1.0, 1.0, 1.0}, {}, 10.0, 6.0};
  EXPECT_DOUBLE_EQ(gap_to_walls(packing, {true, true}, 0), 0.0);
  EXPECT_DOUBLE_EQ(gap_to_walls(packing, {true, true}, 1), 2.0);
  EXPECT_EQ(inner_discs(packing, {true, true}), (std::vector<char>{0, 1, 1}));
  EXPECT_EQ(inner_discs(packing, {}), (std::vector<char>{1, 1, 1}));
}

}  // namespace
}  // namespace ddem::packings
