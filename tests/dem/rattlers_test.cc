#include "dem/assembly/rattlers.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>
#include <vector>

namespace ddem {
namespace {

Bonds network(const std::vector<std::pair<int, int>>& pairs) {
  Bonds bonds;
  for (const auto& [i, j] : pairs) {
    bonds.i.push_back(i);
    bonds.j.push_back(j);
  }
  return bonds;
}

using Discs = std::vector<int>;

// A triangle 1 2 3 with a tail 3-4-5, and disc 0 alone.
const Bonds kTriangleWithTail = network({{1, 2}, {1, 3}, {2, 3}, {3, 4}, {4, 5}});

TEST(Rattlers, ArePeeledFromTheEnds) {
  EXPECT_EQ(find_rattlers(6, kTriangleWithTail), (Discs{0, 4, 5}));
}

TEST(Rattlers, LeaveRingsAndTakeChains) {
  EXPECT_TRUE(find_rattlers(4, network({{0, 1}, {1, 2}, {2, 3}, {3, 0}})).empty());
  EXPECT_EQ(find_rattlers(4, network({{0, 1}, {1, 2}, {2, 3}})), (Discs{0, 1, 2, 3}));
  // Two rings joined by a chain: every disc of the chain has two bonds.
  EXPECT_TRUE(
      find_rattlers(7, network({{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 4}})).empty());
  EXPECT_EQ(find_rattlers(3, Bonds{}), (Discs{0, 1, 2}));
  EXPECT_TRUE(find_rattlers(0, Bonds{}).empty());
}

TEST(ConnectedComponents, AreListed) {
  const Bonds bonds = network({{5, 1}, {1, 3}, {0, 4}});
  const std::vector<Discs> expected = {{0, 4}, {1, 3, 5}, {2}};
  EXPECT_EQ(connected_components(6, bonds), expected);
}

TEST(ConnectedComponents, LeaveRattlersOut) {
  const auto rattlers = find_rattlers(6, kTriangleWithTail);
  const std::vector<Discs> expected = {{1, 2, 3}};
  EXPECT_EQ(connected_components(6, kTriangleWithTail, rattlers), expected);
  EXPECT_EQ(connected_components(6, kTriangleWithTail).size(), 2u);
  // Taking out a disc that holds two pieces together parts them.
  const std::vector<int> cut = {1};
  EXPECT_EQ(connected_components(3, network({{0, 1}, {1, 2}}), cut).size(), 2u);
}

TEST(Rattlers, RefuseDiscsThatDoNotExist) {
  EXPECT_THROW(find_rattlers(3, network({{0, 3}})), std::invalid_argument);
  EXPECT_THROW(find_rattlers(3, network({{-1, 2}})), std::invalid_argument);
  const std::vector<int> outside = {7};
  EXPECT_THROW(connected_components(3, network({{0, 1}}), outside), std::invalid_argument);
}

}  // namespace
}  // namespace ddem
