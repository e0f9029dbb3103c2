// Static speeds between sections: the lattice's closed forms, the pulled strip, and what must be refused.

#include "dem/statics/sections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "dem/statics/moduli.h"
#include "meshes/packings/random.h"
#include "tests/support/assemblies.h"
#include "tests/verification/laws.h"

namespace ddem {
namespace {

using packings::CloseRows;
using test::LatticeCase;

constexpr double kRadius = 1.3e-4;
constexpr double kThickness = 0.37;
constexpr double kEdgeBand = 1.2 * kRadius;

LatticeCase lattice(const test::Law& law, double ratio) {
  return {.law = law, .stiffness_ratio = ratio, .thickness = kThickness};
}

Assembly strip(CloseRows rows_along, int columns, int rows, bool periodic) {
  return test::hexagonal_assembly(
      {.close_packed = rows_along, .columns = columns, .rows = rows, .radius = kRadius, .periodic_y = periodic},
      kThickness);
}

/// Discs within `half_width` of x.
SectionDiscs discs_near(const Assembly& a, double x, double half_width) {
  SectionDiscs discs;
  for (std::size_t d = 0; d < a.size(); ++d) {
    if (std::abs(a.packing.x[d] - x) < half_width) discs.push_back(static_cast<int>(d));
  }
  return discs;
}

/// Columns of discs repeat after `spacing`: sections of two columns each, at thirds of the strip.
std::vector<SectionDiscs> thirds(const Assembly& a, double spacing) {
  const double middle = 0.5 * a.packing.length;
  const double apart = spacing * std::round(a.packing.length / 6.0 / spacing);
  const double at = a.packing.x[0] + 2.0 * spacing * std::round((middle - a.packing.x[0]) / (2.0 * spacing));
  return {discs_near(a, at - apart, 0.6 * spacing), discs_near(a, at + apart, 0.6 * spacing)};
}

double relative(double value, double exact) {
  return std::abs(value / exact - 1.0);
}

/// The sections lie 22 r and more from the ends of 68 columns, whose disturbance decays like exp(-x/r) at the least
/// (statics_test.cc): 3e-10 of some per cent.
TEST(Sections, AreTheLatticesBetweenPeriodicEdges) {
  for (const CloseRows rows_along : {CloseRows::along_x, CloseRows::along_y}) {
    const bool along_x = rows_along == CloseRows::along_x;
    const Assembly a = strip(rows_along, 68, 6, true);
    const auto sections = thirds(a, along_x ? kRadius : std::sqrt(3.0) * kRadius);
    for (const double ratio : {0.0, 0.3, 1.0}) {
      for (const test::Law& law : test::kLaws) {
        const LatticeCase c = lattice(law, ratio);
        const IsotropicModuli exact = test::closed_form(c);
        const double density = test::kDensity * std::numbers::pi / (2.0 * std::sqrt(3.0));
        const auto speeds = static_sections(a, c.contact(), c.deformation(), kEdgeBand, sections).between(0, 1);
        SCOPED_TRACE(c.description());
        EXPECT_LT(relative(speeds.p, std::sqrt((exact.bulk + exact.shear) / density)), 1e-10);
        EXPECT_LT(relative(speeds.s, std::sqrt(exact.shear / density)), 1e-10);
        EXPECT_EQ(speeds.bar, 0.0);
        const GrippedStrip grips(a, c.contact(), c.deformation(), kEdgeBand);
        EXPECT_LT(relative(grips.sections(sections).between(0, 1).p, speeds.p), 1e-10);
        EXPECT_LT(relative(grips.sections(sections).between(0, 1).s, speeds.s), 1e-10);
      }
    }
  }
}

/// Of the free strip: what pull_strip finds between other sections of the same lattice. Grips reach to either with 1e-6
/// (statics_test.cc).
TEST(Sections, AreThePulledStrips) {
  const Assembly a = strip(CloseRows::along_x, 96, 8, false);
  const auto sections = thirds(a, kRadius);
  for (const double ratio : {0.0, 0.3, 1.0}) {
    for (const test::Law& law : test::kLaws) {
      const LatticeCase c = lattice(law, ratio);
      const double expected = pull_strip(a, c.contact(), c.deformation(), kEdgeBand).bar_velocity();
      const auto speeds = static_sections(a, c.contact(), c.deformation(), kEdgeBand, sections).between(0, 1);
      EXPECT_LT(relative(speeds.bar, expected), 2e-6) << c.description();
      EXPECT_EQ(speeds.p, 0.0);
      // The grips are the same ones.
      const GrippedStrip grips(a, c.contact(), c.deformation(), kEdgeBand);
      EXPECT_LT(relative(grips.sections(sections).between(0, 1).bar, speeds.bar), 1e-10);
    }
  }
}

Assembly random_strip(bool periodic) {
  Packing p = packings::random_jammed({.length = 8e-3, .width = 2e-3, .discs = 320, .seed = 5});
  const Bonds bonds = cut_at_edges(p, bonds_within_gap(p, 0.4 * mean_radius(p)), true, !periodic);
  p.period = {0.0, periodic ? p.width : 0.0};
  return make_assembly(p, bonds, kThickness, test::kDensity, RattlerRule::peel);
}

/// In series: compliances and masses between neighbouring sections add up to those between the outer ones, so that
/// d^2/c^2 = (sum m)(sum s). And the force is the same through each, so neither moduli nor speeds depend on the scale.
TEST(Sections, AddUpInSeries) {
  const Assembly a = random_strip(true);
  const double r = mean_radius(a.packing);
  std::vector<SectionDiscs> sections;
  for (const double x : {0.3, 0.5, 0.7}) sections.push_back(discs_near(a, x * a.packing.length, 2.0 * r));
  const LatticeCase c = lattice(test::kFull, 0.4);
  const StaticSections s = static_sections(a, c.contact(), c.deformation(), kEdgeBand, sections);
  const auto xx = [&](int from, int to) { return s.displacement[to](0, 0) - s.displacement[from](0, 0); };
  const auto yy = [&](int from, int to) { return s.displacement[to](1, 1) - s.displacement[from](1, 1); };
  EXPECT_GT(xx(0, 1), 0.0);
  EXPECT_GT(yy(1, 2), xx(1, 2));  // shear is softer
  const double mass = s.mass_before[2] - s.mass_before[0], d = s.x[2] - s.x[0];
  const double density = bulk_density(a) * a.packing.width * kThickness;
  EXPECT_NEAR(mass / (density * d), 1.0, 0.02);
  // Anisotropy couples P and S by (C16/C11)^2, below a per cent.
  EXPECT_NEAR(s.between(0, 2).p / (d / std::sqrt(mass * xx(0, 2))), 1.0, 0.01);
  EXPECT_NEAR(s.between(0, 2).s / (d / std::sqrt(mass * yy(0, 2))), 1.0, 0.01);
  // The whole strip's speed is that of another piece: within what 682 discs scatter, here half as many.
  const PlaneStiffness whole = homogenise_strip(a, c.contact(), c.deformation(), kEdgeBand);
  const DirectionalSpeeds directional = directional_speeds(whole, moving_density(a));
  EXPECT_NEAR(s.between(0, 2).p / directional.p, 1.0, 0.03);
  EXPECT_NEAR(s.between(0, 2).s / directional.s, 1.0, 0.03);
}

/// Grips that hold everything press other forces through the strip, which the forces' matrix takes out again; what is left is
/// felt as far as exp(-2 pi x/W), 1.2 widths: 5e-4.
TEST(Sections, AreTheSameInGripsThatHoldEverything) {
  const Assembly a = random_strip(true);
  const double r = mean_radius(a.packing);
  const std::vector<SectionDiscs> sections = {discs_near(a, 0.3 * a.packing.length, 2.0 * r),
                                              discs_near(a, 0.7 * a.packing.length, 2.0 * r)};
  for (const double ratio : {0.0, 0.4}) {
    for (const test::Law& law : test::kLaws) {
      const LatticeCase c = lattice(law, ratio);
      const StaticSections free = static_sections(a, c.contact(), c.deformation(), kEdgeBand, sections);
      const StaticSections held = GrippedStrip(a, c.contact(), c.deformation(), kEdgeBand).sections(sections);
      EXPECT_LT(relative(held.between(0, 1).p, free.between(0, 1).p), 5e-4) << c.description();
      EXPECT_LT(relative(held.between(0, 1).s, free.between(0, 1).s), 5e-4) << c.description();
      for (const int k : {0, 1}) {
        const auto alone = static_compliances(a, c.contact(), c.deformation(), kEdgeBand, sections, k);
        EXPECT_LT(relative(alone[1] - alone[0], free.displacement[1](k, k) - free.displacement[0](k, k)), 1e-9) << c.description();
      }
      // Compliances that couple P and S are 1e-2 of the others.
      const Eigen::Matrix2d s_free = free.displacement[1] - free.displacement[0], s_held = held.displacement[1] - held.displacement[0];
      EXPECT_LT((s_held - s_free).norm(), 1e-3 * s_free.norm()) << c.description();
    }
  }
}

TEST(GrippedStrip, RefusesWhatItsEdgesDoNotAllow) {
  const LatticeCase c = lattice(test::kDem, 0.3);
  const Assembly open = strip(CloseRows::along_x, 30, 4, false), closed = strip(CloseRows::along_x, 30, 4, true);
  EXPECT_THROW(GrippedStrip(open, c.contact(), c.deformation(), kEdgeBand).stiffness(), std::invalid_argument);
  EXPECT_THROW(GrippedStrip(closed, c.contact(), c.deformation(), kEdgeBand).tension(), std::invalid_argument);
}

/// N is not symmetric, but its equilibrium is one: softer than that of rigid discs, and the whole strip's within what
/// 320 discs scatter.
TEST(Sections, OfTheUnsymmetricCorrection) {
  const Assembly a = random_strip(true);
  const double r = mean_radius(a.packing);
  const std::vector<SectionDiscs> sections = {discs_near(a, 0.3 * a.packing.length, 2.0 * r),
                                              discs_near(a, 0.7 * a.packing.length, 2.0 * r)};
  const LatticeCase rigid = lattice(test::kDem, 0.4), c = lattice(test::kLaws[1], 0.4);
  const auto dem = static_sections(a, rigid.contact(), rigid.deformation(), kEdgeBand, sections).between(0, 1);
  const auto normal = static_sections(a, c.contact(), c.deformation(), kEdgeBand, sections).between(0, 1);
  EXPECT_LT(normal.p, 0.9 * dem.p);
  EXPECT_LT(normal.s, 0.9 * dem.s);
  const DirectionalSpeeds whole =
      directional_speeds(homogenise_strip(a, c.contact(), c.deformation(), kEdgeBand), moving_density(a));
  EXPECT_NEAR(normal.p / whole.p, 1.0, 0.03);
  EXPECT_NEAR(normal.s / whole.s, 1.0, 0.03);
}

TEST(Sections, RefuseWhatIsNoMeasurement) {
  const Assembly a = strip(CloseRows::along_x, 30, 4, true);
  const LatticeCase c = lattice(test::kDem, 0.3);
  const auto sections_of = [&](const std::vector<SectionDiscs>& s) {
    return static_sections(a, c.contact(), c.deformation(), kEdgeBand, s);
  };
  EXPECT_THROW(sections_of({{}}), std::invalid_argument);
  EXPECT_THROW(sections_of({{static_cast<int>(a.size())}}), std::invalid_argument);
  EXPECT_THROW(sections_of({{-1}}), std::invalid_argument);
  const StaticSections s = sections_of({discs_near(a, 20 * kRadius, 2 * kRadius), discs_near(a, 30 * kRadius, 2 * kRadius)});
  EXPECT_THROW(s.between(1, 0), std::invalid_argument);
  EXPECT_THROW(s.between(0, 0), std::invalid_argument);
  EXPECT_THROW(s.between(0, 2), std::out_of_range);
}

}  // namespace
}  // namespace ddem
