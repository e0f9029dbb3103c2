// The strip out of smaller discs: fits on made-up data, the lattice's closed form, and packings.

#include "harness/studies/sizes/sizes_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "dem/statics/moduli.h"
#include "harness/studies/sizes/sizes_figures.h"
#include "harness/model/assemble.h"
#include "harness/run/scene_moduli.h"
#include "tests/support/assemblies.h"

namespace ddem::harness {
namespace {

TEST(PowerLaw, FindsWhatWasPutIn) {
  std::vector<SizeMean> means;
  for (const double x : {0.06, 0.03, 0.015}) means.push_back({x, {-0.8 * std::pow(x, 1.2), 0.0}, 6});
  EXPECT_NEAR(power_law(means).power, 1.2, 1e-12);
  EXPECT_NEAR(power_law(means).slope, -0.8, 1e-12);
  means[1].value.value = 0.001;  // no softening: there is no power
  EXPECT_TRUE(std::isnan(power_law(means).power));
}

/// Uniform tension is exact in the very strip; grips reach to the sections of 60 columns with less than 1e-6.
TEST(HexagonalWidthBias, IsThatOfThePulledStrip) {
  constexpr double kRadius = 1e-4;
  for (const int rows : {6, 10}) {
    const auto strip = [&](bool periodic) {
      return test::hexagonal_assembly({.columns = 60, .rows = rows, .radius = kRadius, .periodic_y = periodic}, 1.0);
    };
    for (const double ratio : {0.0, 0.25, 1.0}) {
      ContactParameters contact;
      contact.normal_stiffness = 1e10;
      contact.stiffness_ratio = ratio;
      const ddem::Assembly free = strip(false), closed = strip(true);
      const double bulk = directional_speeds(homogenise_strip(closed, contact, {}, 1.2 * kRadius), bulk_density(closed)).bar;
      const double bias = pull_strip(free, contact, {}, 1.2 * kRadius).bar_velocity() / bulk - 1.0;
      EXPECT_NEAR(bias, hexagonal_width_bias(ratio, rows), 2e-6) << rows << " rows, " << ratio;
    }
  }
  EXPECT_EQ(hexagonal_width_bias(0.0, 4), 0.0);
}

SizedStrip made_up(std::int64_t refinement, std::int64_t seed, double bias, double shear) {
  SizedStrip s{.packing = StripPacking::random, .refinement = refinement, .seed = seed};
  s.radius_over_width = 0.06 / static_cast<double>(refinement);
  s.bias = {{1000.0 * (1.0 + bias), 1000.0}};
  s.shear = {{.centroid = 500.0 * (1.0 + shear)}, 500.0, {}};
  return s;
}

TEST(SizeStudy, MeansAreOverTheStripsThatWereMeasured) {
  SizeStudy study;
  study.stiffness_ratios = {0.25};
  study.strips = {made_up(2, 1, -0.02, 0.001), made_up(1, 1, -0.05, 0.002), made_up(1, 2, -0.03, 0.004), made_up(1, 3, 9.0, 9.0)};
  study.strips.back().failure = "no equilibrium";
  const auto bias = study.mean_bias(StripPacking::random, 0);
  ASSERT_EQ(bias.size(), 2u);
  EXPECT_EQ(bias[0].strips, 2u);
  EXPECT_EQ(bias[0].radius_over_width, 0.06);
  EXPECT_NEAR(bias[0].value.value, -0.04, 1e-12);
  EXPECT_NEAR(bias[0].value.stddev, 0.01 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(bias[1].value.value, -0.02, 1e-12);
  EXPECT_NEAR(study.mean_error(StripPacking::random, StripWave::shear)[0].value.value, 0.003, 1e-12);
  EXPECT_TRUE(study.mean_bias(StripPacking::hexagonal, 0).empty());
  EXPECT_EQ(size_table(study).rows.size(), 2u);
  EXPECT_NO_THROW(reports::require_valid(size_figure(study)));
}

/// Of the bar, what S0 makes of it is taken out; without a pick there is no error, not a number.
TEST(SizeStudy, ErrorOfAWave) {
  SizedWave w{{.centroid = 990.0}, 1000.0, {.centroid = 0.99}};
  EXPECT_NEAR(w.error(), 0.0, 1e-12);
  w.s0 = {};
  EXPECT_NEAR(w.error(), -0.01, 1e-12);
  w.measured = {};
  EXPECT_TRUE(std::isnan(w.error()));
}

/// One strip of each kind with 682 discs, and one of cells: radii halve, the bias of one packing is that of its size within
/// three standard deviations (0.7 % at 682 discs), waves within three times 0.7 %.
TEST(SizeStudy, MeasuresItsStrips) {
  StripCampaign s;
  s.seeds = {1, 2};
  SizeStudy study = plan_sizes(s);
  std::size_t random = 0;
  for (std::size_t k = 0; k < study.strips.size(); ++k) {
    SizedStrip& strip = study.strips[k];
    if (strip.refinement == 2 || strip.seed == 2) continue;  // jamming takes seconds
    measure_strip(s, study, k);
    EXPECT_EQ(strip.failure, "");
    ASSERT_EQ(strip.bias.size(), 2u);
    const double n = static_cast<double>(strip.refinement);
    EXPECT_NEAR(strip.radius_over_width, 0.057 / n, 0.001);
    if (strip.packing == StripPacking::hexagonal) {
      EXPECT_NEAR(strip.bias[1].value(), hexagonal_width_bias(0.25, 10.0 * n), 1e-5);
      EXPECT_NEAR(strip.shear.error(), 0.0, 2e-4);
      continue;
    }
    ++random;
    EXPECT_EQ(strip.discs, 682 * strip.refinement * strip.refinement);
    EXPECT_EQ(strip.cells, strip.refinement == 4 ? 16 : 1);
    EXPECT_NEAR(strip.bias[1].value(), -0.042 / n, 0.02 / n);
    for (const StripWave wave : {StripWave::shear, StripWave::p}) EXPECT_NEAR(strip.wave(wave).error(), 0.0, 0.02);
    EXPECT_NEAR(strip.bar.error(), 0.0, 0.04);
  }
  EXPECT_EQ(random, 2u);
}

/// Strips beyond 20000 discs are left out, and cells stay at least half as long as wide.
TEST(SizeStudy, PlansWhatCanBeDone) {
  StripCampaign s;
  const auto count = [&](std::int64_t refinement) {
    const SizeStudy plan = plan_sizes(s);
    return std::count_if(plan.strips.begin(), plan.strips.end(), [&](const SizedStrip& strip) { return strip.refinement == refinement; });
  };
  EXPECT_EQ(count(1), 7);  // six seeds and the lattice
  EXPECT_EQ(count(2), 7);
  EXPECT_EQ(count(4), 4);
  s.length = 4e-3;
  EXPECT_EQ(plan_sizes(s).strips[1].refinement, 4);
  EXPECT_EQ(plan_sizes(s).strips[1].cells, 4);
  s.discs = 5000;
  EXPECT_EQ(count(4), 0);
  EXPECT_EQ(count(2), 7);
  s.discs = 30000;
  EXPECT_TRUE(plan_sizes(s).strips.empty());
}

TEST(SizeStudy, SaysWhyAStripFailed) {
  StripCampaign s;
  s.discs = 4;
  s.seeds = {1, 2};
  SizeStudy study = plan_sizes(s);
  const std::size_t last = study.strips.size() - 1;
  ASSERT_EQ(study.strips[last].refinement, 1);
  measure_strip(s, study, last);
  EXPECT_NE(study.strips[last].failure, "");
}

/// What the free edges make of Poisson's ratio in sparse packings (bonded up to 0.3 mean radii): 0.45 reads 0.10 at k_t = 0,
/// 0.264 reads 0.13 at k_t/k_n = 0.25, as another program found with other packings of the same kind. Scatter of a packing
/// 0.11 and 0.04: three standard deviations of the difference of two means of six are 0.19 and 0.07; of the bulk's, whose
/// scatter is 0.011 and 0.003, 0.02 and 0.006.
TEST(PaperBias, OfSparseStripsIsThatOfAnotherProgram) {
  const StripCampaign s;
  struct Expected {
    double ratio, bulk, bulk_tolerance, strip, strip_tolerance;
  };
  for (const Expected& e : {Expected{0.0, 0.452, 0.02, 0.10, 0.19}, Expected{0.25, 0.264, 0.006, 0.13, 0.07}}) {
    double bulk = 0.0, strip = 0.0;
    for (std::int64_t seed = 1; seed <= 6; ++seed) {
      Scene scene = scene_of(assembly_text(s, {StripPacking::random, seed, Model::dem, e.ratio, Protocol::paper, StripWave::bar}, false), "sparse");
      scene.assembly.bonding = BondGap{0.3};
      const SceneModuli m = scene_moduli(scene);
      const DirectionalSpeeds speeds = m.speeds().value();
      bulk += m.isotropic()->poisson() / 6.0;
      strip += (0.5 * std::pow(speeds.bar / speeds.s, 2) - 1.0) / 6.0;
    }
    EXPECT_NEAR(bulk, e.bulk, e.bulk_tolerance) << e.ratio;
    EXPECT_NEAR(strip, e.strip, e.strip_tolerance) << e.ratio;
    EXPECT_LT(strip, bulk - 0.08) << e.ratio;
  }
}

}  // namespace
}  // namespace ddem::harness
