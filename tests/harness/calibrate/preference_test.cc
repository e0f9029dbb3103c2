// Where parameters outnumber targets: the stated preference, on the lattice, where the answers are known.
#include <cmath>
#include <numbers>

#include "tests/harness/calibrate/scenes.h"

namespace ddem::harness::test {
namespace {

StaticModel model_of(const Scene& scene) {
  return StaticModel(scene, seed_assemblies(scene, 0, 1, 1), 1);
}

double radius(const StaticModel& model, const ModelPoint& p) {
  return p.softness * model.radius_per_softness(p);
}

/// Above what rigid discs reach, k_t = 0 and the largest nu_p need the least softness: with 2K = (A/2)/(1 +
/// (6/pi)(1 - nu_p) s), 2G = (A/4)/(1 + (3/pi)(1 + nu_p) s) and K/G = (1 + nu)/(1 - nu) that softness solves
/// a linear equation.
TEST(Preference, StiffestDiscsOfAHighPoissonsRatio) {
  const double nu = 0.42, nu_p = 0.49, pi = std::numbers::pi;
  const double quotient = (1.0 + nu) / (1.0 - nu);
  const double softness = (quotient - 2.0) / (6.0 / pi * (1.0 + nu_p) - quotient * 6.0 / pi * (1.0 - nu_p));
  const SearchResult found = find_poisson(model_of(lattice_scene("implicit", "full")), {}, nu);
  ASSERT_TRUE(found.feasible());
  EXPECT_EQ(found.point.stiffness_ratio, 0.0);
  EXPECT_EQ(found.point.particle_poisson_ratio, 0.49);
  EXPECT_NEAR(found.point.softness, softness, 1e-9);
}

/// Within reach of rigid discs the stiffest ones are those of the smallest softness allowed; k_t/k_n and nu_p
/// then follow from the margin. On the lattice the radius is s max((6/pi)(1 - nu_p), (3/pi)(1 + nu_p)(1 +
/// lambda)): smallest where both are equal, or k_t = 0 and nu_p = 1/3.
TEST(Preference, LargestMarginAmongTheStiffest) {
  const StaticModel model = model_of(lattice_scene("implicit", "full"));
  const SearchResult found = find_poisson(model, held({}, 0.3, {}), 0.25);
  ASSERT_TRUE(found.feasible());
  const auto at = [&](double nu_p) { return find_poisson(model, held({}, 0.3, nu_p), 0.25); };
  double best = HUGE_VAL;
  for (int n = 0; n <= 49; ++n) {
    const SearchResult r = at(0.01 * n);
    if (r.feasible()) best = std::min(best, radius(model, r.point));
  }
  EXPECT_LT(radius(model, found.point),
            best * 1.01);  // a kink: sequential quadratic programming stops close to it
  EXPECT_GT(radius(model, at(0.0).point), best * 1.05);  // and there is something to win
}

/// With nu_p given, softness and k_t/k_n are free: the margin is largest for the stiffest discs.
TEST(Preference, MarginAndStiffnessAgreeForGivenDiscs) {
  SearchSpace space = held({}, {}, 0.3);
  space.preference = Preference::margin;
  const StaticModel model = model_of(lattice_scene("implicit", "full"));
  const SearchResult found = find_poisson(model, space, 0.2);
  ASSERT_TRUE(found.feasible());
  EXPECT_NEAR(found.point.softness, 0.01, 1e-4);
  EXPECT_EQ(found.point.particle_poisson_ratio, 0.3);
}

TEST(Preference, HoldsWhatIsGiven) {
  const StaticModel model = model_of(lattice_scene("implicit", "normal_only_stress"));
  const SearchResult by_nu_p = find_poisson(model, held(0.2, 0.5, {}), 0.2);
  ASSERT_TRUE(by_nu_p.feasible());
  EXPECT_EQ(by_nu_p.point.stiffness_ratio, 0.2);
  EXPECT_EQ(by_nu_p.point.softness, 0.5);
  const SearchResult by_softness = find_poisson(model, held(0.0, {}, 0.45), 0.36);
  ASSERT_TRUE(by_softness.feasible());
  EXPECT_EQ(by_softness.point.particle_poisson_ratio, 0.45);
  // Nothing is free: the verdict is what the moduli are.
  const double nu = model.at({0.2, 0.5, 0.3}).poisson;
  EXPECT_TRUE(find_poisson(model, held(0.2, 0.5, 0.3), nu).feasible());
  EXPECT_FALSE(find_poisson(model, held(0.2, 0.5, 0.3), nu + 1e-4).feasible());
}

}  // namespace
}  // namespace ddem::harness::test
