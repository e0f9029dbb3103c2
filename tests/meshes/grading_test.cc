// Gradings against the distributions that they stand for, jammed packings of them, and packings of a given porosity.

#include "meshes/packings/grading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meshes/packings/porosity.h"
#include "meshes/packings/random.h"
#include "meshes/packings/statistics.h"

namespace ddem::packings {
namespace {

constexpr int kMany = 20000;
const SieveCurve kCurve{{0.1, 0.15, 0.2, 0.3}, {0.0, 0.5, 0.5, 1.0}};  // nothing between 0.15 and 0.2

double passing(const std::vector<double>& radii, double radius) {
  double below = 0.0, all = 0.0;
  for (const double r : radii) all += r * r, below += r < radius ? r * r : 0.0;
  return below / all;
}

TEST(Grading, LogNormalRadii) {
  for (const double ratio : {1.5, 4.0}) {
    const std::vector<double> radii = graded_radii({.law = Grading::Law::log_normal}, ratio, kMany);
    EXPECT_TRUE(std::ranges::is_sorted(radii));
    EXPECT_GE(radii.front(), 1.0);
    EXPECT_LE(radii.back(), ratio);
    EXPECT_NEAR(radii[kMany / 2] / std::sqrt(ratio), 1.0, 1e-4);
    double mean = 0.0, square = 0.0;
    for (const double r : radii) mean += std::log(r) / kMany, square += std::log(r) * std::log(r) / kMany;
    // Of a normal distribution cut off at two standard deviations: 1 - 4 phi(2) / (Phi(2) - Phi(-2)) of its variance.
    const double deviation = std::log(ratio) / 4.0, inside = std::erf(std::numbers::sqrt2), density = std::exp(-2.0) / std::sqrt(2.0 * std::numbers::pi);
    EXPECT_NEAR(mean, 0.5 * std::log(ratio), 1e-6);
    EXPECT_NEAR((square - mean * mean) / (deviation * deviation), 1.0 - 4.0 * density / inside, 1e-4);
  }
}

TEST(Grading, SievedRadiiHaveTheMassesOfTheCurve) {
  const std::vector<double> radii = graded_radii({Grading::Law::sieve, kCurve}, 1.67, kMany);
  EXPECT_TRUE(std::ranges::is_sorted(radii));
  EXPECT_NEAR(radii.back() / radii.front(), 3.0, 1e-3);
  for (const auto& [radius, share] : {std::pair(1.0, 0.0), {1.25, 0.25}, {1.5, 0.5}, {1.9, 0.5}, {2.5, 0.75}, {3.0, 1.0}})
    EXPECT_NEAR(passing(radii, radius), share, 2e-4) << radius;
  EXPECT_EQ(std::ranges::count_if(radii, [](double r) { return r > 1.5001 && r < 1.9999; }), 0);
}

TEST(Grading, RefusesCurvesThatAreNone) {
  for (const SieveCurve& wrong : {SieveCurve{}, SieveCurve{{1.0}, {0.0}}, SieveCurve{{1.0, 2.0}, {0.0, 0.9}}, SieveCurve{{1.0, 2.0}, {0.1, 1.0}},
                                  SieveCurve{{2.0, 1.0}, {0.0, 1.0}}, SieveCurve{{1.0, 2.0, 3.0}, {0.0, 0.6, 0.5}}, SieveCurve{{0.0, 2.0}, {0.0, 1.0}},
                                  SieveCurve{{1.0, NAN}, {0.0, 1.0}}, SieveCurve{{1.0, 2.0}, {0.0}}})
    EXPECT_THROW(graded_radii({Grading::Law::sieve, wrong}, 1.67, 10), std::invalid_argument);
  const RandomSpec wide{.length = 5e-3, .width = 4e-3, .discs = 300, .grading = {Grading::Law::sieve, {{1.0, 11.0}, {0.0, 1.0}}}};
  EXPECT_THROW(random_jammed(wide), std::invalid_argument);
}

TEST(Grading, EveryOneJams) {
  for (const Grading& grading : {Grading{.law = Grading::Law::log_normal}, Grading{Grading::Law::sieve, kCurve}}) {
    const RandomSpec spec{.length = 6e-3, .width = 5e-3, .discs = 350, .seed = 3, .grading = grading};
    const Packing packing = random_jammed(spec);
    const PackingStatistics s = statistics_of(packing);
    EXPECT_LE(s.largest_overlap, 1e-3);
    EXPECT_GT(s.porosity, 0.1);
    EXPECT_LT(s.porosity, 0.17);
    std::vector<double> radii = packing.radius;
    std::ranges::sort(radii);
    const std::vector<double> wanted = graded_radii(grading, spec.radius_ratio, spec.discs);
    for (std::size_t k = 0; k < radii.size(); ++k) EXPECT_NEAR(radii[k] / radii[0], wanted[k] / wanted[0], 1e-12 * wanted[k]);
    EXPECT_TRUE(can_be_jammed_from(packing, spec));
    EXPECT_FALSE(can_be_jammed_from(packing, {.length = 6e-3, .width = 5e-3, .discs = 350, .seed = 3}));
  }
}

TEST(Porosity, IsMetOrRefusedWithWhatCanBe) {
  const Packing jammed = random_jammed({.length = 6e-3, .width = 5e-3, .discs = 350});
  const double least = porosity_of(jammed);
  EXPECT_NEAR(least, 0.157, 3e-3);
  for (const double porosity : {0.1, least, 0.2, 0.4}) {
    const Packing scaled = with_porosity(jammed, porosity, false);
    EXPECT_NEAR(porosity_of(scaled), porosity, 1e-14);
    EXPECT_EQ(scaled.x, jammed.x);
    EXPECT_GT(statistics_of(scaled).largest_overlap, porosity < least ? 0.01 : -1e-9);
  }
  for (const double porosity : {0.01, 0.7, 1.0, std::nan("")}) EXPECT_THROW(with_porosity(jammed, porosity, false), PorosityOutOfReach);
  EXPECT_THROW(with_porosity(jammed, 0.1, true), PorosityOutOfReach);  // discs would reach beyond the walls
  EXPECT_NO_THROW(with_porosity(jammed, 0.2, true));
}

}  // namespace
}  // namespace ddem::packings
