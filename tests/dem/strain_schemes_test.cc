// What distinguishes the schemes: implicit strains allow any softness and lose no energy, lagged ones damp, and an even
// number of lagged evaluations feeds (theory section 3).

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/kernel/sliced_bonds.h"
#include "dem/simulation/conjugate_gradients.h"
#include "dem/simulation/simulation.h"
#include "dem/spectra/strain_polynomial.h"
#include "dem/spectra/spectra.h"
#include "dem/statics/operators.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using test::kNormalStiffness;

Assembly lattice() {
  return test::hexagonal_assembly({.columns = 16, .rows = 16, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
}

SimulationInput noise_input(const Assembly& a, const DeformationParameters& d, double fraction, long steps) {
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.5, Kinematics::linear};
  in.deformation = d;
  in.time_step = fraction * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = steps;
  in.initial.ux = test::Noise(3).vector(a.size(), 1e-9);
  in.initial.uy = test::Noise(4).vector(a.size(), 1e-9);
  return in;
}

TEST(ImplicitStrains, NoGrowthAtAnySoftness) {
  const Assembly free = test::random_free_strip(), periodic = lattice();
  for (const Assembly* a : {&free, &periodic}) {
    for (const double softness : {0.01, 1.0, 100.0}) {
      const DeformationParameters d{Scheme::implicit, Correction::full, kNormalStiffness / softness, 0.3, Plane::stress};
      const SimulationResult r = simulate(*a, noise_input(*a, d, 0.9, 1000));
      ASSERT_FALSE(r.breakdown.has_value()) << softness;
      EXPECT_LT(r.energy_drift.value(), 1e-12) << softness;
    }
  }
}

/// Relative error of the moduli with the strains of the polynomial instead of converged ones, at the displacements of static
/// equilibrium: those of the energy, which change with the stiffness to second order only.
double error_of_moduli(const Assembly& a, const ContactParameters& contact, const DeformationParameters& d, std::size_t most_terms) {
  const StaticSolver statics(a, contact, d, {});
  const Operators op = make_operators(a, contact, d);
  const SparseMatrix skg = op.stress * SparseMatrix(op.stiffness.asDiagonal() * op.strain_overlap);
  const Eigen::SimplicialLLT<SparseMatrix> vc(op.strain_stiffness);
  const std::vector<double> weights = strain_relaxations(strain_spectrum(a, contact, d), d.tolerance);
  EXPECT_LE(weights.size(), most_terms);
  double worst = 0.0;
  for (const MacroStrain& e : {MacroStrain{1, 0, 0}, MacroStrain{0, 1, 0}, MacroStrain{0, 0, 1}, MacroStrain{1, 1, 0}, MacroStrain{1, -1, 0}}) {
    const StaticState state = statics.solve(e);
    const Eigen::VectorXd overlaps = affine_overlaps(a, op, e) + op.overlap * state.fluctuation;
    const Eigen::VectorXd forces = op.stiffness.cwiseProduct(overlaps), load = op.stress * forces;
    Eigen::VectorXd eps = Eigen::VectorXd::Zero(load.size());
    for (const double w : weights) eps += w * (vc.solve(load - skg * eps) - eps);
    const auto energy = [&](const Eigen::VectorXd& strain) { return forces.dot(overlaps - op.strain_overlap * strain); };
    worst = std::max(worst, std::abs(energy(eps) / energy(vc.solve(op.stress * state.bond_forces)) - 1.0));
  }
  return worst;
}

TEST(ImplicitStrains, ModuliWithinTheToleranceInFewTerms) {
  const Assembly lattice = test::hexagonal_assembly({.columns = 8, .rows = 6, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
  for (const Correction c : {Correction::full, Correction::normal_only_stress}) {
    for (const double nu : {0.3, 0.45}) {
      const DeformationParameters d{Scheme::implicit, c, 4.0 * kNormalStiffness, nu, Plane::stress};
      for (const double lambda : {0.0, 0.25, 0.5, 1.0}) {
        const ContactParameters contact{kNormalStiffness, lambda, Kinematics::linear};
        // The modes of uniform strain are two. At lambda = 1 two terms leave other motions beyond 0.01, and all are bounded alike.
        EXPECT_LT(error_of_moduli(lattice, contact, d, lambda == 1.0 ? 4 : 2), lambda == 1.0 ? d.tolerance : 1e-8) << lambda;
        for (const int seed : {1, 2}) {
          EXPECT_LT(error_of_moduli(test::random_cell(seed), contact, d, lambda < 0.5 ? 3 : 4), d.tolerance) << lambda << " " << seed;
        }
      }
    }
  }
}

TEST(ImplicitStrains, ModuliWithinTheToleranceForSoftDiscs) {
  for (const double softness : {1.0, 10.0}) {
    const DeformationParameters d{Scheme::implicit, Correction::full, kNormalStiffness / softness, 0.3, Plane::stress};
    EXPECT_LT(error_of_moduli(test::random_cell(1), {kNormalStiffness, 0.5, Kinematics::linear}, d, 21), d.tolerance) << softness;
  }
}

/// How a run of implicit strains ends that cannot go on.
std::optional<Breakdown> breakdown_of(const DeformationParameters& d) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = noise_input(a, d, 0.5, 10);
  return simulate(a, in).breakdown;
}

TEST(ImplicitStrains, SayWhereTheyFail) {
  DeformationParameters d{Scheme::implicit, Correction::full, kNormalStiffness, 0.3, Plane::stress};
  d.solver = StrainSolver::conjugate_gradients;
  d.tolerance = 1e-8;
  EXPECT_FALSE(breakdown_of(d));
  // A material of negative stiffness has no minimum.
  d.young_modulus = -0.01 * kNormalStiffness;
  const auto indefinite = breakdown_of(d);
  ASSERT_TRUE(indefinite);
  EXPECT_EQ(indefinite->cause, Breakdown::Cause::strains_indefinite);
}

TEST(ImplicitStrains, BothSolversGiveTheSameMotion) {
  // To 1e-11 of the stiffness of long waves, 1e-9 of others; 500 steps from noise turn some radians. Without shear stiffness
  // bonds read what their ends press in a few discs, and strains in many (stepper_sweeps.cc).
  struct Case {
    Assembly assembly;
    double softness, stiffness_ratio;
  };
  const Assembly strip = test::random_free_strip(), many = test::hexagonal_assembly({.columns = 100, .rows = 30, .radius = 1e-4});
  for (const auto& [a, softness, ratio] : {Case{strip, 0.25, 0.5}, Case{strip, 5.0, 0.5}, Case{strip, 0.25, 0.0}, Case{many, 0.25, 0.0}}) {
    DeformationParameters d{Scheme::implicit, Correction::full, kNormalStiffness / softness, 0.3, Plane::stress};
    d.tolerance = 1e-11;
    SimulationInput in = noise_input(a, d, 0.3, 500);
    in.contact.stiffness_ratio = ratio;
    const std::vector<double> polynomial = simulate(a, in).final_state.ux;
    in.deformation.solver = StrainSolver::conjugate_gradients;
    const std::vector<double> gradients = simulate(a, in).final_state.ux;
    double difference = 0.0, size = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      difference = std::max(difference, std::abs(polynomial[k] - gradients[k]));
      size = std::max(size, std::abs(polynomial[k]));
    }
    EXPECT_LT(difference / size, 1e-8) << softness << " " << ratio << " " << a.size();
  }
}

TEST(ImplicitStrains, IterationThatStallsIsAStatus) {
  // The class alone, with products as a kernel would leave them: the residual never falls.
  ConjugateGradients gradients(kLanes, {1.0, -0.3, 1.3}, 1e-8);
  StepData data{};
  gradients.bind(data);
  Stage stage = Stage::residual;
  for (int n = 0; n < 10000 && !gradients.breakdown(); ++n) {
    for (int p = 0; p < kLanes; ++p) data.product[p] = p == 5 ? 2.0 : 1.0, data.scale[p] = 1.0;
    stage = gradients.next(stage, data);
  }
  ASSERT_TRUE(gradients.breakdown());
  EXPECT_EQ(gradients.breakdown()->cause, StrainBreakdown::Cause::not_converged);
  EXPECT_EQ(gradients.breakdown()->place, 5);
  EXPECT_EQ(stage, Stage::motion);
}

TEST(LaggedStrains, DivergeBeyondTheirLimit) {
  const Assembly a = lattice();
  const DeformationParameters d{Scheme::lagged, Correction::full, kNormalStiffness, 0.3, Plane::stress};
  EXPECT_TRUE(simulate(a, noise_input(a, d, 0.2, 2000)).breakdown.has_value());
}

/// Amplitude of a plane shear wave with wave vector along x, one wavelength over the lattice, after `steps`, over what it
/// was: growth of the largest displacement over a period.
double amplitude_ratio(int evaluations, double relaxation, Scheme scheme) {
  const Assembly a = lattice();
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.5, Kinematics::linear};
  in.deformation = {scheme, Correction::full, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  in.deformation.evaluations = evaluations;
  in.deformation.relaxation = relaxation;
  in.time_step = 0.1 * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = 6000;
  const double k = 2.0 * std::numbers::pi / a.packing.period.x;
  for (std::size_t d = 0; d < a.size(); ++d) in.initial.uy.push_back(1e-9 * std::cos(k * a.packing.x[d]));
  in.receivers = {{{0}}};
  const std::vector<double> u = simulate(a, in).signals.uy[0];
  const auto largest = [&](std::size_t from, std::size_t to) {
    double m = 0.0;
    for (std::size_t n = from; n < to; ++n) m = std::max(m, std::abs(u[n]));
    return m;
  };
  return largest(5000, 6000) / largest(0, 1000);
}

TEST(LaggedStrains, DampWithOneEvaluationAndFeedWithTwo) {
  const double one = amplitude_ratio(1, 1.0, Scheme::lagged), two = amplitude_ratio(2, 1.0, Scheme::lagged);
  const double implicit = amplitude_ratio(1, 1.0, Scheme::implicit);
  EXPECT_LT(one, 0.99);
  EXPECT_GT(two, 1.002);
  EXPECT_NEAR(implicit, 1.0, 1e-3);
}

}  // namespace
}  // namespace ddem
