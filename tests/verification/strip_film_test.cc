// The filmed strip: what its frames and energies must be, whoever looks at them.

#include "harness/studies/waves/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/campaign/facets.h"

namespace ddem::harness {
namespace {

const StripFilm& film() {
  static const StripFilm f = [] {
    StripCampaign s;
    s.stiffness_ratios = {0.3};
    s.models = {Model::dem, Model::lagged_full, Model::implicit_full};
    return film_strip(s);
  }();
  return f;
}

const FilmedRun& run(Model model) {
  return *std::find_if(film().runs.begin(), film().runs.end(),
                       [&](const FilmedRun& r) { return r.model == model; });
}

/// Largest change of the step's invariant over its value at the start.
double energy_change(Model model) {
  const auto& energy = run(model).energy;
  double largest = 0.0;
  for (const auto& e : energy)
    largest = std::max(largest, std::abs(e.energies.invariant / energy.front().energies.invariant - 1.0));
  return largest;
}

TEST(StripFilm, KeepsTheEnergyWhereTheSchemeDoes) {
  ASSERT_EQ(film().failure, "");
  ASSERT_EQ(film().runs.size(), 3u);
  ASSERT_GE(run(Model::dem).energy.size(), 100u);
  // Round-off of some thousand steps.
  EXPECT_LT(energy_change(Model::dem), 1e-12);
  EXPECT_LT(energy_change(Model::implicit_full), 1e-12);
  // The lag is a viscosity of first order in the step, which a released column feels at once (theory section
  // 3).
  EXPECT_GT(energy_change(Model::lagged_full), 0.1);
}

TEST(StripFilm, StrainsFollowFromStressesByTheLawOfTheDisc) {
  const FilmedRun& implicit = run(Model::implicit_full);
  ASSERT_EQ(implicit.frames.size(), 24u);
  EXPECT_TRUE(run(Model::lagged_full).frames.empty());
  const StripCampaign s;
  double wrong = 0.0, largest = 0.0;
  for (const auto& frame : implicit.frames) {
    for (std::size_t i = 0; i < implicit.packing.size(); ++i) {
      const double expected =
          (frame.stress.xx[i] - s.particle_poisson_ratio * frame.stress.yy[i]) / s.particle_modulus;
      wrong = std::max(wrong, std::abs(frame.strain.xx[i] - expected));
      largest = std::max(largest, std::abs(expected));
    }
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(wrong,
            1e-2 * largest);  // a hundred times the tolerance of the strains, for motions as short as a disc
}

/// One clock stands above both strips: a frame is at the first step after its time, of some hundred.
TEST(StripFilm, FramesShowTheSameTime) {
  const auto& rigid = run(Model::dem).frames;
  const auto& deformable = run(Model::implicit_full).frames;
  ASSERT_EQ(rigid.size(), deformable.size());
  for (std::size_t k = 0; k < rigid.size(); ++k) EXPECT_NEAR(rigid[k].time, deformable[k].time, 5e-3 * rigid.back().time);
}

TEST(StripFilm, FigureHasAFieldOfZerosForTheStrainOfRigidDiscs) {
  const reports::Figure figure = film_figure(film());
  EXPECT_NO_THROW(reports::require_valid(figure));
  ASSERT_EQ(figure.panels.size(), 2u);
  const auto& rigid = std::get<reports::Strip>(figure.panels[0]);
  const auto& deformable = std::get<reports::Strip>(figure.panels[1]);
  ASSERT_EQ(rigid.fields.size(), 3u);
  const auto zero = [](double v) { return v == 0.0; };
  EXPECT_TRUE(std::all_of(rigid.fields[2].values.begin(), rigid.fields[2].values.end(), zero));
  EXPECT_FALSE(std::all_of(deformable.fields[2].values.begin(), deformable.fields[2].values.end(), zero));
  // The same colours mean the same in both.
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(rigid.fields[k].axis.limits->upper, deformable.fields[k].axis.limits->upper);
  EXPECT_EQ(rigid.probes.size(), 10u);
}

TEST(Facets, AreWhatTheNameOfACaseSays) {
  using Facets = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(facets_of("long-wave/random/lagged-full/kt0.30"),
            (Facets{{"check", "long-wave"}, {"packing", "random"}, {"scheme", "lagged-full"}}));
  EXPECT_EQ(
      facets_of("stability-map/hexagonal/implicit-normal-only-stress/kt0.30/nu0.30"),
      (Facets{
          {"check", "stability-map"}, {"packing", "hexagonal"}, {"scheme", "implicit-normal-only-stress"}}));
  EXPECT_EQ(facets_of("fem/bar/dem/kt0.00"), (Facets{{"check", "fem"}, {"scheme", "dem"}}));
  EXPECT_EQ(facets_of("schemes/energy"), (Facets{{"check", "schemes"}}));
  EXPECT_EQ(facets_of(""), Facets{});
}

}  // namespace
}  // namespace ddem::harness
