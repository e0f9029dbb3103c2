// The infinite hexagonal lattice, homogenised on a small periodic cell, against its closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/statics/moduli.h"
#include "tests/support/assemblies.h"
#include "tests/verification/laws.h"

namespace ddem {
namespace {

using packings::CloseRows;
using test::LatticeCase;

/// The smallest even cell in which no pair touches through two images: any cell of the lattice is exact.
Assembly cell(CloseRows orientation, double thickness) {
  return test::hexagonal_assembly({.close_packed = orientation,
                                   .columns = 4,
                                   .rows = 4,
                                   .radius = 1.3e-4,
                                   .periodic_x = true,
                                   .periodic_y = true},
                                  thickness);
}

/// Double precision, a residual of 1e-12 of the load and a condition number of the cell of at most 100.
constexpr double kTolerance = 1e-10;

struct Errors {
  double young, shear, poisson, anisotropy;
  double largest() const { return std::max({young, shear, poisson, anisotropy}); }
};

Errors errors(const PlaneStiffness& c, const IsotropicModuli& exact) {
  const IsotropicModuli m = isotropic_part(c);
  PlaneStiffness isotropic;
  isotropic << m.bulk + m.shear, m.bulk - m.shear, 0, m.bulk - m.shear, m.bulk + m.shear, 0, 0, 0, m.shear;
  return {std::abs(m.young() / exact.young() - 1.0), std::abs(m.shear / exact.shear - 1.0),
          std::abs(m.poisson() - exact.poisson()), (c - isotropic).cwiseAbs().maxCoeff() / m.shear};
}

template <class Visit>
void for_each_case(double thickness, Visit&& visit) {
  for (const test::Law& law : test::kLaws) {
    for (const double ratio : {0.0, 0.1, 0.25, 0.5, 0.75, 1.0}) {
      if (law.scheme == Scheme::none) {
        visit(LatticeCase{.law = law, .stiffness_ratio = ratio, .thickness = thickness});
        continue;
      }
      for (const double softness : {0.01, 0.1, 0.5, 1.0, 5.0}) {
        for (const double nu : {0.0, 0.2, 0.35, 0.49}) {
          for (const Plane plane : {Plane::stress, Plane::strain}) {
            visit(LatticeCase{law, 1e10, ratio, 1e10 / softness, nu, plane, thickness});
          }
        }
      }
    }
  }
}

void expect_closed_forms(CloseRows orientation, double thickness) {
  const Assembly a = cell(orientation, thickness);
  int cases = 0;
  for_each_case(thickness, [&](const LatticeCase& c) {
    const Errors e = errors(homogenise_cell(a, c.contact(), c.deformation()), test::closed_form(c));
    EXPECT_LT(e.young, kTolerance) << c.description();
    EXPECT_LT(e.shear, kTolerance) << c.description();
    EXPECT_LT(e.poisson, kTolerance) << c.description();
    EXPECT_LT(e.anisotropy, kTolerance) << c.description();
    ++cases;
  });
  EXPECT_EQ(cases, 6 + 3 * 6 * 5 * 4 * 2);
}

TEST(ClosedForms, RowsAlongX) {
  expect_closed_forms(CloseRows::along_x, 1.0);
}
TEST(ClosedForms, RowsAlongXThin) {
  expect_closed_forms(CloseRows::along_x, 0.37);
}
TEST(ClosedForms, RowsAlongY) {
  expect_closed_forms(CloseRows::along_y, 1.0);
}
TEST(ClosedForms, RowsAlongYThin) {
  expect_closed_forms(CloseRows::along_y, 0.37);
}

/// The check values of the theory, evaluated from its formulas apart from this program, to twelve digits.
TEST(ClosedForms, CheckValues) {
  struct Row {
    const test::Law& law;
    Plane plane;
    double young, shear, poisson;
  };
  const Row rows[] = {{test::kLaws[1], Plane::stress, 2715390710.03, 1187015238.26, 0.143789322368},
                      {test::kLaws[2], Plane::stress, 2536641118.48, 1056799737.74, 0.200152227471},
                      {test::kLaws[3], Plane::stress, 2913365535.53, 1347078579.59, 0.0813643612488},
                      {test::kLaws[1], Plane::strain, 2772794164.86, 1187015238.26, 0.167969068753},
                      {test::kLaws[2], Plane::strain, 2586666162.78, 1056799737.74, 0.223820403433},
                      {test::kLaws[3], Plane::strain, 2979546519.63, 1347078579.59, 0.105928995078}};
  for (const Row& row : rows) {
    const LatticeCase c{row.law, 3e9, 0.37, 7e9, 0.22, row.plane, 1.0};
    SCOPED_TRACE(c.description());
    const IsotropicModuli exact = test::closed_form(c);
    const IsotropicModuli homogenised =
        isotropic_part(homogenise_cell(cell(CloseRows::along_x, 1.0), c.contact(), c.deformation()));
    for (const IsotropicModuli& m : {exact, homogenised}) {
      EXPECT_NEAR(m.young() / row.young, 1.0, kTolerance);
      EXPECT_NEAR(m.shear / row.shear, 1.0, kTolerance);
      EXPECT_NEAR(m.poisson(), row.poisson, kTolerance);
    }
  }
}

/// What the tolerance sees: nu_p wrong by 1e-6, k_n, k_t and E_p by 1e-6 of themselves, the other plane, a
/// thickness forgotten. At least ten tolerances each.
TEST(ClosedForms, TheToleranceSees) {
  const Assembly a = cell(CloseRows::along_x, 0.37);
  for_each_case(0.37, [&](const LatticeCase& c) {
    SCOPED_TRACE(c.description());
    const IsotropicModuli exact = test::closed_form(c);
    const auto error_of = [&](const LatticeCase& wrong) {
      return errors(homogenise_cell(a, wrong.contact(), wrong.deformation()), exact).largest();
    };
    LatticeCase stiffer = c;
    stiffer.normal_stiffness *= 1.0 + 1e-6;
    EXPECT_GT(error_of(stiffer), 10.0 * kTolerance);
    if (c.law.scheme == Scheme::none) return;
    LatticeCase wider = c;
    wider.poisson_ratio += 1e-6;
    EXPECT_GT(error_of(wider), 10.0 * kTolerance);
    LatticeCase harder = c;
    harder.young_modulus *= 1.0 + 1e-6;
    EXPECT_GT(error_of(harder), 10.0 * kTolerance);
    if (c.poisson_ratio > 0.0) {
      LatticeCase other = c;
      other.plane = c.plane == Plane::stress ? Plane::strain : Plane::stress;
      EXPECT_GT(error_of(other), 10.0 * kTolerance);
    }
    LatticeCase thick = c;
    thick.thickness = 1.0;
    EXPECT_GT(errors(homogenise_cell(a, c.contact(), c.deformation()), test::closed_form(thick)).largest(),
              10.0 * kTolerance);
  });
}

}  // namespace
}  // namespace ddem
