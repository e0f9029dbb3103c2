// Moduli of discs that hardly change their area or their shape, that hardly give or give almost everything: against the
// lattice's closed forms, and against the compliances of a random cell put together densely in long double.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "dem/assembly/particle_volume.h"
#include "dem/statics/moduli.h"
#include "meshes/packings/random.h"
#include "tests/support/assemblies.h"
#include "tests/verification/laws.h"

namespace ddem {
namespace {

using test::LatticeCase;
using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

struct Material {
  double poisson_ratio;
  Plane plane;
};

const Material kMaterials[] = {{0.4999, Plane::strain},      {0.49999, Plane::strain},   {0.4999999, Plane::strain},
                               {0.499999999, Plane::strain}, {-0.9999999, Plane::strain}, {0.3, Plane::strain},
                               {0.9999999, Plane::stress},   {-0.9999999, Plane::stress}, {0.0, Plane::stress}};
const double kSoftness[] = {1e-6, 1e-2, 0.25, 10.0, 1e3, 1e6};

LatticeCase with(const test::Law& law, const Material& m, double softness, double ratio) {
  return {.law = law, .stiffness_ratio = ratio, .young_modulus = 1e10 / softness, .poisson_ratio = m.poisson_ratio, .plane = m.plane};
}

/// The residual of forces, 1e-12, times the few that the lattice's condition adds. What soft discs leave of a bond's overlap is
/// its 1/softness part, and the lattice's coordinates are rounded to some 1e-15 radii.
TEST(ExtremeMaterial, IsTheClosedFormOnTheLattice) {
  const Assembly a = test::hexagonal_assembly({.columns = 6, .rows = 6, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
  for (const test::Law& law : test::kLaws) {
    for (const Material& m : kMaterials) {
      for (const double softness : kSoftness) {
        for (const double ratio : {0.0, 0.3, 1.0}) {
          const LatticeCase c = with(law, m, softness, ratio);
          const IsotropicModuli exact = test::closed_form(c), found = isotropic_part(homogenise_cell(a, c.contact(), c.deformation()));
          const double tolerance = 1e-9 + 5e-15 * softness;
          EXPECT_NEAR(found.bulk / exact.bulk, 1.0, tolerance) << c.description() << " nu_p = 1/2 - " << 0.5 - m.poisson_ratio;
          EXPECT_NEAR(found.shear / exact.shear, 1.0, tolerance) << c.description() << " nu_p = 1/2 - " << 0.5 - m.poisson_ratio;
        }
      }
    }
  }
}

/// (K^-1 + B) F - C q = e, C^T F = 0 with B = G D S, D the compliances of the discs over their volume: bounded whatever nu_p.
PlaneStiffness dense_stiffness(const Assembly& a, const LatticeCase& c) {
  const DeformationParameters d = c.deformation();
  const Operators op = make_operators(a, c.contact(), d);
  const long double nu = d.poisson_ratio, e = d.young_modulus;
  const bool strain = d.plane == Plane::strain;
  const long double direct = strain ? (1 - nu * nu) / e : 1 / e, coupling = strain ? -nu * (1 + nu) / e : -nu / e, shear = (1 + nu) / e;
  const std::vector<double> volume = particle_volumes(a, d);
  const Eigen::Index rows = op.overlap.rows(), dofs = op.overlap.cols();
  Matrix m = Matrix::Zero(rows + dofs, rows + dofs);
  const Matrix overlap = Eigen::MatrixXd(op.overlap).cast<long double>();
  if (op.deformable) {
    Matrix compliance = Matrix::Zero(op.stress.rows(), op.stress.rows());
    for (Eigen::Index p = 0; p < static_cast<Eigen::Index>(a.size()); ++p) {
      const long double v = static_cast<long double>(volume[static_cast<std::size_t>(p)]) / (op.length_scale * static_cast<long double>(op.length_scale));
      compliance.block<3, 3>(3 * p, 3 * p) << direct / v, coupling / v, 0, coupling / v, direct / v, 0, 0, 0, shear / (2 * v);
    }
    m.topLeftCorner(rows, rows) = Eigen::MatrixXd(op.strain_overlap).cast<long double>() * compliance * Eigen::MatrixXd(op.stress).cast<long double>();
  }
  // Over k_n, so that forces and displacements are of one order.
  const long double k = c.normal_stiffness;
  m.topLeftCorner(rows, rows) *= k;
  for (Eigen::Index r = 0; r < rows; ++r) m(r, r) += k / op.stiffness[r];
  m.topRightCorner(rows, dofs) = -overlap;
  m.bottomLeftCorner(dofs, rows) = overlap.transpose();
  for (const Eigen::Index fixed : {rows, rows + 1}) {  // the cell as a whole stays where it is
    m.row(fixed).setZero();
    m(fixed, fixed) = 1;
  }
  const Eigen::PartialPivLU<Matrix> lu(m);
  PlaneStiffness out;
  for (int k3 = 0; k3 < 3; ++k3) {
    const MacroStrain unit{k3 == 0 ? 1.0 : 0.0, k3 == 1 ? 1.0 : 0.0, k3 == 2 ? 1.0 : 0.0};
    Matrix rhs = Matrix::Zero(rows + dofs, 1);
    rhs.topRows(rows) = affine_overlaps(a, op, unit).cast<long double>();
    StaticState state;
    state.bond_forces = (lu.solve(rhs).topRows(rows) * k).cast<double>();
    Eigen::Vector3d stress = Eigen::Vector3d::Zero();
    for (std::size_t b = 0; b < a.bonds.size(); ++b) {
      const Eigen::Vector2d f = bond_force(a.bonds, op, state, b);
      const double lx = a.bonds.length[b] * a.bonds.nx[b], ly = a.bonds.length[b] * a.bonds.ny[b];
      stress += Eigen::Vector3d(lx * f.x(), ly * f.y(), 0.5 * (lx * f.y() + ly * f.x()));
    }
    out.col(k3) = stress / (a.packing.period.x * a.packing.period.y * a.thickness);
  }
  return out;
}

Assembly random_cell() {
  const Packing p = packings::random_jammed({.length = 1.5e-3, .width = 1.2e-3, .discs = 40, .seed = 3});
  return make_assembly(p, bonds_within_gap(p, 0.4 * mean_radius(p)), 1.0, test::kDensity, RattlerRule::peel);
}

/// Forces are right to 1e-12 of themselves; the cell's condition adds some hundreds.
TEST(ExtremeMaterial, IsTheDenseSolutionOfARandomCell) {
  const Assembly a = random_cell();
  for (const test::Law& law : test::kLaws) {
    for (const auto& [m, softness] : {std::pair{Material{0.4999999, Plane::strain}, 0.25}, {Material{-0.9999999, Plane::stress}, 0.25},
                                      {Material{0.3, Plane::stress}, 1e-6}, {Material{0.3, Plane::stress}, 1e3}}) {
      const LatticeCase c = with(law, m, softness, 0.3);
      const PlaneStiffness exact = dense_stiffness(a, c), found = homogenise_cell(a, c.contact(), c.deformation());
      EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-9 * exact.cwiseAbs().maxCoeff()) << c.description();
    }
  }
}

/// Soft discs in a long strip with free edges, which bends easily: the stiffness becomes that of the discs, EA ~ E_p, to 1/softness.
TEST(ExtremeMaterial, OfSoftDiscsInASlenderStrip) {
  const Assembly a = test::hexagonal_assembly({.columns = 120, .rows = 3, .radius = 1e-4});
  for (const test::Law& law : {test::kLaws[2], test::kLaws[3]}) {
    const auto scaled = [&](double softness) {
      const LatticeCase c = with(law, {0.3, Plane::stress}, softness, 0.3);
      return pull_strip(a, c.contact(), c.deformation(), 1.2e-4).axial_stiffness * softness;
    };
    const double exact = scaled(1e4);
    for (const double softness : {1e5, 1e6}) EXPECT_NEAR(scaled(softness) / exact, 1.0, 1e-2) << law.name;
  }
}

/// Near the limit too the derivative is that of the moduli: differences of step h err by h^2 and 1e-12/h.
TEST(ExtremeMaterial, RatesAreDifferences) {
  const Assembly a = random_cell();
  const Parameter parameter[] = {Parameter::particle_poisson_ratio};
  constexpr double h = 1e-5;
  for (const Material& m : {Material{0.4999, Plane::strain}, Material{-0.9999, Plane::stress}, Material{0.9999, Plane::stress}}) {
    const auto at = [&](double nu) {
      const LatticeCase c = with(test::kFull, {nu, m.plane}, 0.5, 0.3);
      return homogenise_with_rates(a, c.contact(), c.deformation(), 0.0, parameter);
    };
    const StiffnessRates here = at(m.poisson_ratio);
    const PlaneStiffness difference = (at(m.poisson_ratio + h).stiffness - at(m.poisson_ratio - h).stiffness) / (2.0 * h);
    EXPECT_LT((here.rates[0] - difference).cwiseAbs().maxCoeff(), 1e-6 * here.stiffness.cwiseAbs().maxCoeff()) << m.poisson_ratio;
    EXPECT_GT(here.rates[0].cwiseAbs().maxCoeff(), 1e-2 * here.stiffness.cwiseAbs().maxCoeff()) << m.poisson_ratio;
  }
}

}  // namespace
}  // namespace ddem
