// Random packings: jammed, dense, without voids, reproducible, and statistically those of an independent
// program (tests/oracles/packings: 682 discs, radii uniform with ratio 1.67, period 16.5 mm x 2 mm).

#include "meshes/packings/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "dem/assembly/contacts.h"
#include "dem/assembly/packing_check.h"
#include "dem/assembly/rattlers.h"
#include "meshes/packings/rng.h"
#include "meshes/packings/statistics.h"
#include "tests/support/oracle_files.h"

namespace ddem::packings {
namespace {

constexpr RandomSpec kStrip{.length = 16.5e-3, .width = 2e-3, .discs = 682};
constexpr int kSeeds = 4;

const Packing& strip(int seed) {
  static const auto packings = [] {
    std::array<Packing, kSeeds> all;
    for (int s = 0; s < kSeeds; ++s) {
      RandomSpec spec = kStrip;
      spec.seed = static_cast<std::uint64_t>(s + 1);
      all[s] = random_jammed(spec);
    }
    return all;
  }();
  return packings[seed - 1];
}

Packing oracle(int seed) {
  return test::oracle_packing("packings/p682_s" + std::to_string(seed) + ".csv", {16.5e-3, 2e-3}, 16.5e-3,
                              2e-3);
}

double porosity(const Packing& packing) {
  double area = 0.0;
  for (const double r : packing.radius) area += std::numbers::pi * r * r;
  return 1.0 - area / (packing.length * packing.width);
}

double coordination_at(const Packing& packing, double gap_in_mean_radii) {
  return coordination(bonds_within_gap(packing, gap_in_mean_radii * mean_radius(packing)), packing.size());
}

/// FNV-1a over the bits of all numbers.
std::uint64_t hash(const Packing& packing) {
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (const auto* values : {&packing.x, &packing.y, &packing.radius})
    for (const double value : *values)
      for (auto bits = std::bit_cast<std::uint64_t>(value); bits != 0; bits >>= 8)
        h = (h ^ (bits & 0xff)) * 0x100000001b3ULL;
  return h;
}

TEST(RandomJammed, FillsTheCellExactlyWithTheDiscsAskedFor) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Packing& packing = strip(seed);
    ASSERT_EQ(packing.size(), 682u);
    EXPECT_EQ(packing.period.x, 16.5e-3);
    EXPECT_EQ(packing.period.y, 2e-3);
    EXPECT_EQ(packing.length, 16.5e-3);
    EXPECT_EQ(packing.width, 2e-3);
    EXPECT_TRUE(std::is_sorted(packing.x.begin(), packing.x.end()));
    for (std::size_t i = 0; i < packing.size(); ++i) {
      EXPECT_TRUE(packing.x[i] >= 0.0 && packing.x[i] < 16.5e-3);
      EXPECT_TRUE(packing.y[i] >= 0.0 && packing.y[i] < 2e-3);
    }
    EXPECT_TRUE(packing_problems(packing).empty());
  }
}

TEST(RandomJammed, RadiiAreUniformWithTheRatioAskedFor) {
  std::vector<double> radius = strip(1).radius;
  std::sort(radius.begin(), radius.end());
  EXPECT_NEAR(radius.back() / radius.front(), 1.67, 1e-12);
  const double step = (radius.back() - radius.front()) / 681.0;
  for (std::size_t k = 0; k < radius.size(); ++k)
    EXPECT_NEAR(radius[k], radius.front() + step * static_cast<double>(k), 1e-12);
  // The oracles' radii are random draws: their mean over the range has the standard error 1/sqrt(12 * 682) =
  // 0.011 of it, so that the mean of six lies within 0.02 of the middle.
  double middle = 0.0;
  for (int seed = 1; seed <= 6; ++seed) {
    const Packing other = oracle(seed);
    const auto [low, high] = std::minmax_element(other.radius.begin(), other.radius.end());
    middle += (mean_radius(other) - *low) / (*high - *low) / 6.0;
  }
  EXPECT_NEAR(middle, 0.5, 0.02);
}

// Expected: porosity 0.15 +- 0.01, mean radius 0.113 mm, coordination 5.14 at gap tolerance 0.3.
TEST(RandomJammed, HasTheStatisticsOfTheOracles) {
  double oracle_porosity = 0.0;
  std::array<double, 3> oracle_coordination{};
  const std::array<double, 3> gaps = {0.1, 0.3, 0.8};
  for (int seed = 1; seed <= 6; ++seed) {
    oracle_porosity += porosity(oracle(seed)) / 6.0;
    for (std::size_t k = 0; k < gaps.size(); ++k)
      oracle_coordination[k] += coordination_at(oracle(seed), gaps[k]) / 6.0;
  }
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Packing& packing = strip(seed);
    EXPECT_NEAR(porosity(packing), 0.15, 0.01);
    EXPECT_NEAR(porosity(packing), oracle_porosity, 0.006);
    EXPECT_NEAR(mean_radius(packing), 0.113e-3, 0.001e-3);
    // Over seeds the coordination has the standard deviation 0.03 (the oracles' own): three of them.
    for (std::size_t k = 0; k < gaps.size(); ++k)
      EXPECT_NEAR(coordination_at(packing, gaps[k]), oracle_coordination[k], 0.1) << "gap " << gaps[k];
  }
}

TEST(RandomJammed, ReachesTheCoordinationOfDenseAssemblies) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Packing& packing = strip(seed);
    const double gap = gap_for_coordination(packing, 5.8);
    EXPECT_NEAR(coordination(bonds_within_gap(packing, gap), packing.size()), 5.8, 1.0 / 682.0);
    EXPECT_NEAR(gap / mean_radius(packing), 0.75, 0.1);
  }
}

// Force balance and overlap are computed here, from the packing alone. In two dimensions a rigid network of n
// discs without friction needs at least 2 n - 1 contacts (periodic cell, its shape held).
TEST(RandomJammed, IsMechanicallyStable) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Packing& packing = strip(seed);
    const std::vector<ClosePair> contacts = close_pairs(packing, 0.0);
    std::vector<double> fx(packing.size(), 0.0), fy(packing.size(), 0.0);
    std::vector<int> count(packing.size(), 0);
    double sum = 0.0, largest = 0.0, largest_net = 0.0;
    for (const ClosePair& c : contacts) {
      const double length = std::hypot(c.dx, c.dy);
      fx[c.i] += c.gap * c.dx / length;
      fy[c.i] += c.gap * c.dy / length;
      fx[c.j] -= c.gap * c.dx / length;
      fy[c.j] -= c.gap * c.dy / length;
      ++count[c.i];
      ++count[c.j];
      sum -= c.gap;
      largest = std::max(largest, -c.gap);
    }
    for (std::size_t i = 0; i < packing.size(); ++i)
      largest_net = std::max(largest_net, std::hypot(fx[i], fy[i]));
    EXPECT_LE(largest, 1e-3 * mean_radius(packing));
    EXPECT_LE(largest_net, 1.01e-4 * sum / static_cast<double>(contacts.size()));
    const auto held = std::count_if(count.begin(), count.end(), [](int c) { return c >= 3; });
    EXPECT_GE(static_cast<int>(contacts.size()), 2 * held - 1);
    EXPECT_GE(held, 0.9 * 682);
  }
}

// Above jamming, frictionless discs without rattlers touch 4 + 3.6 (phi - phi_J)^0.5 others, and phi_J is 0.84 (O'Hern, Silbert,
// Liu and Nagel, Phys. Rev. E 68, 011306, 2003). How far above it a packing is follows from its mean overlap o: affine growth
// of the radii r would need phi - phi_J = phi o/r, but other motion takes up a third of the overlaps, so that it is 1.5 phi o/r.
// The excess of one packing of 682 discs scatters by a fifth, of the mean of four by a tenth; an uncertainty of 0.5 in the
// prefactor and of 0.03 in the exponent is 0.4 of it. Isostatic discs have none; balanced to a tenth only, three times as much.
TEST(RandomJammed, HasTheContactsOfJammedDiscs) {
  double excess = 0.0, expected = 0.0, fabric2 = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const PackingStatistics s = statistics_of(strip(seed));
    double overlap = 0.0;
    const std::vector<ClosePair> contacts = close_pairs(strip(seed), 0.0);
    for (const ClosePair& c : contacts) overlap -= c.gap / (s.mean_radius * static_cast<double>(contacts.size()));
    excess += (2.0 * s.contacts / (682.0 - s.rattlers) - 4.0) / kSeeds;
    EXPECT_NEAR(s.held_coordination, 2.0 * s.contacts / (682.0 - s.rattlers), 0.02);  // rattlers touch hardly anybody
    fabric2 += s.fabric_anisotropy * s.fabric_anisotropy * s.contacts / kSeeds;
    expected += 3.6 * std::sqrt(1.5 * (1.0 - s.porosity) * overlap) / kSeeds;
    EXPECT_NEAR(1.0 - s.porosity, 0.844, 0.004);
    EXPECT_NEAR(s.rattlers / 682.0, 0.05, 0.03);
  }
  EXPECT_NEAR(excess / expected, 1.0, 0.5);
  EXPECT_LT(fabric2, 3.0);  // of directions at random 1; the period of 9 diameters may prefer one
}

// No voids: every disc is bonded at least three times at gap 0.3 but for a few in a hundred, no point of the
// cell is farther than a diameter of the largest disc from a disc's surface, and the network is one piece.
TEST(RandomJammed, HasNoVoids) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Packing& packing = strip(seed);
    const Bonds bonds = bonds_within_gap(packing, 0.3 * mean_radius(packing));
    std::vector<int> count(packing.size(), 0);
    for (std::size_t b = 0; b < bonds.size(); ++b) {
      ++count[bonds.i[b]];
      ++count[bonds.j[b]];
    }
    EXPECT_LE(std::count_if(count.begin(), count.end(), [](int c) { return c < 3; }), 0.02 * 682);
    EXPECT_EQ(connected_components(packing.size(), bonds, find_rattlers(packing.size(), bonds)).size(), 1u);

    double deepest = 0.0;
    for (double x = 0.0; x < packing.length; x += 0.05e-3)
      for (double y = 0.0; y < packing.width; y += 0.05e-3) {
        double nearest = packing.length;
        for (std::size_t i = 0; i < packing.size(); ++i) {
          const double dx = nearest_image(packing.x[i] - x, packing.period.x);
          const double dy = nearest_image(packing.y[i] - y, packing.period.y);
          nearest = std::min(nearest, std::sqrt(dx * dx + dy * dy) - packing.radius[i]);
        }
        deepest = std::max(deepest, nearest);
      }
    EXPECT_LT(deepest, mean_radius(packing));
  }
}

// Porosities (and through them the radii) of different seeds have nothing to do with each other: over 2 x 24 seeds the
// correlation of neighbouring ones has the standard error 1/sqrt(24) = 0.2; and no two packings share a disc.
TEST(RandomJammed, SeedsAreIndependent) {
  constexpr int n = 24;
  std::array<double, n + 1> p{};
  std::vector<std::vector<double>> places;
  double mean = 0.0;
  for (int k = 0; k <= n; ++k) {
    const Packing packing = random_jammed({.length = 4e-3, .width = 3e-3, .discs = 120, .seed = 100u + static_cast<unsigned>(k)});
    p[k] = porosity(packing);
    mean += p[k] / (n + 1);
    places.push_back(packing.x);
  }
  double variance = 0.0, covariance = 0.0;
  for (int k = 0; k < n; ++k) {
    variance += (p[k] - mean) * (p[k] - mean);
    covariance += (p[k] - mean) * (p[k + 1] - mean);
    std::vector<double> shared;
    std::set_intersection(places[k].begin(), places[k].end(), places[k + 1].begin(), places[k + 1].end(), std::back_inserter(shared));
    EXPECT_TRUE(shared.empty());
  }
  EXPECT_GT(std::sqrt(variance / n), 1e-4);
  EXPECT_LT(std::abs(covariance / variance), 3.0 / std::sqrt(n));
}

TEST(RandomJammed, IsReproducible) {
  EXPECT_EQ(hash(random_jammed(kStrip)), hash(strip(1)));
  EXPECT_NE(hash(strip(1)), hash(strip(2)));
}

// The same bits on every machine and compiler: integer random numbers, + - * / and square roots only. A change of the
// algorithm changes kJammingBits, and with it the names of cached packings.
TEST(RandomJammed, HasTheBitsOfOtherMachines) {
  const RandomSpec spec{.length = 5e-3, .width = 2e-3, .discs = 60, .seed = 7};
  EXPECT_EQ(hash(random_jammed(spec)), kJammingBits);
}

// Wide distributions jam denser, equal discs crystallise in part: both stay dense and within bounds.
TEST(RandomJammed, CopesWithEveryRadiusRatio) {
  for (const double ratio : {1.0, 3.0, 10.0}) {
    RandomSpec spec = kStrip;
    spec.radius_ratio = ratio;
    const Packing packing = random_jammed(spec);
    const PackingStatistics report = statistics_of(packing);
    const auto [low, high] = std::minmax_element(packing.radius.begin(), packing.radius.end());
    EXPECT_NEAR(*high / *low, ratio, 1e-12 * ratio);
    EXPECT_LE(report.largest_overlap, 1e-3);
    EXPECT_GT(report.porosity, 1.0 - std::numbers::pi / (2.0 * std::numbers::sqrt3));
    EXPECT_LT(report.porosity, 0.17);
    EXPECT_TRUE(packing_problems(packing).empty());
  }
}

TEST(RandomJammed, RefusesImpossibleSpecs) {
  const auto refused = [](auto change) {
    RandomSpec spec = kStrip;
    change(spec);
    EXPECT_THROW(random_jammed(spec), std::invalid_argument);
  };
  refused([](RandomSpec& s) { s.length = 0.0; });
  refused([](RandomSpec& s) { s.width = -1.0; });
  refused([](RandomSpec& s) { s.width = NAN; });
  refused([](RandomSpec& s) { s.length = INFINITY; });
  refused([](RandomSpec& s) { s.discs = 1; });
  refused([](RandomSpec& s) { s.discs = -5; });
  refused([](RandomSpec& s) { s.discs = 100; });  // so large that they touch across 2 mm twice
  refused([](RandomSpec& s) { s.discs = 2000000000; });
  refused([](RandomSpec& s) { s.radius_ratio = 0.9; });
  refused([](RandomSpec& s) { s.radius_ratio = 10.1; });
  refused([](RandomSpec& s) { s.radius_ratio = NAN; });
}

TEST(Rng, IsUniform) {
  Rng rng(1);
  double mean = 0.0, square = 0.0;
  constexpr int n = 100000;
  std::array<int, 7> counts{};
  for (int k = 0; k < n; ++k) {
    const double u = rng.uniform();
    ASSERT_TRUE(u >= 0.0 && u < 1.0);
    mean += u / n;
    square += u * u / n;
    ++counts[rng.below(7)];
  }
  // Five standard errors: sqrt(1/12/n), sqrt(4/45/n), sqrt(n 6/49).
  EXPECT_NEAR(mean, 0.5, 5 * std::sqrt(1.0 / 12.0 / n));
  EXPECT_NEAR(square, 1.0 / 3.0, 5 * std::sqrt(4.0 / 45.0 / n));
  for (const int count : counts) EXPECT_NEAR(count, n / 7.0, 5 * std::sqrt(n * 6.0 / 49.0));
}

/// A change of a packing that is not one of jamming.
struct Forgery {
  const char* name;
  void (*forge)(Packing&);
};
constexpr Forgery kForgeries[] = {
    {"smaller", [](Packing& p) { for (double& r : p.radius) r *= 0.97; }},
    {"hardly smaller", [](Packing& p) { for (double& r : p.radius) r *= 1.0 - 1e-3; }},
    {"larger", [](Packing& p) { for (double& r : p.radius) r *= 1.03; }},
    {"smaller as a whole", [](Packing& p) { for (auto* values : {&p.x, &p.y, &p.radius}) for (double& v : *values) v *= 0.9; }},
    {"no number", [](Packing& p) { p.x[5] = std::nan(""); }},
    {"no number in y", [](Packing& p) { p.y[5] = std::nan(""); }},
    {"no radius", [](Packing& p) { p.radius[5] = std::nan(""); }},
    {"infinite", [](Packing& p) { p.radius[5] = HUGE_VAL; }},
    {"all in one place", [](Packing& p) { std::ranges::fill(p.x, 1e-3), std::ranges::fill(p.y, 1e-3); }},
    {"far", [](Packing& p) { p.x.back() = 1e18; }},
    {"further", [](Packing& p) { p.y[3] = 1e300; }},
    {"beyond the edge", [](Packing& p) { p.y[3] = -1e-6; }},
    {"negative", [](Packing& p) { p.radius[3] = -1e-4; }},
    {"huge", [](Packing& p) { p.radius[3] = 1.0; }},
    {"two radii exchanged", [](Packing& p) { std::swap(p.radius[100], p.radius[101]); }},
    {"one radius", [](Packing& p) { p.radius[7] *= 1.0001; }},
    // The largest disc: a small one may touch no other.
    {"shifted", [](Packing& p) { p.y[static_cast<std::size_t>(std::ranges::max_element(p.radius) - p.radius.begin())] += 1e-3 * mean_radius(p); }},
    {"out of order", [](Packing& p) { std::ranges::reverse(p.x), std::ranges::reverse(p.y), std::ranges::reverse(p.radius); }},
    {"upside down", [](Packing& p) { for (double& y : p.y) y = p.width - y; }},
    {"moved along", [](Packing& p) { for (double& y : p.y) y = std::fmod(y + 0.5 * p.width, p.width); }},
    {"a disc less", [](Packing& p) { p.x.pop_back(), p.y.pop_back(), p.radius.pop_back(); }},
    {"a radius less", [](Packing& p) { p.radius.pop_back(); }},
    {"longer", [](Packing& p) { p.length *= 1.01; }},
    {"a wall", [](Packing& p) { p.period.y = 0.0; }},
};

TEST(RandomJammed, IsToldFromForgeries) {
  std::vector<std::pair<RandomSpec, Packing>> packings;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    RandomSpec spec = kStrip;
    spec.seed = static_cast<std::uint64_t>(seed);
    packings.emplace_back(spec, strip(seed));
  }
  for (const FlatWalls walls : {FlatWalls{false, true}, FlatWalls{true, true}}) {
    for (const double ratio : {1.0, 1.67, 5.0}) {
      const RandomSpec spec{.length = 6e-3, .width = 5e-3, .discs = 350, .seed = 3, .radius_ratio = ratio, .walls = walls};
      packings.emplace_back(spec, random_jammed(spec));
    }
  }
  for (const auto& [spec, packing] : packings) {
    EXPECT_TRUE(can_be_jammed_from(packing, spec)) << spec.seed << " " << spec.radius_ratio;
    for (const Forgery& f : kForgeries) {
      const std::string name = f.name;
      // Equal discs can be neither exchanged nor told apart.
      if (spec.radius_ratio == 1.0 && (name == "two radii exchanged" || name == "upside down")) continue;
      if (spec.walls.y && name == "a wall") continue;  // it has one
      Packing forged = packing;
      f.forge(forged);
      EXPECT_FALSE(can_be_jammed_from(forged, spec)) << name << ", ratio " << spec.radius_ratio;
    }
    RandomSpec other = spec;
    ++other.seed;
    if (spec.radius_ratio > 1.0) {
      EXPECT_FALSE(can_be_jammed_from(packing, other));
    }
    other = spec;
    other.walls.x = !other.walls.x;
    EXPECT_FALSE(can_be_jammed_from(packing, other));
  }
}

}  // namespace
}  // namespace ddem::packings
