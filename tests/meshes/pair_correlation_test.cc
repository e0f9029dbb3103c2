// Pair correlations that are known: of points, of lattices; and what is published of jammed discs.

#include "meshes/packings/pair_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "dem/assembly/contacts.h"
#include "meshes/packings/hexagonal.h"
#include "meshes/packings/random.h"
#include "meshes/packings/rng.h"

namespace ddem::packings {
namespace {

/// Centres anywhere, whatever overlaps.
Packing points(int discs, double length, double width, bool periodic) {
  Rng rng(5);
  Packing p{{}, {}, {}, {periodic ? length : 0.0, periodic ? width : 0.0}, length, width};
  for (int i = 0; i < discs; ++i) {
    p.x.push_back(length * rng.uniform());
    p.y.push_back(width * rng.uniform());
    p.radius.push_back(0.5 + rng.uniform());
  }
  return p;
}

// 4000 points have 2e4 pairs in a bin, or more, and 0.7 % of scatter; four of them in the worst of 20 bins.
TEST(PairCorrelation, OfPointsIsOne) {
  for (const bool periodic : {true, false}) {
    const PairCorrelation c = pair_correlation(points(4000, 90.0, 60.0, periodic), 6.0, 20);
    ASSERT_EQ(c.g.size(), 20u);
    EXPECT_NEAR(c.width, 0.3, 1e-12);
    for (std::size_t k = 3; k < c.g.size(); ++k) EXPECT_NEAR(c.g[k], 1.0, periodic ? 0.04 : 0.06) << k << (periodic ? " periodic" : "");
  }
}

// Shells of the hexagonal lattice at 1, sqrt(3), 2, sqrt(7) with 6, 6, 6, 12 discs; nothing between.
TEST(PairCorrelation, OfALatticeHasItsShells) {
  const Packing lattice = hexagonal({.columns = 12, .rows = 12, .radius = 1.0, .periodic_x = true, .periodic_y = true});
  const PairCorrelation c = pair_correlation(lattice, 2.9, 290);
  ASSERT_EQ(c.g.size(), 290u);
  const double others = static_cast<double>(lattice.size()) - 1.0, area = lattice.length * lattice.width;
  std::vector<double> neighbours(290, 0.0);
  for (std::size_t k = 0; k < 290; ++k) {
    const double inner = c.width * static_cast<double>(k), outer = inner + c.width;
    neighbours[k] = c.g[k] * others * 4.0 * std::numbers::pi * (outer * outer - inner * inner) / area;
  }
  const auto within = [&](double from, double to) {
    return std::accumulate(neighbours.begin() + std::lround(from / c.width), neighbours.begin() + std::lround(to / c.width), 0.0);
  };
  EXPECT_NEAR(within(0.0, 0.98), 0.0, 1e-12);
  EXPECT_NEAR(within(0.98, 1.02), 6.0, 1e-9);
  EXPECT_NEAR(within(1.02, 1.7), 0.0, 1e-12);
  EXPECT_NEAR(within(1.7, 1.76), 6.0, 1e-9);
  EXPECT_NEAR(within(1.97, 2.03), 6.0, 1e-9);
  EXPECT_NEAR(within(2.6, 2.7), 12.0, 1e-9);
  EXPECT_NEAR(within(0.0, 2.9), 30.0, 1e-9);
}

// A cell of 8 diameters is seen half as far; a strip narrower than what is asked for not at all.
TEST(PairCorrelation, SeesAsFarAsThereIsSomething) {
  const PairCorrelation c = pair_correlation(hexagonal({.columns = 8, .rows = 10, .radius = 1.0, .periodic_x = true, .periodic_y = true}), 10.0, 10);
  EXPECT_NEAR(10.0 * c.width, 0.999 * 0.5 * 8.0, 1e-9);
  EXPECT_TRUE(pair_correlation(Packing{{1.0, 3.0}, {1.0, 1.0}, {1.0, 1.0}, {}, 4.0, 2.0}, 3.0, 10).g.empty());
  EXPECT_THROW(pair_correlation(points(9, 5.0, 5.0, true), 0.0, 10), std::invalid_argument);
  EXPECT_THROW(pair_correlation(points(9, 5.0, 5.0, true), 2.0, 0), std::invalid_argument);
}

// Jammed discs nearly touch others: of those beyond the contacts, the number within a gap h of the sum of radii grows as
// h^(1 - 0.413) (Charbonneau, Corwin, Parisi and Zamponi, Phys. Rev. Lett. 109, 205501, 2012; in all dimensions, two among them).
// g itself has its peak at 1, where points have none, and forgets after a few diameters.
TEST(PairCorrelation, OfJammedDiscsHasThePublishedNearContacts) {
  constexpr double kFrom = 3e-3, kTo = 0.1;
  double within_small = 0.0, within_large = 0.0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const Packing p = random_jammed({.length = 16.5e-3, .width = 2e-3, .discs = 682, .seed = seed});
    for (const ClosePair& c : close_pairs(p, 2.0 * kTo * mean_radius(p) * 1.3)) {
      const double h = c.gap / (p.radius[c.i] + p.radius[c.j]);
      within_small += h > 0.0 && h < kFrom ? 1.0 : 0.0;
      within_large += h > 0.0 && h < kTo ? 1.0 : 0.0;
    }
    const PairCorrelation g = pair_correlation(p, 3.5, 70);
    ASSERT_EQ(g.g.size(), 70u);
    EXPECT_GT(*std::max_element(g.g.begin(), g.g.end()), 5.0);
    const auto peak = std::max_element(g.g.begin(), g.g.end()) - g.g.begin();
    EXPECT_NEAR((static_cast<double>(peak) + 0.5) * g.width, 1.0, g.width);
    EXPECT_NEAR(std::accumulate(g.g.end() - 10, g.g.end(), 0.0) / 10.0, 1.0, 0.05);
  }
  EXPECT_NEAR(std::log(within_large / within_small) / std::log(kTo / kFrom), 1.0 - 0.413, 0.08);
}

}  // namespace
}  // namespace ddem::packings
