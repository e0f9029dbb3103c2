#include "meshes/packings/tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <vector>

#include "dem/assembly/contacts.h"
#include "meshes/packings/hexagonal.h"
#include "tests/support/oracle_files.h"

namespace ddem::packings {
namespace {

// A periodic cell and its copies are the same infinite packing: every copy of a bond is there, once.
TEST(Tile, HasTheContactsOfTheInfinitePacking) {
  const Packing cell = test::oracle_packing("packings/p682_s1.csv", {16.5e-3, 2e-3}, 16.5e-3, 2e-3);
  const Packing tiled = tile(cell, 2, 3);
  const double gap = 0.3 * mean_radius(cell);
  const Bonds one = bonds_within_gap(cell, gap), six = bonds_within_gap(tiled, gap);
  ASSERT_EQ(six.size(), 6 * one.size());

  const int n = static_cast<int>(cell.size());
  std::map<std::pair<int, int>, std::vector<double>> lengths;
  for (std::size_t b = 0; b < six.size(); ++b)
    lengths[std::minmax(six.i[b] % n, six.j[b] % n)].push_back(six.length[b]);
  for (std::size_t b = 0; b < one.size(); ++b) {
    const auto& copies = lengths[{one.i[b], one.j[b]}];
    ASSERT_EQ(copies.size(), 6u);
    // Shifting by 33 mm costs a few units of its last place, 7e-18 m each.
    for (const double length : copies) EXPECT_NEAR(length, one.length[b], 3e-17);
  }
}

TEST(Tile, GrowsTheCell) {
  const Packing cell =
      hexagonal({.columns = 4, .rows = 4, .radius = 1.0, .periodic_x = true, .periodic_y = true});
  const Packing tiled = tile(cell, 3, 2);
  ASSERT_EQ(tiled.size(), 6 * 16u);
  EXPECT_DOUBLE_EQ(tiled.length, 3 * cell.length);
  EXPECT_DOUBLE_EQ(tiled.width, 2 * cell.width);
  EXPECT_DOUBLE_EQ(tiled.period.x, 3 * cell.period.x);
  EXPECT_DOUBLE_EQ(tiled.period.y, 2 * cell.period.y);
  // disc 5 of copy (2, 1)
  const int k = (2 * 2 + 1) * 16 + 5;
  EXPECT_DOUBLE_EQ(tiled.x[k], cell.x[5] + 2 * cell.period.x);
  EXPECT_DOUBLE_EQ(tiled.y[k], cell.y[5] + cell.period.y);
}

TEST(Tile, RefusesWhatIsNotPeriodic) {
  const Packing strip = hexagonal({.columns = 6, .rows = 4, .radius = 1.0, .periodic_y = true});
  EXPECT_EQ(tile(strip, 1, 2).size(), 2 * strip.size());
  EXPECT_THROW(tile(strip, 2, 1), std::invalid_argument);
  EXPECT_THROW(tile(strip, 0, 1), std::invalid_argument);
  EXPECT_THROW(tile(strip, 1, 100000000), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::packings
