// Closed forms against the homogenisation of one disc of the hexagonal lattice, written out here.

#include "harness/references/effective_moduli.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace ddem::references {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr ContactModel models[] = {ContactModel::dem, ContactModel::ddem_normal, ContactModel::ddem_full,
                                   ContactModel::ddem_normal_only_stress};

Matrix2d tensor(const Vector3d& v) {
  return (Matrix2d() << v[0], v[2], v[2], v[1]).finished();
}

/// Macroscopic stress (per unit thickness) of the lattice of discs of radius r strained by eps, disc strain
/// eps_p; also the disc's stress. By symmetry all discs strain alike and do not rotate.
struct CellStress {
  Matrix2d macroscopic = Matrix2d::Zero(), particle = Matrix2d::Zero();
};

CellStress cell_stress(ContactModel model, const Contact& contact, const Matrix2d& eps,
                       const Matrix2d& eps_p) {
  const double r = 0.7, area = 2.0 * std::numbers::sqrt3 * r * r, disc = std::numbers::pi * r * r;
  CellStress stress;
  for (int b = 0; b < 6; ++b) {
    const double angle =
        b * std::numbers::pi / 3.0 + 0.1;  // the lattice is isotropic: any orientation will do
    const Vector2d n(std::cos(angle), std::sin(angle)), t(-n.y(), n.x());
    double u_n = 2.0 * r * n.dot(eps * n), u_t = 2.0 * r * t.dot(eps * n);
    if (model != ContactModel::dem) u_n -= 2.0 * r * n.dot(eps_p * n);
    if (model == ContactModel::ddem_full) u_t -= 2.0 * r * t.dot(eps_p * n);
    const Vector2d normal = contact.normal_stiffness * u_n * n;
    const Vector2d force = normal + contact.stiffness_ratio * contact.normal_stiffness * u_t * t;
    stress.macroscopic += r * n * force.transpose() / area;  // half of each of six bonds
    const bool normal_only = model == ContactModel::ddem_normal_only_stress;
    stress.particle += r * n * (normal_only ? normal : force).transpose() / disc;
  }
  return stress;
}

/// Solves eps_p = D sigma_p(eps, eps_p), linear in eps_p, and returns the macroscopic stress.
Matrix2d homogenised(ContactModel model, const Contact& contact, const PlaneConstants& material,
                     const Matrix2d& eps) {
  const auto strain_of = [&](const Matrix2d& s) {  // plane compliance, symmetrised
    const double E = material.young_modulus, nu = material.poisson_ratio;
    return Vector3d((s(0, 0) - nu * s(1, 1)) / E, (s(1, 1) - nu * s(0, 0)) / E,
                    (1.0 + nu) / E * 0.5 * (s(0, 1) + s(1, 0)));
  };
  const auto residual = [&](const Vector3d& e) {
    return Vector3d(e - strain_of(cell_stress(model, contact, eps, tensor(e)).particle));
  };
  const Vector3d at_zero = residual(Vector3d::Zero());
  Eigen::Matrix3d jacobian;
  for (int c = 0; c < 3; ++c) jacobian.col(c) = residual(Vector3d::Unit(c)) - at_zero;
  const Vector3d eps_p = jacobian.fullPivLu().solve(-at_zero);
  return cell_stress(model, contact, eps, tensor(eps_p)).macroscopic;
}

TEST(EffectiveModuli, HexagonalLatticeEqualsItsHomogenisation) {
  // Both are a few dozen operations on numbers of order 1: 1e-13 relative leaves room for the condition of
  // the 3x3 solve (below 20 for these particles).
  const Matrix2d dilation = Matrix2d::Identity(), shear = tensor({1.0, -1.0, 0.5});
  for (const ContactModel model : models)
    for (const double lambda : {0.0, 0.3, 1.0})
      for (const double softness : {0.01, 0.25, 5.0})
        for (const double nu : {0.0, 0.3, 0.49}) {
          const Contact contact{3e9, lambda};
          const PlaneConstants material{3e9 / softness, nu};
          const PlaneModuli closed = effective_moduli(model, hexagonal_fabric(), contact, {material, 1.0});
          const Matrix2d isotropic = homogenised(model, contact, material, dilation);
          const Matrix2d deviatoric = homogenised(model, contact, material, shear);
          EXPECT_NEAR(isotropic(0, 0) / (2.0 * closed.bulk), 1.0, 1e-13);
          EXPECT_NEAR(deviatoric(0, 0) / (2.0 * closed.shear), 1.0, 1e-13);
          EXPECT_NEAR(deviatoric(0, 1) / closed.shear, 1.0, 1e-13);
        }
}

TEST(EffectiveModuli, KnownValues) {
  // DEM, lambda = 0: E = 4KG/(K+G) with K = A/4, G = A/8: A/3 = 2 k_n/sqrt(3), nu = 1/3; E/k_n = 1.1547.
  const Contact contact{1e10, 0.0};
  const PlaneConstants dem =
      plane_constants(effective_moduli(ContactModel::dem, hexagonal_fabric(), contact, {{1e12, 0.3}, 1.0}));
  EXPECT_NEAR(dem.young_modulus / (2e10 / std::numbers::sqrt3), 1.0, 1e-14);
  EXPECT_NEAR(dem.poisson_ratio, 1.0 / 3.0, 1e-14);
  // Calibration example: E = 30e9, nu = 0.25 from lambda = 0.2, k_n = 2.30940108e10 (nine digits).
  const PlaneConstants target = plane_constants(
      effective_moduli(ContactModel::dem, hexagonal_fabric(), {2.30940108e10, 0.2}, {{1e12, 0.3}, 1.0}));
  EXPECT_NEAR(target.young_modulus / 30e9, 1.0, 3e-9);
  EXPECT_NEAR(target.poisson_ratio, 0.25, 1e-14);
  // Implicit DDEM, lambda = 0, nu_p = 0.49, k_n/E_p = 10: 0.479 (three digits).
  const PlaneConstants soft = plane_constants(
      effective_moduli(ContactModel::ddem_normal, hexagonal_fabric(), contact, {{1e9, 0.49}, 1.0}));
  EXPECT_NEAR(soft.poisson_ratio, 0.479, 5e-4);
}

TEST(EffectiveModuli, LimitsOfSoftAndOfStiffParticles) {
  const Contact contact{1e9, 0.4};
  const PlaneModuli dem = effective_moduli(ContactModel::dem, hexagonal_fabric(), contact, {{1.0, 0.0}, 1.0});
  for (const ContactModel model : models) {
    const PlaneModuli stiff = effective_moduli(model, hexagonal_fabric(), contact, {{1e25, 0.3}, 1.0});
    EXPECT_NEAR(stiff.bulk / dem.bulk, 1.0, 1e-14);
    EXPECT_NEAR(stiff.shear / dem.shear, 1.0, 1e-14);
  }
  // F, k_n/E_p = 1e6: the assembly is the material of the discs times the solid fraction, nu -> nu_p.
  const PlaneConstants soft = plane_constants(
      effective_moduli(ContactModel::ddem_full, hexagonal_fabric(), contact, {{1e3, 0.3}, 1.0}));
  EXPECT_NEAR(soft.poisson_ratio, 0.3, 2e-6);
  EXPECT_NEAR(soft.young_modulus / (1e3 * hexagonal_fabric().solid_fraction), 1.0, 2e-6);
}

TEST(EffectiveModuli, ThicknessAndPlaneStrain) {
  // Moduli in Pa depend on k_n/h only.
  const PlaneConstants material = plane_strain_constants(7e9, 0.22);
  EXPECT_NEAR(material.young_modulus, 7e9 / (1.0 - 0.0484), 1.0);
  EXPECT_NEAR(material.poisson_ratio, 0.22 / 0.78, 1e-15);
  for (const ContactModel model : models) {
    const PlaneModuli thick = effective_moduli(model, hexagonal_fabric(), {3e9, 0.37}, {material, 0.002});
    const PlaneModuli unit =
        effective_moduli(model, hexagonal_fabric(), {3e9 / 0.002, 0.37}, {material, 1.0});
    EXPECT_NEAR(thick.bulk / unit.bulk, 1.0, 1e-14);
    EXPECT_NEAR(thick.shear / unit.shear, 1.0, 1e-14);
  }
}

TEST(EffectiveModuli, RandomFabricOfAHexagonalPatchIsTheLattice) {
  // A periodic patch of n x n touching discs: 3 bonds of length 2r and 2 sqrt(3) r^2 of area a disc.
  const double r = 1.3e-4;
  constexpr std::size_t discs = 49;
  const Fabric fabric = random_fabric(std::vector<double>(3 * discs, 2.0 * r), std::vector<double>(discs, r),
                                      discs * 2.0 * std::numbers::sqrt3 * r * r);
  EXPECT_NEAR(fabric.length_squares_per_area, hexagonal_fabric().length_squares_per_area, 1e-13);
  EXPECT_NEAR(fabric.solid_fraction, hexagonal_fabric().solid_fraction, 1e-13);
}

TEST(EffectiveModuli, ChainInSeriesWithItsDiscs) {
  // F = k (u - 2 r eps_p), eps_p = 2 r F/(pi r^2 E h): F = k u/(1 + 4 k/(pi E h)).
  EXPECT_NEAR(chain_stiffness(1e9, 4e9, 1.0) / 1e9, 1.0 / (1.0 + 1.0 / std::numbers::pi), 1e-15);
  EXPECT_NEAR(chain_stiffness(1e9, 4e9, 0.5) / 1e9, 1.0 / (1.0 + 2.0 / std::numbers::pi), 1e-15);
}

TEST(PlaneElasticity, ConversionsAndWaveSpeeds) {
  const PlaneModuli moduli = plane_moduli({30e9, 0.25});
  const PlaneConstants back = plane_constants(moduli);
  EXPECT_NEAR(back.young_modulus, 30e9, 1e-4);
  EXPECT_NEAR(back.poisson_ratio, 0.25, 1e-15);
  // Aluminium-like plate: c_bar^2 = E/rho, c_p^2 = E/(rho (1 - nu^2)), c_s^2 = E/(2 rho (1 + nu)).
  const BulkWaveSpeeds c = bulk_wave_speeds(moduli, 2000.0);
  EXPECT_NEAR(c.bar, std::sqrt(15e6), 1e-9);
  EXPECT_NEAR(c.p, std::sqrt(15e6 / (1.0 - 0.0625)), 1e-9);
  EXPECT_NEAR(c.shear, std::sqrt(15e6 / 2.5), 1e-9);
}

TEST(EffectiveModuli, RefuseWhatIsNoMaterial) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto moduli = [](Contact contact, Disc disc) {
    return effective_moduli(ContactModel::ddem_full, hexagonal_fabric(), contact, disc);
  };
  EXPECT_THROW(moduli({0.0, 0.1}, {{1e9, 0.3}, 1.0}), std::invalid_argument);
  EXPECT_THROW(moduli({1e9, -0.1}, {{1e9, 0.3}, 1.0}), std::invalid_argument);
  EXPECT_THROW(moduli({1e9, nan}, {{1e9, 0.3}, 1.0}), std::invalid_argument);
  EXPECT_THROW(moduli({1e9, 0.1}, {{1e9, 1.0}, 1.0}), std::invalid_argument);
  EXPECT_THROW(moduli({1e9, 0.1}, {{nan, 0.3}, 1.0}), std::invalid_argument);
  EXPECT_THROW(moduli({1e9, 0.1}, {{1e9, 0.3}, 0.0}), std::invalid_argument);
  EXPECT_THROW(plane_strain_constants(1e9, 0.5), std::invalid_argument);
  EXPECT_THROW(plane_constants({1e9, nan}), std::invalid_argument);
  EXPECT_THROW(bulk_wave_speeds({1e9, 1e9}, 0.0), std::invalid_argument);
  EXPECT_THROW(random_fabric({}, {}, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::references
