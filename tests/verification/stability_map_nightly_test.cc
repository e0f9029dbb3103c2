// The study of stability over all of its grid.

#include <gtest/gtest.h>

#include "harness/studies/stability/stability_figures.h"

namespace ddem::harness {
namespace {

class FullStabilityMap : public testing::TestWithParam<StabilityKey> {};
INSTANTIATE_TEST_SUITE_P(Grid, FullStabilityMap, testing::ValuesIn(stability_grid(true).maps), [](const auto& p) {
  std::string id = slug(p.param);
  for (char& c : id) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return id;
});

TEST_P(FullStabilityMap, PredictionAndMeasurementAgree) {
  const StabilityMap map = map_stability(StripCampaign{}, stability_grid(true), GetParam());
  EXPECT_EQ(stability_map_verdict(map).state, reports::State::pass) << map.failure << " " << map.worst_disagreement() << " " << map.wrong_sides();
}

}  // namespace
}  // namespace ddem::harness
