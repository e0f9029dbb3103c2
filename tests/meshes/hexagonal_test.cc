// The hexagonal lattice against the one that LAMMPS and Yade were run on (tests/oracles/hex_strip), and its
// geometry.

#include "meshes/packings/hexagonal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dem/assembly/contacts.h"
#include "tests/support/oracle_files.h"

namespace ddem::packings {
namespace {

// Coordinates are sums of a few rounded terms: some units in the last place of 16.5 mm, 2e-18 m each.
constexpr double kRounding = 2e-17;

std::vector<std::pair<int, int>> pairs_of(const Bonds& bonds) {
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t b = 0; b < bonds.size(); ++b) pairs.emplace_back(bonds.i[b], bonds.j[b]);
  return pairs;
}

double disc_area(const Packing& packing) {
  double area = 0.0;
  for (const double r : packing.radius) area += std::numbers::pi * r * r;
  return area;
}

/// The message of what hexagonal(spec) throws.
std::string refusal(const HexagonalSpec& spec) {
  try {
    hexagonal(spec);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

void expect_oracle(const Packing& packing) {
  const Packing oracle = test::oracle_packing("hex_strip/discs.csv", {}, 0.0, 0.0);
  ASSERT_EQ(packing.size(), oracle.size());
  for (std::size_t i = 0; i < oracle.size(); ++i) {
    EXPECT_NEAR(packing.x[i], oracle.x[i], kRounding) << i;
    EXPECT_NEAR(packing.y[i], oracle.y[i], kRounding) << i;
    EXPECT_NEAR(packing.radius[i], oracle.radius[i], kRounding) << i;
  }
}

TEST(Hexagonal, IsTheStripOfTheOracles) {
  expect_oracle(hexagonal({.columns = 62, .rows = 11, .radius = 0.132e-3}));
}

TEST(Hexagonal, FindsTheStripOfTheOraclesFromItsSize) {
  expect_oracle(hexagonal({.length = 16.5e-3, .width = 2e-3, .discs = 682}));
}

TEST(Hexagonal, TouchesAsInTheOracle) {
  const Packing packing = hexagonal({.columns = 62, .rows = 11, .radius = 0.132e-3});
  std::vector<std::pair<int, int>> expected;
  for (const test::Row& row : test::oracle_rows("hex_strip/bonds.csv")) {
    const int i = std::stoi(row[0]), j = std::stoi(row[1]);
    expected.emplace_back(std::min(i, j), std::max(i, j));
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(pairs_of(bonds_within_gap(packing, 1e-9)), expected);
  EXPECT_EQ(pairs_of(bonds_between(packing, expected)), expected);
}

class Orientation : public testing::TestWithParam<CloseRows> {};

// Every disc of the infinite lattice has six neighbours at 2r, in three directions 60 degrees apart; next are
// those at 2 sqrt(3) r. The discs fill pi/(2 sqrt 3) of the nominal area.
TEST_P(Orientation, ClosesOnItsPeriods) {
  const double r = 0.3;
  const Packing packing = hexagonal({.close_packed = GetParam(),
                                     .columns = 8,
                                     .rows = 6,
                                     .radius = r,
                                     .periodic_x = true,
                                     .periodic_y = true});
  const Bonds bonds = bonds_within_gap(packing, 0.01 * r);
  std::vector<int> count(packing.size(), 0);
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    ++count[bonds.i[b]];
    ++count[bonds.j[b]];
    EXPECT_NEAR(bonds.length[b], 2.0 * r, 1e-14);
    // cos(6 angle): 1 where a line of discs lies along x, -1 where one lies along y
    const double angle = std::atan2(bonds.ny[b], bonds.nx[b]);
    EXPECT_NEAR(std::cos(6.0 * angle), GetParam() == CloseRows::along_x ? 1.0 : -1.0, 1e-12);
  }
  EXPECT_EQ(count, std::vector<int>(packing.size(), 6));
  EXPECT_NEAR(disc_area(packing) / (packing.length * packing.width),
              std::numbers::pi / (2.0 * std::numbers::sqrt3), 1e-14);
  EXPECT_EQ(packing.period.x, packing.length);
  EXPECT_EQ(packing.period.y, packing.width);
  // The second shell is not reached a little below its gap.
  const double second = (2.0 * std::numbers::sqrt3 - 2.0) * r;
  const Packing large = hexagonal({.close_packed = GetParam(),
                                   .columns = 20,
                                   .rows = 20,
                                   .radius = r,
                                   .periodic_x = true,
                                   .periodic_y = true});
  EXPECT_DOUBLE_EQ(coordination(bonds_within_gap(large, second - 1e-9), large.size()), 6.0);
  EXPECT_DOUBLE_EQ(coordination(bonds_within_gap(large, second + 1e-9), large.size()), 12.0);
}

TEST_P(Orientation, ColumnsCountAlongX) {
  const Packing packing = hexagonal({.close_packed = GetParam(), .columns = 9, .rows = 4, .radius = 1.0});
  ASSERT_EQ(packing.size(), 36u);
  EXPECT_EQ(packing.period.x, 0.0);
  EXPECT_EQ(packing.period.y, 0.0);
  // (row 2, column 4) is two lines and four places from the corner: both even, hence not shifted.
  const double along = 2.0, across = std::numbers::sqrt3;
  const bool x_lines = GetParam() == CloseRows::along_x;
  EXPECT_NEAR(packing.x[2 * 9 + 4], 1.0 + 4 * (x_lines ? along : across), 1e-14);
  EXPECT_NEAR(packing.y[2 * 9 + 4], 1.0 + 2 * (x_lines ? across : along), 1e-14);
  EXPECT_GT(packing.length, packing.width);
}

TEST_P(Orientation, FitsTheLengthOfItsBox) {
  const Packing packing =
      hexagonal({.close_packed = GetParam(), .length = 16.5e-3, .width = 2e-3, .discs = 2720});
  const double r = packing.radius[0];
  const auto [left, right] = std::minmax_element(packing.x.begin(), packing.x.end());
  const auto [bottom, top] = std::minmax_element(packing.y.begin(), packing.y.end());
  EXPECT_NEAR(*right - *left + 2.0 * r, 16.5e-3, kRounding);
  EXPECT_NEAR((*top - *bottom + 2.0 * r) / 2e-3, 1.0, 0.3);
}

TEST_P(Orientation, NeedsAnEvenNumberOfShiftedLines) {
  const bool x_lines = GetParam() == CloseRows::along_x;
  HexagonalSpec spec{
      .close_packed = GetParam(), .columns = x_lines ? 62 : 11, .rows = x_lines ? 11 : 62, .radius = 1e-4};
  EXPECT_EQ(hexagonal(spec).size(), 682u);
  (x_lines ? spec.periodic_y : spec.periodic_x) = true;
  const std::string message = refusal(spec);
  EXPECT_NE(message.find(x_lines ? "rows must be even" : "columns must be even"), std::string::npos)
      << message;
  EXPECT_NE(message.find("take 10 or 12"), std::string::npos) << message;
  // Along the lines any number closes.
  (x_lines ? spec.periodic_y : spec.periodic_x) = false;
  (x_lines ? spec.periodic_x : spec.periodic_y) = true;
  EXPECT_EQ(hexagonal(spec).size(), 682u);
}

INSTANTIATE_TEST_SUITE_P(Both, Orientation, testing::Values(CloseRows::along_x, CloseRows::along_y),
                         [](const auto& run) {
                           return run.param == CloseRows::along_x ? "along_x" : "along_y";
                         });

TEST(Hexagonal, RefusesWithARemedy) {
  EXPECT_NE(refusal({.length = 16.5e-3, .width = 2e-3, .discs = 683})
                .find("682 discs would do (62 columns x 11 rows)"),
            std::string::npos);
  EXPECT_NE(refusal({.length = 16.5e-3, .width = 2e-3, .discs = 682, .periodic_y = true})
                .find("680 discs would do (68 columns x 10 rows)"),
            std::string::npos);
  EXPECT_NE(refusal({.columns = 62, .rows = 11}).find("needs columns, rows and radius"), std::string::npos);
  EXPECT_NE(refusal({.columns = 62, .rows = 11, .radius = 1e-4, .length = 1.0}).find("or else"),
            std::string::npos);
  EXPECT_NE(refusal({.columns = -3, .rows = 11, .radius = 1e-4}).find("columns must be positive"),
            std::string::npos);
  EXPECT_NE(refusal({.columns = 3, .rows = 11, .radius = NAN}).find("radius must be positive"),
            std::string::npos);
  EXPECT_NE(refusal({.columns = 100000, .rows = 100000, .radius = 1e-4}).find("more than"),
            std::string::npos);
  EXPECT_NE(refusal({}).find("needs"), std::string::npos);
}

}  // namespace
}  // namespace ddem::packings
