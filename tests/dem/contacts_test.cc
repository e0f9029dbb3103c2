// Neighbour search against brute force over all images, and the choice of bonds.

#include "dem/assembly/contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/assemblies.h"
#include "tests/support/oracle_files.h"

namespace ddem {
namespace {

/// Discs of random radius anywhere in [-1, 2] x [-1, 2] times (length, width): periodic images must be found
/// for centres outside the cell too.
Packing scattered(int discs, double length, double width, bool x_periodic, bool y_periodic,
                  std::uint64_t seed) {
  test::Noise noise(seed);
  Packing p;
  p.length = length;
  p.width = width;
  p.period = {x_periodic ? length : 0.0, y_periodic ? width : 0.0};
  for (int i = 0; i < discs; ++i) {
    p.x.push_back(length * (0.5 + (x_periodic ? 1.5 : 0.5) * noise()));
    p.y.push_back(width * (0.5 + (y_periodic ? 1.5 : 0.5) * noise()));
    p.radius.push_back(0.1 + 0.05 * noise());
  }
  return p;
}

/// All pairs, the nearest of the images found by trying many.
std::vector<ClosePair> brute_force(const Packing& p, double max_gap) {
  std::vector<ClosePair> pairs;
  for (int i = 0; i < static_cast<int>(p.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(p.size()); ++j) {
      ClosePair best{i, j, 0.0, 0.0, INFINITY};
      for (int a = -4; a <= 4; ++a)
        for (int b = -4; b <= 4; ++b) {
          const double dx = p.x[j] - p.x[i] + a * p.period.x, dy = p.y[j] - p.y[i] + b * p.period.y;
          const double gap = std::hypot(dx, dy) - p.radius[i] - p.radius[j];
          if (gap < best.gap) best = {i, j, dx, dy, gap};
        }
      if (best.gap <= max_gap) pairs.push_back(best);
    }
  return pairs;
}

void expect_equal(const std::vector<ClosePair>& found, const std::vector<ClosePair>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].i, expected[k].i);
    EXPECT_EQ(found[k].j, expected[k].j);
    // coordinates of order 10 and periods: a few units in the last place
    EXPECT_NEAR(found[k].dx, expected[k].dx, 1e-14);
    EXPECT_NEAR(found[k].dy, expected[k].dy, 1e-14);
    EXPECT_NEAR(found[k].gap, expected[k].gap, 1e-14);
  }
}

TEST(ClosePairs, AgreesWithBruteForce) {
  struct Case {
    int discs;
    double length, width, max_gap;
  };
  // From cells that hold barely two grid cells (reach 0.4: periods above 0.8) to many.
  const std::vector<Case> cases = {{200, 10.0, 3.0, 0.1}, {40, 0.81, 0.81, 0.1},  {60, 1.0, 1.3, 0.1},
                                   {60, 5.0, 0.85, 0.12}, {100, 4.0, 4.0, -0.05}, {2, 1.0, 1.0, 0.2}};
  for (const Case& c : cases)
    for (const bool x_periodic : {false, true})
      for (const bool y_periodic : {false, true})
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
          SCOPED_TRACE(testing::Message() << c.length << " x " << c.width << " periodic " << x_periodic
                                          << y_periodic << " seed " << seed);
          const Packing p = scattered(c.discs, c.length, c.width, x_periodic, y_periodic, seed);
          const auto expected = brute_force(p, c.max_gap);
          if (c.discs > 2) {
            EXPECT_FALSE(expected.empty());
          }
          expect_equal(close_pairs(p, c.max_gap), expected);
        }
}

TEST(ClosePairs, FindsNeighboursAcrossBothEdges) {
  Packing p{{0.05, 9.95, 5.0}, {0.05, 3.95, 2.0}, {0.1, 0.1, 0.1}, {10.0, 4.0}, 10.0, 4.0};
  const auto pairs = close_pairs(p, 0.0);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].i, 0);
  EXPECT_EQ(pairs[0].j, 1);
  EXPECT_NEAR(pairs[0].dx, -0.1, 1e-14);
  EXPECT_NEAR(pairs[0].dy, -0.1, 1e-14);
  p.period.y = 0.0;
  EXPECT_TRUE(close_pairs(p, 0.0).empty());
}

// Two rows of a hexagonal lattice, periodic: the lower row touches the upper one from above and from below.
TEST(ClosePairs, RefusesPeriodsWithTwoImages) {
  const double s = std::numbers::sqrt3;
  const Packing p{{0.5, 1.5, 1.0, 2.0}, {0.0, 0.0, s / 2, s / 2}, {0.5, 0.5, 0.5, 0.5}, {0.0, s}, 2.0, s};
  EXPECT_THROW(close_pairs(p, 1e-9), std::invalid_argument);
  try {
    close_pairs(p, 1e-9);
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("period in y"), std::string::npos) << error.what();
  }
}

TEST(ClosePairs, RefusesWhatIsNoPacking) {
  const Packing good{{0.0, 1.0}, {0.0, 0.0}, {0.5, 0.5}, {}, 2.0, 1.0};
  EXPECT_EQ(close_pairs(good, 1e-9).size(), 1u);
  EXPECT_TRUE(close_pairs(Packing{}, 0.1).empty());
  EXPECT_TRUE(close_pairs(good, -5.0).empty());
  const auto refused = [&](auto change) {
    Packing p = good;
    change(p);
    EXPECT_THROW(close_pairs(p, 0.1), std::invalid_argument);
  };
  refused([](Packing& p) { p.x[1] = NAN; });
  refused([](Packing& p) { p.y[0] = INFINITY; });
  refused([](Packing& p) { p.radius[0] = 0.0; });
  refused([](Packing& p) { p.radius[0] = NAN; });
  refused([](Packing& p) { p.y.pop_back(); });
  refused([](Packing& p) { p.period.x = -1.0; });
  refused([](Packing& p) {
    p.period.x = 10.0;
    p.x[0] = 1e300;
  });
  EXPECT_THROW(close_pairs(good, NAN), std::invalid_argument);
  EXPECT_THROW(close_pairs(good, INFINITY), std::invalid_argument);
}

// An outlier must cost neither memory nor time, nor hide its neighbour.
TEST(ClosePairs, CopesWithOutliers) {
  Packing p = scattered(1000, 10.0, 10.0, false, false, 3);
  const std::size_t before = close_pairs(p, 0.0).size();
  for (const double offset : {0.0, 0.1}) {
    p.x.push_back(1e9 + offset);
    p.y.push_back(-1e12);
    p.radius.push_back(0.1);
  }
  EXPECT_EQ(close_pairs(p, 0.0).size(), before + 1);
}

TEST(Bonds, HaveUnitNormalsAndArmsThatMeet) {
  const Packing p = scattered(100, 4.0, 4.0, true, true, 1);
  const auto pairs = close_pairs(p, 0.1);
  const Bonds bonds = bonds_of(p, pairs);
  ASSERT_EQ(bonds.size(), pairs.size());
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    EXPECT_NEAR(std::hypot(bonds.nx[b], bonds.ny[b]), 1.0, 1e-15);
    EXPECT_NEAR(bonds.nx[b] * bonds.length[b], pairs[b].dx, 1e-15);
    EXPECT_NEAR(bonds.arm_i[b] + bonds.arm_j[b], bonds.length[b], 1e-15);
    EXPECT_NEAR(bonds.arm_i[b] * p.radius[bonds.j[b]], bonds.arm_j[b] * p.radius[bonds.i[b]], 1e-15);
  }
  const Packing same{{1.0, 1.0}, {0.0, 0.0}, {0.5, 0.5}, {}, 1.0, 1.0};
  EXPECT_THROW(bonds_within_gap(same, 0.0), std::invalid_argument);
}

TEST(Bonds, AreAsManyAsInTheOracles) {
  int seed = 0;
  for (const test::Row& row : test::oracle_rows("packings/moduli_periodic_xy.csv")) {
    if (std::stoi(row[0]) == seed) continue;
    seed = std::stoi(row[0]);
    const Packing p =
        test::oracle_packing("packings/p682_s" + row[0] + ".csv", {16.5e-3, 2e-3}, 16.5e-3, 2e-3);
    const Bonds bonds = bonds_within_gap(p, std::stod(row[1]) * mean_radius(p));
    EXPECT_EQ(bonds.size(), std::stoul(row[2]));
    EXPECT_NEAR(coordination(bonds, p.size()), std::stod(row[3]), 1e-6);  // printed digits
  }
  EXPECT_EQ(seed, 6);
}

TEST(GapForCoordination, IsNearestToTheTarget) {
  const Packing p = test::oracle_packing("packings/p682_s2.csv", {16.5e-3, 2e-3}, 16.5e-3, 2e-3);
  for (const double target : {4.0, 4.6, 5.14, 5.8, 6.3}) {
    const double gap = gap_for_coordination(p, target);
    const double reached = coordination(bonds_within_gap(p, gap), p.size());
    EXPECT_NEAR(reached, target, 1.0 / 682.0 + 1e-12);
    // Half-way between two gaps: a change of the gap by rounding changes nothing.
    EXPECT_EQ(bonds_within_gap(p, gap * (1.0 + 1e-12)).size(),
              bonds_within_gap(p, gap * (1.0 - 1e-12)).size());
  }
}

TEST(GapForCoordination, TakesOrRefusesWholeShellsOfALattice) {
  const Packing p =
      packings::hexagonal({.columns = 6, .rows = 6, .radius = 1.0, .periodic_x = true, .periodic_y = true});
  const double gap = gap_for_coordination(p, 6.0);
  EXPECT_GT(gap, 0.1);
  EXPECT_DOUBLE_EQ(coordination(bonds_within_gap(p, gap), p.size()), 6.0);
  for (const double impossible : {5.8, 6.2, 11.0})
    EXPECT_THROW(gap_for_coordination(p, impossible), std::invalid_argument);
  try {
    gap_for_coordination(p, 5.8);
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("6"), std::string::npos) << error.what();
  }
  // The smallest cell that closes: two mean radii are out of reach there, touching discs are not.
  const Packing small =
      packings::hexagonal({.columns = 3, .rows = 4, .radius = 1.0, .periodic_x = true, .periodic_y = true});
  EXPECT_DOUBLE_EQ(coordination(bonds_within_gap(small, gap_for_coordination(small, 6.0)), small.size()),
                   6.0);
}

TEST(GapForCoordination, RefusesWhatCannotBe) {
  const Packing p = scattered(50, 10.0, 10.0, false, false, 1);
  for (const double target : {0.0, -1.0, 49.0, 1e9, static_cast<double>(NAN)})
    EXPECT_THROW(gap_for_coordination(p, target), std::invalid_argument) << target;
  EXPECT_THROW(gap_for_coordination(Packing{{0.0}, {0.0}, {1.0}, {}, 2.0, 2.0}, 1.0), std::invalid_argument);
}

TEST(BondsBetween, IsTheSameNetworkWhateverTheOrder) {
  const Packing p = scattered(60, 4.0, 4.0, true, true, 2);
  const Bonds expected = bonds_within_gap(p, 0.1);
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t b = expected.size(); b-- > 0;) pairs.emplace_back(expected.j[b], expected.i[b]);
  const Bonds bonds = bonds_between(p, pairs);
  EXPECT_EQ(bonds.i, expected.i);
  EXPECT_EQ(bonds.j, expected.j);
  EXPECT_EQ(bonds.nx, expected.nx);
  EXPECT_EQ(bonds.length, expected.length);
}

TEST(BondsBetween, RefusesBadPairs) {
  const Packing p{{0.0, 1.0, 2.0}, {0.0, 0.0, 0.0}, {0.5, 0.5, 0.5}, {4.0, 0.0}, 4.0, 1.0};
  using Pairs = std::vector<std::pair<int, int>>;
  EXPECT_EQ(bonds_between(p, Pairs{{0, 1}, {2, 1}}).size(), 2u);
  EXPECT_THROW(bonds_between(p, Pairs{{0, 3}}), std::invalid_argument);
  EXPECT_THROW(bonds_between(p, Pairs{{-1, 1}}), std::invalid_argument);
  EXPECT_THROW(bonds_between(p, Pairs{{1, 1}}), std::invalid_argument);
  EXPECT_THROW(bonds_between(p, Pairs{{0, 1}, {1, 0}}), std::invalid_argument);
  EXPECT_THROW(bonds_between(p, Pairs{{0, 2}}), std::invalid_argument);  // two images at half a period
}

TEST(MeanRadius, IsTheMean) {
  EXPECT_DOUBLE_EQ(mean_radius(Packing{{0.0, 3.0}, {0.0, 0.0}, {1.0, 2.0}, {}, 1.0, 1.0}), 1.5);
  EXPECT_THROW(mean_radius(Packing{}), std::invalid_argument);
  EXPECT_THROW(coordination(Bonds{}, 0), std::invalid_argument);
}

// A row of four discs with gaps 0.1, 0.2, 0.3: over the two inner discs, one gap of 0.1 counts one end, 0.2 two.
TEST(GapForCoordination, CountsTheMarkedDiscsOnly) {
  const Packing row{{0.0, 2.1, 4.3, 6.6}, {0.0, 0.0, 0.0, 0.0}, {1.0, 1.0, 1.0, 1.0}, {}, 10.0, 10.0};
  const std::vector<char> inner = {0, 1, 1, 0};
  EXPECT_NEAR(gap_for_coordination(row, 0.5, inner), 0.15, 1e-12);
  EXPECT_NEAR(gap_for_coordination(row, 1.5, inner), 0.25, 1e-12);
  const Bonds all = bonds_within_gap(row, 0.35);
  EXPECT_DOUBLE_EQ(coordination(all, inner), 2.0);
  EXPECT_DOUBLE_EQ(coordination(all, row.size()), 1.5);
  EXPECT_THROW(gap_for_coordination(row, 1.0, std::vector<char>{1, 1}), std::invalid_argument);
  EXPECT_THROW(coordination(all, std::vector<char>{0, 0, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace ddem
