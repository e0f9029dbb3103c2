// Sizes of packings that come without one: those of their lattices, whatever the ends, and nearly those of their cells.
#include "dem/assembly/outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meshes/packings/random.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using packings::CloseRows;

Packing bare(Packing p) {
  p.length = p.width = 0.0;
  p.period = {};
  return p;
}

/// 24 spacings of ramp, or half the length, tell the rows from a continuum by exp(-pi n/2): 2e-11 at 32 columns.
TEST(Outline, IsTheLattices) {
  for (const CloseRows rows_along : {CloseRows::along_x, CloseRows::along_y}) {
    for (const int columns : {32, 40, 60, 121}) {
      for (const int rows : {2, 3, 4, 9}) {
        const Packing p = packings::hexagonal({.close_packed = rows_along, .columns = columns, .rows = rows, .radius = 1.3e-4});
        const Outline o = outline_of(bare(p), std::nullopt, std::nullopt);
        SCOPED_TRACE(std::to_string(columns) + " columns, rows " + std::to_string(rows));
        EXPECT_NEAR(o.length / p.length, 1.0, 1e-9);
        EXPECT_NEAR(o.width / p.width, 1.0, 1e-9);
        EXPECT_NEAR(enclosed_fraction(bare(p)).value(), std::numbers::pi / std::sqrt(12.0), 1e-12);
        // One that is given stays, and the other follows from the area.
        const Outline by_length = outline_of(bare(p), p.length, std::nullopt), by_width = outline_of(bare(p), std::nullopt, p.width);
        EXPECT_NEAR(by_length.width / p.width, 1.0, 1e-12);
        EXPECT_EQ(by_length.length, p.length);
        EXPECT_NEAR(by_width.length / p.length, 1.0, 1e-9);
        EXPECT_EQ(by_width.width, p.width);
      }
    }
  }
}

/// Trimmed, turned or torn ends do not matter.
TEST(Outline, DoesNotFeelTheEnds) {
  Packing p = bare(packings::hexagonal({.columns = 60, .rows = 9, .radius = 1e-4}));
  const double mass = static_cast<double>(p.size()), length = 60 * 2e-4;
  for (const std::size_t gone : {0u, 60u, 61u, 120u, 300u}) {
    p.x.erase(p.x.begin() + static_cast<std::ptrdiff_t>(gone));
    p.y.erase(p.y.begin() + static_cast<std::ptrdiff_t>(gone));
    p.radius.pop_back();
  }
  const Outline o = outline_of(p, std::nullopt, std::nullopt);
  EXPECT_NEAR(o.length / (length * static_cast<double>(p.size()) / mass), 1.0, 1e-9);
}

/// A bay of two missing discs is outside: the ball, a little larger than a disc, reaches its ground.
TEST(Outline, GoesIntoBays) {
  Packing p = bare(packings::hexagonal({.columns = 40, .rows = 6, .radius = 1e-4}));
  const double top = *std::max_element(p.y.begin(), p.y.end());
  for (std::size_t d = 0, gone = 0; gone < 2; ++d) {
    if (p.y[d] < top - 1e-9 || p.x[d] < 0.5 * 40 * 2e-4) continue;
    for (auto* all : {&p.x, &p.y, &p.radius}) all->erase(all->begin() + static_cast<std::ptrdiff_t>(d));
    --d, ++gone;
  }
  EXPECT_NEAR(enclosed_fraction(p).value(), std::numbers::pi / std::sqrt(12.0), 1e-12);
}

TEST(Outline, OfASingleRowIsItsExtent) {
  const Packing p = bare(packings::hexagonal({.columns = 60, .rows = 1, .radius = 1e-4}));
  const Outline o = outline_of(p, std::nullopt, std::nullopt);
  EXPECT_NEAR(o.length, 60 * 2e-4, 1e-15);
  EXPECT_NEAR(o.width, 2e-4, 1e-18);
  EXPECT_FALSE(enclosed_fraction(p));
  EXPECT_FALSE(density_along(p.y, p.radius, 2e-4));
}

/// Cut from a periodic cell, so that its size is known. Of jammed discs the density of large pieces hardly varies: 0.3 % in the
/// area, measured, where the extent of the discs is 17 % off.
TEST(Outline, IsNearlyThatOfACutCell) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const Packing p = packings::random_jammed({.length = 8e-3, .width = 1.6e-3, .discs = 300, .seed = seed});
    const Outline o = outline_of(bare(p), std::nullopt, std::nullopt);
    EXPECT_NEAR(o.length / p.length, 1.0, 0.005) << seed;
    EXPECT_NEAR(o.length * o.width / (p.length * p.width), 1.0, 0.006) << seed;
  }
}

}  // namespace
}  // namespace ddem
