// Quick bounds against the limits that they stand for: lattices and random packings, every law, every option that the bounds know of.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "dem/spectra/limit_bounds.h"
#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"
#include "tests/support/parameters.h"

namespace ddem {
namespace {

using test::linear_contact;
using test::strains;

Assembly lattice_cell(double thickness) {
  return test::hexagonal_assembly({.columns = 12, .rows = 12, .radius = 1e-4, .periodic_x = true, .periodic_y = true}, thickness);
}

/// Sharp where all discs strain alike. A disc that strains alone bounds the radius from below, by half of that.
TEST(FixedPointBound, IsNotBelowTheRadius) {
  for (const Correction correction : {Correction::normal, Correction::full, Correction::normal_only_stress}) {
    for (const double lambda : {0.0, 0.7}) {
      const DeformationParameters d = strains(Scheme::lagged, correction, 0.3);
      const Assembly lattice = lattice_cell(1.25), random = test::random_free_strip();
      EXPECT_NEAR(fixed_point_bound(lattice, linear_contact(lambda), d) / fixed_point_radius(lattice, linear_contact(lambda), d), 1.0, 1e-4);
      const double over = fixed_point_bound(random, linear_contact(lambda), d) / fixed_point_radius(random, linear_contact(lambda), d);
      EXPECT_GT(over, 1.0 - 1e-4);
      EXPECT_LT(over, 2.0);
    }
  }
}

struct Variant {
  std::string name;
  std::function<void(Assembly&, ContactParameters&, DeformationParameters&, HeldDofs&)> apply;
};

std::vector<Variant> variants() {
  return {{"plain", [](auto&...) {}},
          {"plane strain", [](auto&, auto&, DeformationParameters& d, auto&) { d.plane = Plane::strain; }},
          {"cell volume", [](auto&, auto&, DeformationParameters& d, auto&) { d.volume = ParticleVolume::cell; }},
          {"thin", [](Assembly& a, auto&, auto&, auto&) { a.thickness = 0.3; }},
          {"stiffness by size", [](auto&, ContactParameters& c, auto&, auto&) { c.contact_modulus = 0.8 * c.normal_stiffness, c.normal_stiffness = 0.0; }},
          {"half held", [](Assembly& a, auto&, auto&, HeldDofs& held) {
             for (std::vector<std::uint8_t>* dofs : {&held.x, &held.y, &held.theta}) dofs->assign(a.size(), 0);
             for (std::size_t i = 0; i < a.size(); i += 2) held.x[i] = held.theta[i] = 1;
           }}};
}

/// The flip limit is not below its bound, from soft discs near their limit to stiff ones; and for these the bound is of use.
void expect_bounded(const std::string& what, const Assembly& a, const ContactParameters& contact, DeformationParameters d, const HeldDofs& held) {
  const double reach = 2.0 / d.relaxation - 1.0, softest = d.young_modulus * fixed_point_bound(a, contact, d) / reach;
  DeformationParameters rigid = d;
  rigid.scheme = Scheme::none;
  const double rigid_step = critical_step(a, contact, rigid, held).step.value();
  for (const double share : {0.05, 0.5, 0.97}) {
    d.young_modulus = softest / share;
    const double bound = flip_limit_bound(a, contact, d, rigid_step), limit = flip_limit_step(a, contact, d, held);
    EXPECT_GT(bound, 0.0) << what << ", " << share;
    EXPECT_LE(bound, limit * (1.0 + 1e-4)) << what << ", " << share;
    if (share == 0.05) { EXPECT_GT(bound, 0.9 * rigid_step) << what; }
  }
}

TEST(FlipLimitBound, IsNotAboveTheLimit) {
  for (const auto& [evaluations, relaxation] : {std::pair{1, 1.0}, {1, 0.4}, {3, 1.0}, {5, 0.5}}) {
    for (const Correction correction : {Correction::normal, Correction::full, Correction::normal_only_stress}) {
      if (correction == Correction::normal && evaluations != 1) continue;
      for (const double lambda : {0.1, 1.0}) {
        for (const auto& [name, assembly] : {std::pair{"lattice", lattice_cell(1.0)}, {"strip", test::random_free_strip()}, {"cell", test::random_cell(2)}}) {
          expect_bounded(fmt::format("{}, correction {}, k_t/k_n {}, {} evaluations, relaxation {}", name, static_cast<int>(correction), lambda, evaluations, relaxation),
                         assembly, linear_contact(lambda), strains(Scheme::lagged, correction, 1.0, evaluations, relaxation), {});
        }
      }
    }
  }
}

// Two discs that approach each other have one motion and strain alike: nothing is given away.
TEST(FlipLimitBound, IsTheLimitOfAPair) {
  Packing p;
  p.x = {1e-4, 3e-4}, p.y = {1e-4, 1e-4}, p.radius = {1e-4, 1e-4};
  p.length = 4e-4, p.width = 2e-4;
  const std::vector<std::pair<int, int>> bonded{{0, 1}};
  const Assembly pair = make_assembly(p, bonds_between(p, bonded), 1.0, test::kDensity);
  const HeldDofs along{{1, 0}, {1, 1}, {1, 1}};
  const ContactParameters contact = linear_contact(0.1);
  for (const Correction correction : {Correction::normal, Correction::full, Correction::normal_only_stress}) {
    for (const double relaxation : {1.0, 0.4}) {
      DeformationParameters d = strains(Scheme::lagged, correction, 1.0, 1, relaxation);
      const double rigid = critical_step(pair, contact, {}, along).step.value();
      d.young_modulus *= fixed_point_bound(pair, contact, d) / (2.0 / relaxation - 1.0) / 0.6;
      EXPECT_NEAR(flip_limit_bound(pair, contact, d, rigid) / flip_limit_step(pair, contact, d, along), 1.0, 1e-9) << static_cast<int>(correction) << ", " << relaxation;
      EXPECT_NEAR(flip_limit_bound(pair, contact, d, rigid) / rigid, std::sqrt(0.4), 1e-9);  // root of 1 - 0.6
    }
  }
}

TEST(FlipLimitBound, KnowsOfEveryOption) {
  for (const Variant& variant : variants()) {
    for (const Correction correction : {Correction::normal, Correction::full, Correction::normal_only_stress}) {
      Assembly a = test::random_free_strip();
      ContactParameters contact = linear_contact(0.4);
      DeformationParameters d = strains(Scheme::lagged, correction, 1.0);
      HeldDofs held;
      variant.apply(a, contact, d, held);
      expect_bounded(variant.name, a, contact, d, held);
    }
  }
}

TEST(FlipLimitBound, IsNoneWhereNothingIsKnown) {
  const Assembly a = test::random_free_strip();
  EXPECT_EQ(flip_limit_bound(a, linear_contact(0.4), strains(Scheme::lagged, Correction::full, 0.1, 2), 1.0), 0.0);
  EXPECT_EQ(flip_limit_bound(a, linear_contact(0.4), strains(Scheme::lagged, Correction::normal, 0.1, 3), 1.0), 0.0);
  EXPECT_EQ(flip_limit_bound(a, linear_contact(0.4), strains(Scheme::lagged, Correction::full, 100.0), 1.0), 0.0);
}

}  // namespace
}  // namespace ddem
