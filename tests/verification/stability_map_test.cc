// The study of stability: prediction and measurement agree, and it finds a solver that is given something else.

#include <gtest/gtest.h>

#include "harness/studies/stability/stability_figures.h"

namespace ddem::harness {
namespace {

/// Points that are quick: a hard and a soft disc, a small and a large step.
StabilityGrid few_points() {
  StabilityGrid g = stability_grid(false);
  g.softness = g.random_softness = {0.1, 0.5, 2.0};
  g.step_fraction = g.random_step_fraction = {0.2, 0.9, 1.1};
  return g;
}

TEST(StabilityMaps, PredictionAndMeasurementAgree) {
  const StabilityGrid grid = few_points();
  for (const StabilityKey& key : grid.maps) {
    const StabilityMap map = map_stability(StripCampaign{}, grid, key);
    const reports::Verdict v = stability_map_verdict(map);
    EXPECT_EQ(v.state, reports::State::pass) << slug(key) << " " << map.failure << " " << map.worst_disagreement() << " " << map.wrong_sides();
    EXPECT_EQ(map.points.size(), map.softness.size() * map.step_fraction.size());
  }
}

TEST(StabilityMaps, AWrongStepIsFound) {
  // 3 % more: what is 1 % below its limit goes beyond it, and all damping is 6 % stronger.
  StabilityGrid grid = few_points();
  grid.step_fraction = {0.5, 0.99};
  grid.softness = {0.1, 0.3};
  grid.disturb = [](SimulationInput& in) { in.time_step *= 1.03; };
  for (const Scheme scheme : {Scheme::none, Scheme::lagged, Scheme::implicit}) {
    const StabilityMap map = map_stability(StripCampaign{}, grid, {StripPacking::hexagonal, scheme, Correction::full, 0.0, 0.3});
    EXPECT_EQ(stability_map_verdict(map).state, reports::State::fail) << slug(map.key);
  }
}

TEST(StabilityMaps, WrongStrainsAreFound) {
  StabilityGrid grid = few_points();
  grid.step_fraction = {0.2, 0.5};
  grid.softness = {0.1, 0.3};
  // Stiffer by 3 %, discs strain by as much less, and so do their waves decay.
  grid.disturb = [](SimulationInput& in) { in.deformation.young_modulus *= 1.03; };
  const StabilityMap map = map_stability(StripCampaign{}, grid, {StripPacking::hexagonal, Scheme::lagged, Correction::full, 0.0, 0.3});
  EXPECT_EQ(stability_map_verdict(map).state, reports::State::fail);
}

}  // namespace
}  // namespace ddem::harness
