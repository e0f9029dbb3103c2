// The verdict on spectra: a branch that is off, a wavenumber without a crest and a system that failed are found.

#include <gtest/gtest.h>

#include "harness/studies/dispersion/dispersion_figures.h"

namespace ddem::harness {
namespace {

DispersionPanel panel_with(double deviation, std::size_t crests) {
  DispersionBranch branch{"P", {0.0, 1.0, 2.0, 3.0}, {0.0, 10.0, 19.0, 26.0}, {}, 3};
  for (std::size_t n = 1; n <= crests; ++n) branch.ridge.push_back({branch.wavenumber[n], branch.exact[n] * (1.0 + (n == 2 ? deviation : 0.0)), 1.0});
  DispersionPanel panel{"DEM", "dem", "", {}, {}};
  panel.branches.push_back(branch);
  return panel;
}

TEST(DispersionVerdict, IsThatOfTheWorstCrest) {
  EXPECT_NEAR(panel_with(-0.009, 3).branches[0].worst_deviation(), 0.009, 1e-12);
  EXPECT_EQ(dispersion_verdict(panel_with(-0.009, 3)).state, reports::State::pass);
  EXPECT_EQ(dispersion_verdict(panel_with(-0.011, 3)).state, reports::State::fail);
}

TEST(DispersionVerdict, MissesWavenumbers) {
  EXPECT_EQ(dispersion_verdict(panel_with(0.0, 2)).state, reports::State::fail);
  EXPECT_NE(dispersion_verdict(panel_with(0.0, 0)).state, reports::State::pass);
}

TEST(DispersionVerdict, ReportsAFailure) {
  DispersionPanel panel = panel_with(0.0, 3);
  panel.failure = "no program";
  EXPECT_EQ(dispersion_verdict(panel).state, reports::State::error);
  EXPECT_TRUE(dispersion_figure({1.0, {panel}}).panels.empty());
}

}  // namespace
}  // namespace ddem::harness
