// Discs in several chunks against the same discs in one.

#include "meshes/packings/soft_discs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "meshes/packings/rng.h"
#include "meshes/packings/tile.h"
#include "tests/support/one_core.h"

namespace ddem::packings {
namespace {

/// Discs anywhere, packed so densely that all move; two chunks of them, each with a thread of its own where there are two cores.
TEST(SoftDiscs, SameBitsOnOneCore) {
  const auto relaxed = [] {
    Packing p{{}, {}, {}, {0.4, 0.1}, 0.4, 0.1};
    Rng rng(3);
    for (int i = 0; i < 20100; ++i) p.radius.push_back(6e-4), p.x.push_back(0.4 * rng.uniform()), p.y.push_back(0.1 * rng.uniform());
    std::sort(p.x.begin(), p.x.end());
    SoftDiscs discs(p, {});
    discs.minimise({0.0, 0.0, 60});
    return discs.packing();
  };
  const Packing many = relaxed();
  const test::OneCore core;
  const Packing one = relaxed();
  EXPECT_EQ(one.x, many.x);
  EXPECT_EQ(one.y, many.y);
}

// Forces within chunks and across them are those of discs in one chunk: they add up to nothing, and each is as its pairs are.
TEST(SoftDiscs, ForcesDoNotDependOnChunks) {
  Packing few{{}, {}, {}, {0.1, 0.1}, 0.1, 0.1};
  Rng rng(9);
  for (int i = 0; i < 5025; ++i) few.radius.push_back(6e-4 + 2e-4 * rng.uniform()), few.x.push_back(0.1 * rng.uniform()), few.y.push_back(0.1 * rng.uniform());
  std::sort(few.x.begin(), few.x.end());
  // Four copies side by side are the same discs in a cell four times as long, and in two chunks.
  SoftDiscs alone(few, {}), together(tile(few, 4, 1), {});
  const SoftDiscs::Goal goal{0.0, 0.0, 1};
  const SoftDiscs::State a = alone.minimise(goal), b = together.minimise(goal);
  EXPECT_EQ(b.contacts, 4 * a.contacts);
  EXPECT_NEAR(b.mean_overlap, a.mean_overlap, 1e-12 * a.mean_overlap);
  EXPECT_NEAR(b.largest_overlap, a.largest_overlap, 1e-12 * a.largest_overlap);
  EXPECT_NEAR(b.unbalanced_force, a.unbalanced_force, 1e-9 * a.unbalanced_force);
  ASSERT_EQ(together.packing().size(), 20100u);
  for (std::size_t i = 0; i < 20100; ++i) ASSERT_NEAR(together.packing().y[i], alone.packing().y[i % 5025], 1e-14) << i;
}

}  // namespace
}  // namespace ddem::packings
