// Static moduli of strips and random cells: against the lattice's closed forms, and against what must not
// change them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
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
constexpr double kRatios[] = {0.0, 0.3, 1.0};

LatticeCase lattice(const test::Law& law, double ratio) {
  return {.law = law, .stiffness_ratio = ratio, .thickness = kThickness};
}

struct StripErrors {
  double c11, c12, c22, c66;
};

/// Relative to K + G (C12 may be 0), and C66 relative to itself.
StripErrors strip_errors(CloseRows orientation, int columns, const LatticeCase& c) {
  const Assembly a = test::hexagonal_assembly(
      {.close_packed = orientation, .columns = columns, .rows = 6, .radius = kRadius, .periodic_y = true},
      kThickness);
  const PlaneStiffness s = homogenise_strip(a, c.contact(), c.deformation(), kEdgeBand);
  const IsotropicModuli exact = test::closed_form(c);
  const double p = exact.bulk + exact.shear;
  return {std::abs(s(0, 0) / p - 1.0), std::abs(s(0, 1) - (exact.bulk - exact.shear)) / p,
          std::abs(s(1, 1) / p - 1.0), std::abs(s(2, 2) / exact.shear - 1.0)};
}

double largest(const StripErrors& e) {
  return std::max({e.c11, e.c12, e.c22, e.c66});
}

/// Without particle strain the affine motion of the ends is the equilibrium of every disc, so only round-off
/// is left. Particle strains differ in the end discs, which lack bonds: a disturbance that alternates from
/// row to row, with the wave number q = pi/(sqrt(3) r) along y, and so decays like exp(-q x), in the lattice
/// a little more slowly. From the ends of 68 columns to the gauge there are 24 r: exp(-24) = 4e-11 of a
/// disturbance of some per cent.
TEST(StripStiffness, IsTheLatticesRowsAlongX) {
  for (const double ratio : kRatios) {
    EXPECT_LT(largest(strip_errors(CloseRows::along_x, 68, lattice(test::kDem, ratio))), 1e-12) << ratio;
    for (const test::Law& law : test::kLaws) {
      const LatticeCase c = lattice(law, ratio);
      EXPECT_LT(largest(strip_errors(CloseRows::along_x, 68, c)), 1e-11) << c.description();
    }
  }
}

/// The boundary layer itself: 18 more columns move the gauge away from the ends by 7.2 r, exp(-7.2) = 7e-4.
TEST(StripStiffness, EndsDecayExponentially) {
  for (const double ratio : kRatios) {
    const LatticeCase c = lattice(test::kFull, ratio);
    const double near = largest(strip_errors(CloseRows::along_x, 32, c)),
                 far = largest(strip_errors(CloseRows::along_x, 50, c));
    EXPECT_LT(near, 1e-6) << ratio;
    EXPECT_LT(far, 2e-3 * near) << ratio;
  }
}

/// Columns of vertical bonds, wherever the ends of the gauge lie among them. From the ends of 32 columns to
/// the gauge there are 8 r, exp(-8) = 3e-4 of a disturbance of less than a per cent. C22 is no force through
/// a section along x but a mean over the columns, lumps at a spacing s = sqrt(3) r: with weights that are
/// piecewise linear over L = 0.6 columns s, falling to 0 over a quarter of L at each end, each of the four
/// kinks costs up to s^2/12 of its change of slope, together s^2/(3 (L/4) (3/4 L)) = 5/columns^2.
TEST(StripStiffness, IsTheLatticesRowsAlongY) {
  for (const int columns : {32, 50, 68}) {
    for (const double ratio : kRatios) {
      for (const test::Law& law : test::kLaws) {
        const LatticeCase c = lattice(law, ratio);
        const StripErrors e = strip_errors(CloseRows::along_y, columns, c);
        SCOPED_TRACE(c.description() + ", columns " + std::to_string(columns));
        EXPECT_LT(e.c11, 1e-6);
        EXPECT_LT(e.c66, 1e-6);
        EXPECT_LT(e.c12, 1e-6);
        EXPECT_LT(e.c22, 5.0 / (columns * columns));
      }
    }
  }
}

/// E of the free strip, 12 times as long as high in discs: EA over the nominal section.
double strip_young(int rows, const LatticeCase& c, StripTension* tension = nullptr) {
  const Assembly a =
      test::hexagonal_assembly({.columns = 12 * rows, .rows = rows, .radius = kRadius}, kThickness);
  const StripTension t = pull_strip(a, c.contact(), c.deformation(), kEdgeBand);
  if (tension != nullptr) *tension = t;
  return t.axial_stiffness / (a.packing.width * kThickness);
}

// What the grips disturb decays along a strip with free edges like exp(-4.2 x/width) or faster (the smallest
// root of sin z + z = 0, Papkovich and Fadle). The gauge begins at x/width = (0.2 * 24 rows - 3)/(sqrt(3)
// rows) >= 2.4, which leaves exp(-10) = 4e-5 of a disturbance of the corners only, some per cent in the mean
// of a section: 1e-6.
constexpr double kGrips = 1e-6;

/// Free rows lack the bonds beyond them: of the strip's height a constant part carries nothing but its own
/// row, so that E_strip = E (1 - c/rows). For DEM the uniform strain is the exact equilibrium, and the rows'
/// own bonds carry 2 k_n/(sqrt(3) h) of E: c = 1 - 2 k_n/(sqrt(3) h E), 0 for k_t = 0.
TEST(StripTensionTest, FreeRowsOfRigidDiscs) {
  for (const double ratio : kRatios) {
    const LatticeCase c = lattice(test::kDem, ratio);
    const double young = test::closed_form(c).young();
    const double lost = 1.0 - 2.0 * c.normal_stiffness / (std::sqrt(3.0) * kThickness * young);
    for (const int rows : {6, 9, 14})
      EXPECT_NEAR(strip_young(rows, c) / young, 1.0 - lost / rows, kGrips) << ratio << ", rows " << rows;
  }
}

/// With particle strain the constant c is not known, but two heights give E and c, and a third must agree.
TEST(StripTensionTest, TendsToTheLattice) {
  for (const double ratio : kRatios) {
    for (const test::Law& law : test::kLaws) {
      const LatticeCase c = lattice(law, ratio);
      SCOPED_TRACE(c.description());
      const double young = test::closed_form(c).young();
      const double e8 = strip_young(8, c), e12 = strip_young(12, c), e16 = strip_young(16, c);
      EXPECT_NEAR((16.0 * e16 - 8.0 * e8) / 8.0 / young, 1.0, kGrips);
      EXPECT_NEAR((12.0 * e12 - 8.0 * e8) / 4.0 / young, 1.0, kGrips);
      EXPECT_LE(e8, e12 * (1.0 + kGrips));
      EXPECT_LE(e12, e16 * (1.0 + kGrips));
    }
  }
}

/// The contraction is a least-squares slope over all discs between the gauge's sections: the grips reach into
/// it with exp(-10) = 4e-5 at its ends.
TEST(StripTensionTest, ContractionAndBarSpeed) {
  for (const double ratio : kRatios) {
    const LatticeCase c = lattice(test::kDem, ratio);
    const IsotropicModuli exact = test::closed_form(c);
    StripTension t;
    const double young = strip_young(16, c, &t);
    EXPECT_NEAR(t.lateral_contraction.value(), exact.poisson(), 4e-5) << ratio;
    const double bulk_density = test::kDensity * std::numbers::pi / (2.0 * std::sqrt(3.0));
    EXPECT_NEAR(t.bar_velocity() / std::sqrt(young / bulk_density), 1.0, 1e-12);
  }
}

Assembly random_cell() {
  const Packing p = packings::random_jammed({.length = 4e-3, .width = 2e-3, .discs = 160, .seed = 7});
  return make_assembly(p, bonds_within_gap(p, 0.4 * mean_radius(p)), 1.0, test::kDensity, RattlerRule::peel);
}

/// Turned by 90 degrees: (x, y) becomes (-y, x), shifted back into the cell.
Packing turned(const Packing& p) {
  Packing q = p;
  for (std::size_t d = 0; d < p.size(); ++d) {
    q.x[d] = p.width - p.y[d];
    q.y[d] = p.x[d];
  }
  q.period = {p.period.y, p.period.x};
  q.length = p.width, q.width = p.length;
  return q;
}

double relative_difference(const PlaneStiffness& a, const PlaneStiffness& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/// Residual of the solves, 1e-12, times the condition of the packing (some hundreds).
constexpr double kSolve = 1e-9;

/// Moduli depend on k_n/(E_p h) only: h C/k_n is the same for parameters scaled together.
TEST(RandomCell, ScaleInvariance) {
  const Assembly thick = random_cell();
  const Assembly thin = make_assembly(thick.packing, thick.bonds, 0.37, test::kDensity);
  for (const test::Law& law : test::kLaws) {
    const LatticeCase a{.law = law, .normal_stiffness = 1e10, .stiffness_ratio = 0.4, .young_modulus = 4e10};
    LatticeCase b = a;
    b.normal_stiffness = 3.1e7;
    b.young_modulus = a.young_modulus * (b.normal_stiffness / a.normal_stiffness) / 0.37;
    const PlaneStiffness c = homogenise_cell(thick, a.contact(), a.deformation()) / a.normal_stiffness;
    const PlaneStiffness scaled =
        homogenise_cell(thin, b.contact(), b.deformation()) * 0.37 / b.normal_stiffness;
    EXPECT_LT(relative_difference(scaled, c), kSolve) << law.name;
    if (law.scheme == Scheme::none) continue;
    // And the test sees a thickness that is forgotten in k_n/(E_p h).
    b.young_modulus *= 0.37;
    EXPECT_GT(relative_difference(
                  homogenise_cell(thin, b.contact(), b.deformation()) * 0.37 / b.normal_stiffness, c),
              1e-2)
        << law.name;
  }
}

/// A quarter turn swaps x and y: C11 and C22, C16 and -C26; C12 and C66 stay. Rows and columns apart, since N
/// is not symmetric.
TEST(RandomCell, QuarterTurn) {
  const Assembly a = random_cell();
  const Packing q = turned(a.packing);
  const Assembly b =
      make_assembly(q, bonds_within_gap(q, 0.4 * mean_radius(q)), 1.0, test::kDensity, RattlerRule::peel);
  ASSERT_EQ(a.bonds.size(), b.bonds.size());
  Eigen::Matrix3d swap;
  swap << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  for (const test::Law& law : test::kLaws) {
    const LatticeCase c{.law = law, .stiffness_ratio = 0.4};
    const PlaneStiffness ca = homogenise_cell(a, c.contact(), c.deformation()),
                         cb = homogenise_cell(b, c.contact(), c.deformation());
    EXPECT_LT(relative_difference(cb, swap * ca * swap), kSolve) << law.name;
    // The packing is not isotropic, so the swap is seen.
    EXPECT_GT(std::abs(ca(0, 0) / ca(1, 1) - 1.0), 1e-3) << law.name;
  }
}

/// Stiffness turned by `angle`: sigma' = T sigma, eps = T^T eps' for engineering shear.
PlaneStiffness rotated(const PlaneStiffness& c, double angle) {
  const double cs = std::cos(angle), sn = std::sin(angle);
  Eigen::Matrix3d t;
  t << cs * cs, sn * sn, 2 * cs * sn, sn * sn, cs * cs, -2 * cs * sn, -cs * sn, cs * sn, cs * cs - sn * sn;
  return t * c * t.transpose();
}

TEST(IsotropicPart, DoesNotDependOnTheFrame) {
  test::Noise noise(11);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::Matrix3d m;
    for (double& x : m.reshaped()) x = noise();
    const PlaneStiffness c = m * m.transpose() + Eigen::Matrix3d::Identity();
    const IsotropicModuli here = isotropic_part(c);
    for (const double angle : {0.1, 0.7, 1.3, 2.9}) {
      const PlaneStiffness there = rotated(c, angle);
      EXPECT_GT((there - c).norm(), 1e-3 * c.norm());
      EXPECT_NEAR(isotropic_part(there).bulk, here.bulk, 1e-14 * c.norm());
      EXPECT_NEAR(isotropic_part(there).shear, here.shear, 1e-14 * c.norm());
    }
  }
}

/// And of an isotropic stiffness it is the whole.
TEST(IsotropicPart, OfAnIsotropicStiffness) {
  PlaneStiffness c;
  c << 7, 3, 0, 3, 7, 0, 0, 0, 2;
  EXPECT_DOUBLE_EQ(isotropic_part(c).bulk, 5.0);
  EXPECT_DOUBLE_EQ(isotropic_part(c).shear, 2.0);
  EXPECT_LT((rotated(c, 0.4) - c).norm(), 1e-14);
}

/// Nothing can give way: the bonds take the strain as it is.
TEST(StaticSolver, WithEverythingHeldIsAffine) {
  const Assembly a = test::hexagonal_assembly({.columns = 4, .rows = 3, .radius = kRadius}, kThickness);
  const LatticeCase c{.law = test::kDem, .stiffness_ratio = 0.3, .thickness = kThickness};
  HeldDofs held;
  for (auto* h : {&held.x, &held.y, &held.theta}) h->assign(a.size(), 1);
  const StaticSolver solver(a, c.contact(), c.deformation(), held);
  const StaticState state = solver.solve({1e-3, -2e-3, 5e-4});
  EXPECT_EQ(state.fluctuation.norm(), 0.0);
  const Eigen::VectorXd affine = solver.operators().stiffness.cwiseProduct(affine_overlaps(a, solver.operators(), {1e-3, -2e-3, 5e-4}));
  // Forces are unknowns of their own: right to the last places.
  EXPECT_LE((state.bond_forces - affine).lpNorm<Eigen::Infinity>(), 4e-16 * affine.lpNorm<Eigen::Infinity>());
}

TEST(GrippedStrip, RefusesAStripWithoutInnerSections) {
  const Assembly a = test::hexagonal_assembly({.columns = 4, .rows = 4, .radius = kRadius, .periodic_y = true}, kThickness);
  const LatticeCase c{.law = test::kDem, .stiffness_ratio = 0.3, .thickness = kThickness};
  EXPECT_THROW(GrippedStrip(a, c.contact(), c.deformation(), 1.2 * kRadius), std::invalid_argument);
}

}  // namespace
}  // namespace ddem
