// The infinite lattice, whose moduli are closed forms: what a calibration finds must give them back.
#include <cmath>
#include <numbers>
#include <random>

#include "harness/references/effective_moduli.h"
#include "tests/harness/calibrate/scenes.h"

namespace ddem::harness::test {
namespace {

using references::ContactModel;

struct Variant {
  const char *scheme, *correction;
  ContactModel model;
};

constexpr Variant kVariants[] = {{"", "", ContactModel::dem},
                                 {"implicit", "normal", ContactModel::ddem_normal},
                                 {"implicit", "full", ContactModel::ddem_full},
                                 {"implicit", "normal_only_stress", ContactModel::ddem_normal_only_stress}};

references::PlaneConstants closed_form(ContactModel model, const ModelPoint& point, double k_n) {
  const double e_p = point.softness > 0.0 ? k_n / point.softness : 1.0;
  return references::plane_constants(
      references::effective_moduli(model, references::hexagonal_fabric(), {k_n, point.stiffness_ratio},
                                   {{e_p, point.particle_poisson_ratio}, 1.0}));
}

StaticModel model_of(const Scene& scene) {
  return StaticModel(scene, seed_assemblies(scene, 0, 1, 1), 1);
}

/// Targets are made by the closed forms from random parameters; found parameters, put into the closed forms,
/// give E and nu back within 1e-8 (the solves' residual is 1e-12, Newton ends at 1e-11).
TEST(HexagonalCalibration, RecoversAThousandRandomTargets) {
  std::mt19937_64 random(8);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1.0p-53;
  };
  for (const Variant& v : kVariants) {
    const StaticModel model = model_of(lattice_scene(v.scheme, v.correction));
    for (int n = 0; n < 250; ++n) {
      const ModelPoint truth{std::pow(10.0, uniform(-4.0, 1.0)), std::pow(10.0, uniform(-2.0, 1.0)),
                             uniform(-0.2, 0.49)};
      const auto target = closed_form(v.model, truth, std::pow(10.0, uniform(6.0, 12.0)));
      const SearchSpace space =
          model.deformable() ? held({}, truth.softness, truth.particle_poisson_ratio) : SearchSpace{};
      const SearchResult found = find_poisson(model, space, target.poisson_ratio);
      ASSERT_TRUE(found.feasible()) << v.correction << " " << truth.stiffness_ratio << " " << truth.softness
                                    << " " << truth.particle_poisson_ratio;
      const auto given = closed_form(v.model, found.point, target.young_modulus / found.moduli.young);
      EXPECT_NEAR(given.poisson_ratio, target.poisson_ratio, 1e-8);
      EXPECT_NEAR(given.young_modulus / target.young_modulus, 1.0, 1e-8);
    }
  }
}

/// 1/3 bounds rigid discs, and the range of deformable ones is that of the closed forms at its corners (all
/// values monotonic).
TEST(HexagonalCalibration, RecognisesWhatIsOutOfReach) {
  std::mt19937_64 random(9);
  const StaticModel rigid = model_of(lattice_scene());
  for (int n = 0; n < 200; ++n) {
    const double nu = 1.0 / 3.0 + 1e-5 + (2.0 / 3.0 - 2e-5) * static_cast<double>(random() >> 11) * 0x1.0p-53;
    const SearchResult nearest = find_poisson(rigid, {}, nu);
    EXPECT_FALSE(nearest.feasible()) << nu;
    EXPECT_NEAR(nearest.moduli.poisson, 1.0 / 3.0, 1e-11);
  }
  const StaticModel full = model_of(lattice_scene("implicit", "full"));
  const double highest = closed_form(ContactModel::ddem_full, {0.0, 10.0, 0.49}, 1.0).poisson_ratio;
  EXPECT_NEAR(highest, 0.4786, 1e-4);  // the prototype's 0.479
  EXPECT_TRUE(find_poisson(full, {}, highest - 1e-5).feasible());
  const SearchResult nearest = find_poisson(full, {}, highest + 1e-5);
  EXPECT_FALSE(nearest.feasible());
  EXPECT_NEAR(nearest.moduli.poisson, highest, 1e-9);
  EXPECT_NEAR(reachable_range(full, {}).highest, highest, 1e-9);
}

/// Lagged strains converge below k_n/E_p = pi/(3 (1 + nu_p)) there (theory section 3), which bounds nu at
/// 0.407, and at 0.4475 with half of each new strain.
TEST(HexagonalCalibration, KeepsLaggedStrainsStable) {
  Scene scene = lattice_scene("lagged", "full");
  const auto highest = [&](double radius) {
    return closed_form(ContactModel::ddem_full, {0.0, radius * std::numbers::pi / (3.0 * 1.49), 0.49}, 1.0)
        .poisson_ratio;
  };
  EXPECT_NEAR(highest(1.0), 0.407, 5e-4);
  EXPECT_NEAR(reachable_range(model_of(scene), {}).highest, highest(1.0), 1e-6);
  EXPECT_FALSE(find_poisson(model_of(scene), {}, 0.42).feasible());
  scene.deformation->relaxation = 0.5;
  EXPECT_NEAR(reachable_range(model_of(scene), {}).highest, highest(3.0), 1e-6);
  EXPECT_NEAR(highest(3.0), 0.4475, 5e-4);
  EXPECT_TRUE(find_poisson(model_of(scene), {}, 0.42).feasible());
}

/// E = 4KG/(K+G) with 2K = A/2, 2G = A (1 + lambda)/4, A = 2 sqrt(3) k_n: lambda = 0.2, k_n = 30e9/(0.375
/// A/k_n).
TEST(HexagonalCalibration, TheExample) {
  const Calibration c = calibrate(lattice_scene(), target_of(30e9, 0.25), {});
  EXPECT_TRUE(c.feasible);
  EXPECT_NEAR(c.found.point.stiffness_ratio, 0.2, 1e-10);
  EXPECT_NEAR(c.found.stiffness / 2.30940108e10, 1.0, 1e-8);
  EXPECT_NEAR(*c.found.particle_density, 2400.0 * 2.0 * std::sqrt(3.0) / std::numbers::pi, 1e-9);
  EXPECT_TRUE(c.what_helps.empty());
  const Calibration far = calibrate(lattice_scene(), target_of(30e9, 0.40), {});
  EXPECT_FALSE(far.feasible);
  EXPECT_NEAR(far.poisson_ratio, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(far.young_modulus / 30e9, 1.0, 1e-12);
  ASSERT_FALSE(far.what_helps.empty());
  EXPECT_NE(far.what_helps.front().find("implicit F"), std::string::npos);
}

/// The same modulus with a contact modulus: on discs of one radius r, k_n = E_c r.
TEST(HexagonalCalibration, FindsTheContactModulus) {
  Scene scene = lattice_scene("implicit", "full");
  scene.contact->stiffness = ContactModulus{1.0};
  const CalibrationOptions options{held({}, 0.3, 0.4), 1, 1};
  const Calibration c = calibrate(scene, target_of(30e9, 0.3), options);
  ASSERT_TRUE(c.feasible);
  const double k_n = c.found.stiffness * 1e-4 * 2.0 / 2.0;
  const auto given = closed_form(ContactModel::ddem_full, c.found.point, k_n);
  EXPECT_NEAR(given.young_modulus / 30e9, 1.0, 1e-9);
  EXPECT_NEAR(given.poisson_ratio, 0.3, 1e-9);
  EXPECT_NEAR(c.found.particle_young_modulus / (k_n / 0.3), 1.0, 1e-12);
}

}  // namespace
}  // namespace ddem::harness::test
