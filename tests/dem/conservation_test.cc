// Properties that every law and scheme must have: conservation, invariance, reciprocity, the same bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "dem/simulation/simulation.h"
#include "dem/simulation/stepper.h"
#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using test::kNormalStiffness;

struct Model {
  std::string name;
  ContactParameters contact;
  DeformationParameters deformation;
};

DeformationParameters lagged(Correction c) { return {Scheme::lagged, c, 4.0 * kNormalStiffness, 0.3, Plane::stress}; }

DeformationParameters implicit(Correction c, double softness = 0.25) {
  return {Scheme::implicit, c, kNormalStiffness / softness, 0.3, Plane::stress};
}

DeformationParameters by_gradients(Correction c, double softness, double tolerance) {
  DeformationParameters d = implicit(c, softness);
  d.solver = StrainSolver::conjugate_gradients;
  d.tolerance = tolerance;
  return d;
}

DeformationParameters in_cells(DeformationParameters d) {
  d.volume = ParticleVolume::cell;
  return d;
}

/// One line a law or scheme.
std::vector<Model> models() {
  const ContactParameters k0{kNormalStiffness, 0.0, Kinematics::linear}, k5{kNormalStiffness, 0.5, Kinematics::linear};
  const ContactParameters modulus0{0.0, 0.0, Kinematics::linear, 1e14}, modulus5{0.0, 0.5, Kinematics::linear, 1e14};
  const ContactParameters n0{kNormalStiffness, 0.0, Kinematics::nonlinear}, n5{kNormalStiffness, 0.5, Kinematics::nonlinear};
  return {{"dem_frictionless", k0, {}},
          {"dem", k5, {}},
          {"dem_frictionless_nonlinear", n0, {}},
          {"dem_nonlinear", n5, {}},
          {"lagged_normal_frictionless", k0, lagged(Correction::normal)},
          {"lagged_normal", k5, lagged(Correction::normal)},
          {"lagged_full", k5, lagged(Correction::full)},
          {"lagged_normal_only_stress", k5, lagged(Correction::normal_only_stress)},
          {"lagged_full_nonlinear", n5, lagged(Correction::full)},
          {"implicit_full_frictionless", k0, implicit(Correction::full)},
          {"implicit_normal", k5, implicit(Correction::normal)},
          {"implicit_full", k5, implicit(Correction::full)},
          {"implicit_normal_only_stress", k5, implicit(Correction::normal_only_stress)},
          {"implicit_full_gradients", k5, by_gradients(Correction::full, 5.0, 1e-10)},
          {"implicit_normal_gradients", k5, by_gradients(Correction::normal, 0.25, 1e-10)},
          {"implicit_full_cells", k5, in_cells(implicit(Correction::full))},
          {"contact_modulus_frictionless", modulus0, {}},
          {"contact_modulus", modulus5, {}},
          {"contact_modulus_nonlinear", {0.0, 0.5, Kinematics::nonlinear, 1e14}, {}},
          {"contact_modulus_lagged_frictionless", modulus0, lagged(Correction::full)},
          {"contact_modulus_lagged_full", modulus5, lagged(Correction::full)},
          {"contact_modulus_implicit_frictionless", modulus0, implicit(Correction::full)},
          {"contact_modulus_implicit_full", modulus5, implicit(Correction::full)}};
}

SimulationInput input_for(const Assembly& a, const Model& m, long steps) {
  SimulationInput in;
  in.contact = m.contact;
  in.deformation = m.deformation;
  in.time_step = 0.3 * 2.0 / largest_frequency(a, m.contact, {});
  in.steps = steps;
  return in;
}

class EveryModel : public testing::TestWithParam<Model> {};
INSTANTIATE_TEST_SUITE_P(Models, EveryModel, testing::ValuesIn(models()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(EveryModel, MomentumOfAFreeAssembly) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = input_for(a, GetParam(), 300);
  test::Noise noise(7);
  in.initial.vx = noise.vector(a.size(), 1e-3);
  in.initial.vy = noise.vector(a.size(), 1e-3);
  const SimulationResult r = simulate(a, in);
  double px = 0, py = 0, px0 = 0, py0 = 0, size = 0;
  for (std::size_t d = 0; d < a.size(); ++d) {
    px0 += a.mass[d] * in.initial.vx[d];
    py0 += a.mass[d] * in.initial.vy[d];
    px += a.mass[d] * r.final_state.vx[d];
    py += a.mass[d] * r.final_state.vy[d];
    size += a.mass[d] * std::abs(in.initial.vx[d]);
  }
  // Both ends of a bond get forces of the same bits; only the sums over 682 discs and 300 steps round.
  EXPECT_LT(std::abs(px - px0) / size, 1e-13);
  EXPECT_LT(std::abs(py - py0) / size, 1e-13);
}

/// Largest acceleration times step that a state causes, as a velocity: one step from rest.
double largest_kick(const Assembly& a, SimulationInput in) {
  in.steps = 1;
  const SimulationResult r = simulate(a, in);
  double v = 0;
  for (std::size_t d = 0; d < a.size(); ++d) {
    v = std::max({v, std::abs(r.final_state.vx[d]), std::abs(r.final_state.vy[d]),
                  std::abs(r.final_state.omega[d]) * a.packing.radius[d]});
  }
  return v;
}

TEST_P(EveryModel, NoForceUnderRigidMotion) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = input_for(a, GetParam(), 1);
  // A rotation is rigid to first order only, so the linear models turn by a small angle and the nonlinear ones exactly.
  const bool linear = GetParam().contact.kinematics == Kinematics::linear;
  const double angle = 1e-7;
  const double cosine_less_1 = linear ? 0.0 : -0.5 * angle * angle, sine = angle;
  for (std::size_t d = 0; d < a.size(); ++d) {
    const double x = a.packing.x[d] - 8e-3, y = a.packing.y[d] - 1e-3;
    in.initial.ux.push_back(1e-8 + cosine_less_1 * x - sine * y);
    in.initial.uy.push_back(-2e-8 + sine * x + cosine_less_1 * y);
    in.initial.theta.push_back(angle);
  }
  const double rigid = largest_kick(a, in);
  // The same displacements without the discs' turning are no rigid motion where there is shear stiffness, and noise
  // of the same size never is.
  SimulationInput other = in;
  test::Noise noise(3);
  other.initial.ux = noise.vector(a.size(), 1e-9);
  EXPECT_LT(rigid, 1e-11 * largest_kick(a, other) * 10.0);
}

TEST_P(EveryModel, SameBitsForEveryThreadCountAndInstructionSet) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = input_for(a, GetParam(), 200);
  in.initial.ux = test::Noise(5).vector(a.size(), 1e-9);
  const SimulationResult one = simulate(a, in);
  for (const int threads : {2, 4}) {
    in.threads = threads;
    const SimulationResult many = simulate(a, in);
    EXPECT_EQ(one.final_state.ux, many.final_state.ux) << threads << " threads";
    EXPECT_EQ(one.final_state.theta, many.final_state.theta) << threads << " threads";
  }
  in.threads = 1;
  for (int isa = 0; isa <= static_cast<int>(best_instruction_set()); ++isa) {
    Stepper stepper(a, in, static_cast<InstructionSet>(isa));
    for (long n = 0; n < in.steps; ++n) {
      do {
        stepper.advance(0);
      } while (!stepper.finish_stage());
    }
    EXPECT_EQ(one.final_state.ux, stepper.state().ux) << "instruction set " << isa;
    EXPECT_EQ(one.final_state.theta, stepper.state().theta) << "instruction set " << isa;
  }
}

/// A driven disc and one that nothing has moved yet: the energy of their bond at t_1 is k_n u(t_1)^2 / 2.
TEST(Energies, OfADrivenDiscAreThoseOfItsTime) {
  Packing p;
  p.x = {1e-4, 3e-4}, p.y = {1e-4, 1e-4}, p.radius = {1e-4, 1e-4};
  p.length = 4e-4, p.width = 2e-4;
  const Assembly a = make_assembly(p, bonds_within_gap(p, 1e-6), 1.0, test::kDensity);
  SimulationInput in;
  in.contact = {test::kNormalStiffness, 0.0, Kinematics::linear};
  in.time_step = 1e-9;
  in.steps = in.energy_samples = 4;
  in.drive = EdgeDrive{{0}, Direction::x, 1e-8, 20.0 * in.time_step};
  const SimulationResult r = simulate(a, in);
  ASSERT_GE(r.energy.size(), 2u);
  EXPECT_DOUBLE_EQ(r.energy[1].time, in.time_step);
  const double u = in.drive->displacement(in.time_step);
  EXPECT_NEAR(r.energy[1].energies.contact, 0.5 * test::kNormalStiffness * u * u, 1e-12 * test::kNormalStiffness * u * u);
}

TEST_P(EveryModel, PermutingDiscsChangesRoundOffOnly) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = input_for(a, GetParam(), 200);
  test::Noise noise(11);
  in.initial.ux = noise.vector(a.size(), 1e-9);
  in.initial.uy = noise.vector(a.size(), 1e-9);
  // Disc d of the one is disc q[d] = 101 d mod 682 of the other (101 and 682 are coprime); the bonds come in the
  // order of the new numbers.
  const std::size_t n = a.size();
  Packing p = a.packing;
  SimulationInput permuted = in;
  std::vector<std::pair<int, int>> pairs;
  const auto q = [n](std::size_t d) { return 101 * d % n; };
  for (std::size_t d = 0; d < n; ++d) {
    p.x[q(d)] = a.packing.x[d];
    p.y[q(d)] = a.packing.y[d];
    p.radius[q(d)] = a.packing.radius[d];
    permuted.initial.ux[q(d)] = in.initial.ux[d];
    permuted.initial.uy[q(d)] = in.initial.uy[d];
  }
  for (std::size_t c = a.bonds.size(); c-- > 0;) {
    pairs.emplace_back(static_cast<int>(q(a.bonds.j[c])), static_cast<int>(q(a.bonds.i[c])));
  }
  const Assembly b = make_assembly(p, bonds_between(p, pairs), 1.0, test::kDensity);
  const auto x = simulate(a, in).final_state.ux, y = simulate(b, permuted).final_state.ux;
  double difference = 0, size = 0;
  for (std::size_t d = 0; d < n; ++d) {
    difference = std::max(difference, std::abs(x[d] - y[q(d)]));
    size = std::max(size, std::abs(x[d]));
  }
  EXPECT_LT(difference / size, 1e-11);
}

TEST(Conservation, LeapfrogInvariantOfDem) {
  const Assembly a = test::random_free_strip();
  for (const double lambda : {0.0, 0.5}) {
    SimulationInput in = input_for(a, {"", {kNormalStiffness, lambda, Kinematics::linear}, {}}, 10000);
    in.initial.ux = test::Noise(2).vector(a.size(), 1e-9);
    const auto drift = simulate(a, in).energy_drift;
    ASSERT_TRUE(drift.has_value());
    EXPECT_LT(*drift, 1e-12) << lambda;
  }
}

TEST(Conservation, LeapfrogInvariantOfImplicitStrains) {
  // A polynomial of a symmetric operator is symmetric however few its terms: the invariant holds to round-off at any
  // tolerance and any softness.
  const Assembly a = test::random_free_strip();
  for (const Correction c : {Correction::full, Correction::normal_only_stress}) {
    for (const double softness : {0.25, 5.0}) {
      DeformationParameters d = implicit(c, softness);
      d.tolerance = 1e-2;
      SimulationInput in = input_for(a, {"", {kNormalStiffness, 0.5, Kinematics::linear}, d}, 10000);
      in.initial.ux = test::Noise(2).vector(a.size(), 1e-9);
      EXPECT_LT(simulate(a, in).energy_drift.value(), 1e-12) << softness;
    }
  }
}

TEST(Conservation, LeapfrogInvariantOfConjugateGradients) {
  // The strains are right to a residual of 1e-10 only, and not by a symmetric operator.
  const Assembly a = test::random_free_strip();
  for (const Correction c : {Correction::full, Correction::normal_only_stress}) {
    SimulationInput in = input_for(a, {"", {kNormalStiffness, 0.5, Kinematics::linear}, by_gradients(c, 0.25, 1e-10)}, 10000);
    in.initial.ux = test::Noise(2).vector(a.size(), 1e-9);
    EXPECT_LT(simulate(a, in).energy_drift.value(), 1e-6);
  }
}

TEST(Conservation, EnergiesAddUpToTheInvariant) {
  // At the time of a step, kinetic, contact and particle energy exceed the invariant by dt^2/8 a' M a, the leapfrog's
  // own: a quarter of it at half the step. Compared at t = 0, where the motion is the same.
  const Assembly a = test::random_free_strip();
  const auto excess = [&](double fraction) {
    SimulationInput in = input_for(a, {"", {kNormalStiffness, 0.5, Kinematics::linear}, implicit(Correction::full)}, 100);
    in.time_step *= fraction;
    in.deformation.tolerance = 1e-10;
    in.initial.ux = test::Noise(2).vector(a.size(), 1e-9);
    in.energy_samples = 100;
    const Energies e = simulate(a, in).energy.at(0).energies;
    EXPECT_NEAR(e.kinetic, 0.0, 1e-14 * e.contact);
    EXPECT_GT(e.particle, 0.01 * e.contact);
    return (e.kinetic + e.contact + e.particle) - e.invariant;
  };
  EXPECT_NEAR(excess(1.0) / excess(0.5), 4.0, 1e-6);
}

TEST(Energies, NotAskedForAreNotTakenAndTheMotionIsTheSame) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = input_for(a, {"", {kNormalStiffness, 0.5, Kinematics::linear}, implicit(Correction::full, 0.25)}, 50);
  in.initial.ux = test::Noise(2).vector(a.size(), 1e-9);
  in.energy_samples = 5;
  const SimulationResult with = simulate(a, in);
  in.energy_samples = 0;
  const SimulationResult without = simulate(a, in);
  EXPECT_GE(with.energy.size(), 5u);
  EXPECT_TRUE(without.energy.empty());
  EXPECT_FALSE(without.energy_drift.has_value());
  EXPECT_EQ(with.final_state.ux, without.final_state.ux);
  EXPECT_EQ(with.final_state.omega, without.final_state.omega);
  in.energy_samples = -1;
  EXPECT_THROW(simulate(a, in), std::invalid_argument);
}

TEST(Conservation, LaggedSchemeLosesEnergy) {
  // theory section 3: the lag is viscosity; a conserved energy would mean that the deformation does nothing.
  const Assembly a = test::random_free_strip();
  SimulationInput in = input_for(a, {"", {kNormalStiffness, 0.5, Kinematics::linear}, lagged(Correction::full)}, 2000);
  in.initial.ux = test::Noise(2).vector(a.size(), 1e-9);
  EXPECT_GT(simulate(a, in).energy_drift.value(), 1e-2);
}

/// m_B u_B(t; impulse at A) = m_A u_A(t; impulse at B): relative violation for impulses along x and responses along y.
double reciprocity_violation(const Assembly& a, const Model& m) {
  const int first = a.bonds.i[0], second = a.bonds.j[0];
  const auto response = [&](int struck, bool along_x, int heard) {
    SimulationInput in = input_for(a, m, 400);
    (along_x ? in.initial.vx : in.initial.vy).assign(a.size(), 0.0);
    (along_x ? in.initial.vx : in.initial.vy)[struck] = 1e-3 / a.mass[struck];
    in.receivers = {{{heard}}};
    const Signals s = simulate(a, in).signals;
    return along_x ? s.uy[0] : s.ux[0];
  };
  const std::vector<double> ab = response(first, true, second), ba = response(second, false, first);
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < ab.size(); ++k) {
    difference = std::max(difference, std::abs(ab[k] - ba[k]));
    size = std::max(size, std::abs(ab[k]));
  }
  return difference / size;
}

TEST(Reciprocity, HoldsForSymmetricSchemesOnly) {
  const Assembly a = test::random_free_strip();
  for (const Model& m : models()) {
    if (m.contact.kinematics == Kinematics::nonlinear) continue;
    // Lagged or converged: the same linear recurrence seen from either side as long as B is symmetric.
    const bool symmetric = m.deformation.correction != Correction::normal || !m.contact.has_rotation() || !m.deformation.active();
    const double violation = reciprocity_violation(a, m);
    if (symmetric) {
      // Conjugate gradients are symmetric up to their residual, here 1e-10 of the strains.
      EXPECT_LT(violation, m.deformation.solver == StrainSolver::polynomial ? 1e-11 : 1e-9) << m.name;
    } else {
      EXPECT_GT(violation, 1e-2) << m.name;  // by per cents: 8 % lagged, 9 % implicit
    }
  }
}

TEST(Divergence, NamesStepAndDisc) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = input_for(a, models()[1], 20000);
  in.time_step *= 1.1 / 0.3;
  in.initial.ux = test::Noise(2).vector(a.size(), 1e-9);
  const SimulationResult r = simulate(a, in);
  ASSERT_TRUE(r.breakdown.has_value());
  EXPECT_LT(r.breakdown->step, 2000);
  EXPECT_EQ(r.steps_done, r.breakdown->step);
  EXPECT_GE(r.breakdown->disc, 0);
  EXPECT_LT(r.breakdown->disc, 682);
}

}  // namespace
}  // namespace ddem
