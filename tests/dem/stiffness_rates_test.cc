// Derivatives of the homogenised stiffness with respect to k_t/k_n, softness and nu_p, against differences of
// the moduli.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dem/statics/moduli.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

struct Point {
  double stiffness_ratio = 0.3, log_softness = std::log(0.4), particle_poisson_ratio = 0.35;
};

struct Law {
  std::string name;
  Scheme scheme;
  Correction correction;
  Plane plane;
};

const Law kLaws[] = {{"DEM", Scheme::none, Correction::normal, Plane::stress},
                     {"N", Scheme::implicit, Correction::normal, Plane::stress},
                     {"F", Scheme::implicit, Correction::full, Plane::stress},
                     {"F plane strain", Scheme::implicit, Correction::full, Plane::strain},
                     {"NN", Scheme::implicit, Correction::normal_only_stress, Plane::stress}};

constexpr double kEdgeBand = 1.2 * 1.13e-4;  // m: 1.2 mean radii

StiffnessRates homogenised(const Assembly& a, const Law& law, const Point& x,
                           std::span<const Parameter> parameters) {
  const ContactParameters contact{1e10, x.stiffness_ratio, Kinematics::linear};
  DeformationParameters d;
  d.scheme = law.scheme;
  d.correction = law.correction;
  d.plane = law.plane;
  d.young_modulus = 1e10 / std::exp(x.log_softness);
  d.poisson_ratio = x.particle_poisson_ratio;
  return homogenise_with_rates(a, contact, d, kEdgeBand, parameters);
}

double& component(Point& x, Parameter p) {
  switch (p) {
    case Parameter::stiffness_ratio:
      return x.stiffness_ratio;
    case Parameter::log_softness:
      return x.log_softness;
    case Parameter::particle_poisson_ratio:
      break;
  }
  return x.particle_poisson_ratio;
}

Assembly strip() {
  Assembly a = test::random_cell(1);
  Packing p = a.packing;
  const Bonds bonds = cut_at_edges(p, a.bonds, true, false);
  p.period.x = 0.0;
  return make_assembly(p, bonds, 1.0, test::kDensity);
}

/// Central differences of step h = 1e-4 err by h^2/6 f''' and 1e-12 |C|/h of the solves' residuals: with
/// derivatives of the order of the stiffness itself (third ones below 100 times that) below 1e-6 of its
/// largest entry.
void expect_differences(const Assembly& a, const Law& law, const std::string& where) {
  std::vector<Parameter> parameters = {Parameter::stiffness_ratio};
  if (law.scheme != Scheme::none)
    parameters = {Parameter::stiffness_ratio, Parameter::log_softness, Parameter::particle_poisson_ratio};
  const StiffnessRates at = homogenised(a, law, {}, parameters);
  ASSERT_EQ(at.rates.size(), parameters.size());
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    constexpr double h = 1e-4;
    Point above, below;
    component(above, parameters[p]) += h;
    component(below, parameters[p]) -= h;
    const PlaneStiffness difference =
        (homogenised(a, law, above, {}).stiffness - homogenised(a, law, below, {}).stiffness) / (2.0 * h);
    EXPECT_LT((at.rates[p] - difference).cwiseAbs().maxCoeff(), 1e-6 * at.stiffness.cwiseAbs().maxCoeff())
        << where << ", " << law.name << ", parameter " << p;
    EXPECT_GT(at.rates[p].cwiseAbs().maxCoeff(), 1e-3 * at.stiffness.cwiseAbs().maxCoeff())
        << where << ", " << law.name << ", parameter " << p;
  }
}

TEST(StiffnessRates, AreDifferencesOfTheModuliOfACell) {
  const Assembly a = test::random_cell(1);
  for (const Law& law : kLaws) expect_differences(a, law, "cell");
}

TEST(StiffnessRates, AreDifferencesOfTheModuliOfAStrip) {
  const Assembly a = strip();
  for (const Law& law : kLaws) expect_differences(a, law, "strip");
}

/// Closed form: 2G = A(1 + lambda)/4, 2K = A/2 with A = 2 sqrt(3) k_n, so dC66/dlambda = A/8 and dC11/dlambda
/// = A/8, dC12/dlambda = -A/8, exact up to the residuals of the solves.
TEST(StiffnessRates, AreTheLatticesClosedForm) {
  const Assembly a = test::hexagonal_assembly(
      {.columns = 6, .rows = 6, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
  const Parameter parameters[] = {Parameter::stiffness_ratio};
  const PlaneStiffness rate = homogenised(a, kLaws[0], {}, parameters).rates[0];
  const double eighth = 2.0 * std::sqrt(3.0) * 1e10 / 8.0;
  PlaneStiffness exact;
  exact << eighth, -eighth, 0.0, -eighth, eighth, 0.0, 0.0, 0.0, eighth;
  EXPECT_LT((rate - exact).cwiseAbs().maxCoeff(), 1e-11 * eighth);
}

TEST(StiffnessRates, RefuseWhatAnAssemblyDoesNotHave) {
  const Assembly a = test::hexagonal_assembly(
      {.columns = 6, .rows = 6, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
  Point no_shear;
  no_shear.stiffness_ratio = 0.0;
  const Parameter ratio[] = {Parameter::stiffness_ratio}, softness[] = {Parameter::log_softness};
  EXPECT_THROW(homogenised(a, kLaws[0], no_shear, ratio), std::invalid_argument);
  EXPECT_THROW(homogenised(a, kLaws[0], {}, softness), std::invalid_argument);
}

}  // namespace
}  // namespace ddem
