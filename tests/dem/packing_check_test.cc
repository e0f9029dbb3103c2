#include "dem/assembly/packing_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/oracle_files.h"

namespace ddem {
namespace {

Packing three_in_a_row(double distance) {
  return {{0.0, distance, 2.0 * distance}, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {}, 6.0, 2.0};
}

bool mentions(const std::vector<std::string>& problems, const std::string& text) {
  for (const std::string& problem : problems)
    if (problem.find(text) != std::string::npos) return true;
  return false;
}

TEST(PackingProblems, AcceptsGoodPackings) {
  EXPECT_TRUE(packing_problems(three_in_a_row(2.0)).empty());
  EXPECT_TRUE(
      packing_problems(test::oracle_packing("packings/p682_s1.csv", {16.5e-3, 2e-3}, 16.5e-3, 2e-3)).empty());
}

// 5 % of the smaller radius is the limit, here 0.05 of radius 1.
TEST(PackingProblems, MeasuresOverlaps) {
  EXPECT_TRUE(packing_problems(three_in_a_row(1.951)).empty());
  const auto problems = packing_problems(three_in_a_row(1.949));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_TRUE(mentions(problems, "discs 0 and 1 overlap by 0.051 m, 5.1 %")) << problems[0];
  EXPECT_TRUE(mentions(problems, "discs 1 and 2")) << problems[1];

  Packing unequal{{0.0, 10.4}, {0.0, 0.0}, {10.0, 0.5}, {}, 21.0, 20.0};  // 0.1 of 10, but a fifth of 0.5
  EXPECT_TRUE(mentions(packing_problems(unequal), "20 %"));
}

TEST(PackingProblems, SeesOverlapsAcrossPeriods) {
  Packing packing{{0.2, 9.8}, {1.0, 1.0}, {1.0, 1.0}, {}, 10.0, 2.0};
  EXPECT_TRUE(packing_problems(packing).empty());
  packing.period.x = 10.0;
  EXPECT_TRUE(mentions(packing_problems(packing), "discs 0 and 1 overlap by 1.6 m"));
}

TEST(PackingProblems, ListsAllKinds) {
  Packing packing = three_in_a_row(2.0);
  packing.x[0] = NAN;
  packing.radius[1] = -1.0;
  packing.radius[2] = INFINITY;
  const auto problems = packing_problems(packing);
  EXPECT_EQ(problems.size(), 3u);
  EXPECT_TRUE(mentions(problems, "disc 0: its centre"));
  EXPECT_TRUE(mentions(problems, "disc 1: its radius must be positive"));
  EXPECT_TRUE(mentions(problems, "disc 2: its radius"));
}

TEST(PackingProblems, NeedsDiscsAndSaneCells) {
  EXPECT_TRUE(mentions(packing_problems(Packing{}), "at least two discs"));
  EXPECT_TRUE(mentions(packing_problems(Packing{{0.0}, {0.0}, {1.0}, {}, 2.0, 2.0}),
                       "at least two discs, but has 1"));
  EXPECT_TRUE(mentions(packing_problems(Packing{{0.0, 1.0}, {0.0}, {1.0}, {}, 2.0, 2.0}), "as many x as y"));
  Packing packing = three_in_a_row(2.0);
  packing.period.x = 3.9;
  EXPECT_TRUE(mentions(packing_problems(packing), "period in x"));
  packing.period.x = NAN;
  EXPECT_TRUE(mentions(packing_problems(packing), "period in x"));
}

// Everything in one place: the list stays short, and the search does not look at all n^2 pairs.
TEST(PackingProblems, StopsEarly) {
  const std::size_t n = 200000;
  Packing packing{
      std::vector<double>(n, 1.0), std::vector<double>(n, 1.0), std::vector<double>(n, 0.5), {}, 1.0, 1.0};
  const auto problems = packing_problems(packing);
  ASSERT_EQ(problems.size(), 11u);
  EXPECT_EQ(problems.back(), "... and more");
  packing.x.assign(n, NAN);
  EXPECT_EQ(packing_problems(packing).size(), 11u);
}

}  // namespace
}  // namespace ddem
