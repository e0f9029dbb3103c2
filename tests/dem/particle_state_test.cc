// Stress and strain of the discs, bond by bond stiffness, and the volume of the mean stress, against closed forms.

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/assembly/bond_stiffness.h"
#include "dem/simulation/simulation.h"
#include "dem/spectra/spectra.h"
#include "dem/statics/moduli.h"
#include "dem/statics/operators.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using test::kDensity;
using test::kNormalStiffness;

Assembly cell() {
  return test::hexagonal_assembly({.columns = 8, .rows = 8, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
}

/// Two discs of radii 1 mm and 3 mm that touch, and a third like the first: a chain along x.
Assembly chain() {
  Packing p;
  p.x = {0.0, 4e-3, 8e-3};
  p.y = {0.0, 0.0, 0.0};
  p.radius = {1e-3, 3e-3, 1e-3};
  p.length = 10e-3;
  p.width = 6e-3;
  return make_assembly(p, bonds_between(p, std::vector<std::pair<int, int>>{{0, 1}, {1, 2}}), 1.0, kDensity);
}

TEST(ContactModulus, HarmonicMeanOfTheRadii) {
  const Assembly a = chain();
  // E_c 2 r_i r_j / (r_i + r_j) = 2 GPa * 2 * 3 / 4 mm.
  const std::vector<double> k = normal_stiffnesses(a, {0.0, 0.0, Kinematics::linear, 2e9});
  EXPECT_NEAR(k[0], 3e6, 1e-6);
  EXPECT_NEAR(k[1], 3e6, 1e-6);
}

TEST(ContactModulus, EqualDiscsHaveTheUniformStiffness) {
  const Assembly a = cell();
  const ContactParameters uniform{kNormalStiffness, 0.37, Kinematics::linear}, modulus{0.0, 0.37, Kinematics::linear, kNormalStiffness / 1e-4};
  const DeformationParameters d{Scheme::implicit, Correction::full, 7e9, 0.22, Plane::stress};
  const PlaneStiffness x = homogenise_cell(a, uniform, d), y = homogenise_cell(a, modulus, d);
  EXPECT_LT((x - y).norm() / x.norm(), 1e-12);
}

TEST(ContactModulus, TwoDiscsOscillateAtTheReducedMass) {
  // Three discs in a line, the outer ones alike, in the symmetric mode: the middle one rests, omega^2 = k_n / m.
  const Assembly a = chain();
  SimulationInput in;
  in.contact = {0.0, 0.0, Kinematics::linear, 2e9};
  const double omega = std::sqrt(3e6 / a.mass[0]);
  in.time_step = 0.01 / omega;
  in.steps = 100;
  in.initial.ux = {-1e-9, 0.0, 1e-9};
  const InitialState s = simulate(a, in).final_state;
  // Leapfrog: cos(n phi), sin(phi / 2) = omega dt / 2.
  const double phi = 2.0 * std::asin(0.005);
  EXPECT_NEAR(s.ux[0], -1e-9 * std::cos(100 * phi), 1e-20);
  EXPECT_NEAR(s.ux[2], 1e-9 * std::cos(100 * phi), 1e-20);
}

TEST(ParticleVolume, CellsGiveTheSolidAsTheBondsHarden) {
  // With cells that fill the plane and bonds much stiffer than the discs, the assembly is a solid of the discs' material:
  // F gives E -> E_p, nu -> nu_p (closed forms with solid fraction 1). The rest is of the order E_p / k_n.
  const Assembly a = cell();
  DeformationParameters d{Scheme::implicit, Correction::full, 1e-6 * kNormalStiffness, 0.3, Plane::stress};
  d.volume = ParticleVolume::cell;
  const IsotropicModuli m = isotropic_part(homogenise_cell(a, {kNormalStiffness, 0.5, Kinematics::linear}, d));
  EXPECT_NEAR(m.young() / d.young_modulus, 1.0, 5e-6);
  EXPECT_NEAR(m.poisson(), 0.3, 5e-6);
  d.volume = ParticleVolume::disc;
  const double solid = std::numbers::pi / (2.0 * std::numbers::sqrt3);
  EXPECT_NEAR(isotropic_part(homogenise_cell(a, {kNormalStiffness, 0.5, Kinematics::linear}, d)).young() / d.young_modulus, solid, 5e-6);
}

TEST(SoftDiscs, DrawARandomPackingToTheirOwnPoissonRatio) {
  // F and k_n/E_p without bound: the bonds hold, the discs give, and nu -> nu_p. Exactly so on the lattice; in a random
  // packing the voids are not all alike, which leaves some 1e-4. Discs as stiff as the bonds are hundredths away.
  const Packing p = test::oracle_packing("packings/p682_s1.csv", {16.5e-3, 2e-3}, 16.5e-3, 2e-3);
  const Assembly a = make_assembly(p, bonds_within_gap(p, 0.6 * mean_radius(p)), 1.0, kDensity, RattlerRule::peel);
  for (const double nu_p : {0.1, 0.45}) {
    const auto away = [&](double softness) {
      const DeformationParameters d{Scheme::implicit, Correction::full, kNormalStiffness / softness, nu_p, Plane::stress};
      return isotropic_part(homogenise_cell(a, {kNormalStiffness, 0.25, Kinematics::linear}, d)).poisson() - nu_p;
    };
    EXPECT_LT(std::abs(away(1e4)), 1e-3) << nu_p;
    EXPECT_GT(std::abs(away(1.0)), 1e-2) << nu_p;
  }
}

/// One step from rest under a uniform strain of the lattice: what the snapshot says of it.
Snapshot strained(const DeformationParameters& d, double exx, double eyy) {
  const Assembly a = test::hexagonal_assembly({.columns = 12, .rows = 12, .radius = 1e-4});
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.5, Kinematics::linear};
  in.deformation = d;
  in.deformation.tolerance = 1e-12;
  in.time_step = 0.1 * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = 1;
  in.snapshots = 1;
  for (std::size_t p = 0; p < a.size(); ++p) {
    in.initial.ux.push_back(exx * a.packing.x[p]);
    in.initial.uy.push_back(eyy * a.packing.y[p]);
  }
  return simulate(a, in).snapshots.at(0);
}

TEST(ParticleFields, StressAndStrainOfAnIsotropicExpansion) {
  // Inside the lattice, under the strain e in both directions: 2K of theory section 2 times 2e is the macroscopic stress,
  // the stress of a disc is that over the solid fraction, and its strain the disc's own compliance times it.
  const double e = 1e-6, solid = std::numbers::pi / (2.0 * std::numbers::sqrt3), A = 2.0 * std::numbers::sqrt3 * kNormalStiffness;
  const int inside = 12 * 6 + 6;
  const Snapshot rigid = strained({}, e, e);
  EXPECT_NEAR(rigid.stress.xx[inside] / (0.5 * A * e / solid), 1.0, 1e-12);
  EXPECT_NEAR(rigid.stress.yy[inside] / (0.5 * A * e / solid), 1.0, 1e-12);
  EXPECT_TRUE(rigid.strain.xx.empty());

  const DeformationParameters d{Scheme::implicit, Correction::full, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  const Snapshot soft = strained(d, e, e);
  const double twice_k_p = d.young_modulus / (1.0 - 0.3), stress = 0.5 * A / (1.0 + A / (2.0 * solid * twice_k_p)) * e / solid;
  // Free edges are six rows away; the strains' equation couples neighbours by less than a tenth a row.
  EXPECT_NEAR(soft.stress.xx[inside] / stress, 1.0, 1e-4);
  EXPECT_NEAR(soft.strain.xx[inside] / (stress / twice_k_p), 1.0, 1e-4);
  EXPECT_NEAR(soft.strain.xy[inside] / soft.strain.xx[inside], 0.0, 1e-4);
}

TEST(ImplicitOperator, StrainsCoupleSymmetrically) {
  // B = G (V C)^-1 S: symmetric for the corrections that derive from an energy, by the very matrices of the statics.
  const Assembly a = test::random_free_strip();
  const auto asymmetry = [&](Correction c) {
    const Operators op = make_operators(a, {kNormalStiffness, 0.5, Kinematics::linear}, {Scheme::implicit, c, 4.0 * kNormalStiffness, 0.3, Plane::stress});
    // The inverse of a block-diagonal matrix, column by column of its three-by-three blocks.
    const Eigen::SimplicialLLT<SparseMatrix> vc(op.strain_stiffness);
    const SparseMatrix b = op.strain_overlap * SparseMatrix(vc.solve(op.stress));
    return SparseMatrix(b - SparseMatrix(b.transpose())).norm() / b.norm();
  };
  EXPECT_LT(asymmetry(Correction::full), 1e-12);
  EXPECT_LT(asymmetry(Correction::normal_only_stress), 1e-12);
  EXPECT_GT(asymmetry(Correction::normal), 1e-2);
}

}  // namespace
}  // namespace ddem
