// Statistics of packings whose statistics are known.

#include "meshes/packings/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshes/packings/hexagonal.h"
#include "meshes/packings/random.h"

namespace ddem::packings {
namespace {

TEST(PackingStatistics, OfALattice) {
  Packing lattice = hexagonal({.columns = 12, .rows = 10, .radius = 1.0, .periodic_x = true, .periodic_y = true});
  PackingStatistics s = statistics_of(lattice);
  EXPECT_NEAR(s.porosity, 1.0 - std::numbers::pi / (2.0 * std::numbers::sqrt3), 1e-12);
  EXPECT_DOUBLE_EQ(s.mean_radius, 1.0);
  EXPECT_LT(s.largest_overlap, 1e-13);  // the rounding of coordinates
  EXPECT_DOUBLE_EQ(s.ordered_fraction, 1.0);

  // Discs larger by 1 %: all 3 pairs a disc overlap by 0.02, and balance by symmetry.
  for (double& r : lattice.radius) r = 1.01;
  s = statistics_of(lattice);
  EXPECT_NEAR(s.largest_overlap, 0.02 / 1.01, 1e-12);
  EXPECT_EQ(s.contacts, 3 * 120);
  EXPECT_EQ(s.rattlers, 0);
  EXPECT_DOUBLE_EQ(s.held_coordination, 6.0);
  EXPECT_LT(s.fabric_anisotropy, 1e-12);  // three directions, 60 degrees apart
  EXPECT_LT(s.unbalanced_force, 1e-12);
}

// A disc of radius 1.1 in a slot of width 2 overlaps each wall by 0.1; moved by 0.05, the net force is 0.1 and the mean
// one 0.1.
TEST(PackingStatistics, CountsWalls) {
  Packing disc{{1.0, 4.0}, {1.0, 1.0}, {1.1, 0.5}, {}, 6.0, 2.0};
  PackingStatistics s = statistics_of(disc, {.x = false, .y = true});
  EXPECT_EQ(s.contacts, 2);
  EXPECT_EQ(s.rattlers, 2);  // two collinear forces are fewer than three
  EXPECT_NEAR(s.largest_overlap, 0.1 / 0.8, 1e-12);
  EXPECT_LT(s.unbalanced_force, 1e-12);
  disc.y[0] = 1.05;
  s = statistics_of(disc, {.x = false, .y = true});
  EXPECT_NEAR(s.unbalanced_force, 0.1 / 0.1, 1e-12);
  EXPECT_EQ(statistics_of(disc).contacts, 0);
}

// A row along a diagonal: all contacts are parallel; none is held. Of a cross, half of them are.
TEST(PackingStatistics, TellsDirections) {
  Packing row;
  row.length = row.width = 20.0;
  const double step = 1.99 / std::numbers::sqrt2;
  for (int k = 0; k < 5; ++k) row.x.push_back(5.0 + k * step), row.y.push_back(5.0 + k * step), row.radius.push_back(1.0);
  PackingStatistics s = statistics_of(row);
  EXPECT_EQ(s.contacts, 4);
  EXPECT_NEAR(s.fabric_anisotropy, 1.0, 1e-12);
  EXPECT_EQ(s.rattlers, 5);
  EXPECT_EQ(s.held_coordination, 0.0);

  const Packing cross{{10.0, 8.01, 11.99, 10.0, 10.0}, {10.0, 10.0, 10.0, 8.01, 11.99}, {1.0, 1.0, 1.0, 1.0, 1.0}, {}, 20.0, 20.0};
  EXPECT_LT(statistics_of(cross).fabric_anisotropy, 1e-12);

  // A disc in the square of four, held by all, and the four by it and by walls.
  const double out = 1.99 / std::numbers::sqrt2;
  const Packing box{{2.4, 2.4 - out, 2.4 + out, 2.4 - out, 2.4 + out}, {2.4, 2.4 - out, 2.4 - out, 2.4 + out, 2.4 + out}, {1.0, 1.0, 1.0, 1.0, 1.0}, {}, 4.8, 4.8};
  s = statistics_of(box, {.x = true, .y = true});
  EXPECT_EQ(s.rattlers, 0);
  EXPECT_EQ(s.contacts, 12);
  EXPECT_DOUBLE_EQ(s.held_coordination, 24.0 / 5.0);
}

// Equal discs crystallise, and that is seen; discs of the ratio of the paper do not.
TEST(PackingStatistics, TellsACrystal) {
  RandomSpec spec{.length = 16.5e-3, .width = 2e-3, .discs = 682, .seed = 3, .radius_ratio = 1.0};
  EXPECT_GT(statistics_of(random_jammed(spec)).ordered_fraction, kCrystalFraction);
  spec.radius_ratio = 1.67;
  EXPECT_LT(statistics_of(random_jammed(spec)).ordered_fraction, 0.2);
}

}  // namespace
}  // namespace ddem::packings
