// The start of a run: what is held is held from the first instant, lagged strains start from rest with any number of
// evaluations, and nonlinear kinematics takes a start that is turned by any angle for what it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dem/simulation/exact.h"
#include "dem/simulation/simulation.h"
#include "dem/spectra/spectra.h"
#include "tests/support/parameters.h"
#include "tests/support/step_matrix.h"

namespace ddem {
namespace {

using test::kNormalStiffness;
using test::linear_contact;
using test::strains;

Assembly lattice() { return test::hexagonal_assembly({.columns = 12, .rows = 5, .radius = 1e-4}); }

SimulationInput input_of(const Assembly& a, const ContactParameters& contact, const DeformationParameters& d, long steps) {
  SimulationInput in;
  in.contact = contact;
  in.deformation = d;
  in.time_step = 0.2 * 2.0 / largest_frequency(a, contact, {});
  in.steps = steps;
  return in;
}

/// Rigid, lagged with one to four evaluations, implicit; with every correction.
std::vector<DeformationParameters> schemes() {
  std::vector<DeformationParameters> all{{}};
  for (const Correction c : {Correction::normal, Correction::full, Correction::normal_only_stress}) {
    all.push_back(strains(Scheme::implicit, c, 0.25));
    for (const double relaxation : {1.0, 0.6}) {
      for (int evaluations = 1; evaluations <= 4; ++evaluations) all.push_back(strains(Scheme::lagged, c, 0.2, evaluations, relaxation));
    }
  }
  return all;
}

HeldDofs held_right(const Assembly& a, bool rotation_too) {
  HeldDofs held;
  for (auto* mask : {&held.x, &held.y, &held.theta}) mask->assign(a.size(), 0);
  for (const int d : edge_discs(a.packing, Edge::right, 1.2e-4)) {
    held.x[d] = 1;
    if (rotation_too) held.y[d] = held.theta[d] = 1;
  }
  return held;
}

TEST(HeldDiscs, DoNotMoveInAnyScheme) {
  const Assembly a = lattice();
  for (const Kinematics kinematics : {Kinematics::linear, Kinematics::nonlinear}) {
    for (const double lambda : {0.0, 0.5}) {
      for (const DeformationParameters& d : schemes()) {
        if (kinematics == Kinematics::nonlinear && d.scheme == Scheme::implicit) continue;
        for (const bool fixed : {false, true}) {
          SimulationInput in = input_of(a, {kNormalStiffness, lambda, kinematics}, d, 30);
          in.held = held_right(a, fixed);
          in.initial.vx = test::Noise(1).vector(a.size(), 1.0), in.initial.vy = test::Noise(2).vector(a.size(), 1.0);
          in.initial.omega = test::Noise(3).vector(a.size(), 1e3);
          for (std::size_t p = 0; p < a.size(); ++p) {
            if (in.held.x[p]) in.initial.vx[p] = 0.0;
            if (in.held.y[p]) in.initial.vy[p] = 0.0;
            if (in.held.theta[p]) in.initial.omega[p] = 0.0;
          }
          const InitialState s = simulate(a, in).final_state;
          for (std::size_t p = 0; p < a.size(); ++p) {
            if (in.held.x[p]) {
              EXPECT_TRUE(s.ux[p] == 0.0 && s.vx[p] == 0.0);
            }
            if (in.held.y[p]) {
              EXPECT_TRUE(s.uy[p] == 0.0 && s.vy[p] == 0.0);
            }
            if (in.held.theta[p]) {
              EXPECT_TRUE(s.theta[p] == 0.0 && s.omega[p] == 0.0);
            }
            if (!in.held.x[p]) {
              EXPECT_NE(s.ux[p], 0.0);
            }
          }
        }
      }
    }
  }
}

TEST(HeldDiscs, AreNotStartedWithAVelocity) {
  const Assembly a = lattice();
  SimulationInput in = input_of(a, linear_contact(0.5), {}, 10);
  in.held = held_right(a, true);
  for (auto* v : {&in.initial.vx, &in.initial.vy, &in.initial.omega}) {
    v->assign(a.size(), 0.0);
    v->at(11) = 1.0;
    EXPECT_THROW(simulate(a, in), std::invalid_argument);
    EXPECT_THROW(simulate_exact(a, in, {1e-8, 10}), std::invalid_argument);
    v->at(11) = 0.0, v->at(10) = 1.0;
    EXPECT_NO_THROW(simulate(a, in));
    v->clear();
  }
}

/// What a drive prescribes, no initial velocity adds to: neither to the motion nor to the energy.
TEST(HeldDiscs, DrivenOnesFollowTheDriveAlone) {
  const Assembly a = lattice();
  SimulationInput in = input_of(a, linear_contact(0.5), {}, 40);
  in.drive = EdgeDrive{edge_discs(a.packing, Edge::left, 1.2e-4), Direction::x, 1e-8, 10.0 * in.time_step};
  const SimulationResult still = simulate(a, in);
  in.initial.vx.assign(a.size(), 0.0);
  for (const int d : in.drive->discs) in.initial.vx[d] = 1.0;
  const SimulationResult struck = simulate(a, in);
  EXPECT_EQ(still.final_state.ux, struck.final_state.ux);
  EXPECT_EQ(still.final_state.vx, struck.final_state.vx);
  EXPECT_EQ(still.energy.back().energies.kinetic, struck.energy.back().energies.kinetic);
}

/// From rest u(dt) = u_0 + dt v_0 + dt^2/2 a_s, a_s the acceleration under the strains that the evaluations of a step make
/// of none, here by the matrices of statics.
TEST(LaggedStart, HasTheForcesOfTheFirstStep) {
  const Assembly a = lattice();
  for (const Kinematics kinematics : {Kinematics::linear, Kinematics::nonlinear}) {
    for (const double lambda : {0.0, 0.5}) {
      for (const DeformationParameters& d : schemes()) {
        if (d.scheme != Scheme::lagged) continue;
        SimulationInput in = input_of(a, {kNormalStiffness, lambda, kinematics}, d, 1);
        // Nonlinear terms are u/r of the linear ones.
        const double size = kinematics == Kinematics::linear ? 1e-7 : 1e-12, speed = size / in.time_step;
        in.initial.ux = test::Noise(1).vector(a.size(), size), in.initial.uy = test::Noise(2).vector(a.size(), size);
        in.initial.vx = test::Noise(3).vector(a.size(), speed), in.initial.vy = test::Noise(4).vector(a.size(), speed);
        const test::LaggedStep step(a, linear_contact(lambda), d);
        const int dofs = step.op.dofs_per_disc;
        Eigen::VectorXd q = Eigen::VectorXd::Zero(step.op.overlap.cols());
        for (std::size_t p = 0; p < a.size(); ++p) q[dofs * static_cast<int>(p)] = in.initial.ux[p], q[dofs * static_cast<int>(p) + 1] = in.initial.uy[p];
        const Eigen::VectorXd acceleration = step.acceleration(q, step.before_force(q, Eigen::VectorXd::Zero(step.op.strain_overlap.cols())));
        const InitialState s = simulate(a, in).final_state;
        const double dt = in.time_step, largest = 0.5 * dt * dt * acceleration.cwiseAbs().maxCoeff();
        for (std::size_t p = 0; p < a.size(); ++p) {
          const int k = dofs * static_cast<int>(p);
          // Displacements of `size` and ten times that are rounded.
          EXPECT_NEAR(s.ux[p], in.initial.ux[p] + dt * in.initial.vx[p] + 0.5 * dt * dt * acceleration[k], 1e-14 * size + 1e-6 * (size < 1e-11) * largest);
          EXPECT_NEAR(s.uy[p], in.initial.uy[p] + dt * in.initial.vy[p] + 0.5 * dt * dt * acceleration[k + 1], 1e-14 * size + 1e-6 * (size < 1e-11) * largest);
        }
      }
    }
  }
}

/// Two bonded discs pulled apart by u: by hand, with b = K B = k_n 2 r^2 / (pi r^2 E_p).
TEST(LaggedStart, OfTwoDiscsByHand) {
  constexpr double r = 1e-4, u = 1e-7, b = 0.25 * 2.0 / std::numbers::pi;
  Packing p;
  p.x = {0.0, 2.0 * r}, p.y = {0.0, 0.0}, p.radius = {r, r}, p.length = 4.0 * r, p.width = 2.0 * r;
  const Assembly a = make_assembly(p, bonds_within_gap(p, 1e-6), 1.0, test::kDensity);
  for (const double w : {1.0, 0.5}) {
    for (int evaluations = 1; evaluations <= 6; ++evaluations) {
      SimulationInput in = input_of(a, linear_contact(0.0), strains(Scheme::lagged, Correction::full, 0.25, evaluations, w), 1);
      in.initial.ux = {0.0, u}, in.initial.uy = {0.0, 0.0};
      double strained = 0.0;  // how far both discs' strains reach
      for (int m = 1; m < evaluations; ++m) strained = (1.0 - w) * strained + w * b * (u - strained);
      const double acceleration = kNormalStiffness * (u - strained) / a.mass[0];
      const double moved = simulate(a, in).final_state.ux[0];
      EXPECT_NEAR(moved / (0.5 * in.time_step * in.time_step * acceleration), 1.0, 1e-12) << evaluations;
    }
  }
}

/// What the start forgets and the steps find anew: the same on threads, with a watch on contacts, and where one is closed.
TEST(LaggedStart, IsTheSameWithThreadsAndWatchedContacts) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = input_of(a, linear_contact(0.5), strains(Scheme::lagged, Correction::full, 0.2, 3), 20);
  in.initial.ux = test::Noise(5).vector(a.size(), 1e-9);
  const SimulationResult plain = simulate(a, in);
  in.new_contacts = ContactWatch::bound, in.threads = 3;
  EXPECT_EQ(simulate(a, in).final_state.ux, plain.final_state.ux);

  // Three discs in a row, the third pressed against by a tenth of the gap: its push belongs to the start as well.
  constexpr double r = 1e-4, gap = 1e-8;
  const Assembly row = test::three_discs(r, gap);
  SimulationInput push = input_of(row, linear_contact(0.0), strains(Scheme::lagged, Correction::normal, 0.2, 3), 1);
  push.initial.ux = {gap, gap, -0.1 * gap}, push.initial.uy = {0.0, 0.0, 0.0};
  push.new_contacts = ContactWatch::bound;
  const double b = kNormalStiffness / (std::numbers::pi * r * r * kNormalStiffness / 0.2);
  // Strain eps_xx of the discs, by the force of the step before; bonds 0-1 (not elongated at first) and the contact 1-2.
  double e0 = 0.0, e1 = 0.0, e2 = 0.0, f01 = 0.0, f12 = 0.0;
  for (int m = 0; m < 3; ++m) {
    f01 = -r * e0 - r * e1, f12 = -0.1 * gap - r * e1 - r * e2;
    e0 = b * r * f01, e1 = b * r * (f01 + f12), e2 = b * r * f12;
  }
  const double unit = 0.5 * push.time_step * push.time_step * kNormalStiffness / row.mass[0];
  const InitialState s = simulate(row, push).final_state;
  // The contact's arms are those of its distance, 5e-5 longer than a radius.
  EXPECT_NEAR((s.ux[0] - gap) / (unit * f01), 1.0, 1e-3);
  EXPECT_NEAR((s.ux[2] + 0.1 * gap) / (unit * -f12), 1.0, 1e-3);
}

struct Turned {
  std::string name;
  double lambda, contact_modulus;
  DeformationParameters deformation;
};

std::vector<Turned> nonlinear_models() {
  return {{"dem_frictionless", 0.0, 0.0, {}},
          {"dem", 0.5, 0.0, {}},
          {"dem_stiff_shear", 1.5, 0.0, {}},
          {"dem_modulus", 0.5, 1e14, {}},
          {"normal", 0.4, 0.0, strains(Scheme::lagged, Correction::normal, 0.2)},
          {"full", 0.5, 0.0, strains(Scheme::lagged, Correction::full, 0.2)},
          {"full_3", 0.5, 0.0, strains(Scheme::lagged, Correction::full, 0.2, 3)},
          {"full_2_relaxed", 0.5, 0.0, strains(Scheme::lagged, Correction::full, 0.2, 2, 0.5)},
          {"normal_only_stress", 0.5, 0.0, strains(Scheme::lagged, Correction::normal_only_stress, 0.2)}};
}

class FiniteRotation : public testing::TestWithParam<Turned> {
 protected:
  SimulationInput input(const Assembly& a, long steps) const {
    return input_of(a, {kNormalStiffness, GetParam().lambda, Kinematics::nonlinear, GetParam().contact_modulus}, GetParam().deformation, steps);
  }
};
INSTANTIATE_TEST_SUITE_P(Models, FiniteRotation, testing::ValuesIn(nonlinear_models()), [](const auto& p) { return p.param.name; });

/// `state` of `a`, turned about a point of the plane together with the assembly.
InitialState turned(const Assembly& a, const InitialState& state, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  InitialState t;
  for (std::size_t p = 0; p < a.size(); ++p) {
    const double x = a.packing.x[p] - 1e-3, y = a.packing.y[p] + 2e-4;
    const auto [ux, uy] = std::pair(x + state.ux[p], y + state.uy[p]);
    t.ux.push_back(c * ux - s * uy - x), t.uy.push_back(s * ux + c * uy - y);
    t.theta.push_back(state.theta[p] + angle);
    t.vx.push_back(c * state.vx[p] - s * state.vy[p]), t.vy.push_back(s * state.vx[p] + c * state.vy[p]);
    t.omega.push_back(state.omega[p]);
  }
  return t;
}

InitialState rest(std::size_t n) {
  const std::vector<double> zero(n, 0.0);
  return {zero, zero, zero, zero, zero, zero};
}

constexpr double kAngles[] = {1e-4, 4e-3, 6e-3, 0.05, 0.15, 0.3, std::numbers::pi / 3.0, 0.5 * std::numbers::pi, -2.0, 3.0, std::numbers::pi, -3.2, 4.5, 7.0, -9.9};

TEST_P(FiniteRotation, OfEverythingLeavesItAtRest) {
  for (const Assembly& a : {lattice(), test::random_free_strip()}) {
    for (const double angle : kAngles) {
      SimulationInput in = input(a, a.size() < 100 ? 400 : 20);
      in.new_contacts = ContactWatch::bound;
      in.initial = turned(a, rest(a.size()), angle);
      const InitialState s = simulate(a, in).final_state;
      // Displacements of up to twice the length, 33 mm, are rounded by 4e-18 m, the forces of a disc's bonds so by some 1e-16
      // k_n m; what oscillates under them moves no faster than the frequency (0.4 / dt) times a few such displacements.
      double px = 0.0, py = 0.0, fastest = 0.0;
      for (std::size_t p = 0; p < a.size(); ++p) {
        px += a.mass[p] * s.vx[p], py += a.mass[p] * s.vy[p];
        fastest = std::max(fastest, std::hypot(s.vx[p], s.vy[p]));
      }
      EXPECT_LT(fastest * in.time_step, 1e-15) << angle;
      EXPECT_LT(std::hypot(px, py) * in.time_step, 1e-16 * a.mass[0]) << angle;
    }
  }
}

TEST_P(FiniteRotation, OfTheFrameTurnsTheMotion) {
  const Assembly a = lattice();
  SimulationInput in = input(a, 100);
  const auto noise = [&](int seed, double size) { return test::Noise(static_cast<std::uint64_t>(seed)).vector(a.size(), size); };
  in.initial = {noise(1, 1e-7), noise(2, 1e-7), noise(3, 1e-3), noise(4, 1.0), noise(5, 1.0), noise(6, 1e4)};
  const InitialState start = in.initial, there = simulate(a, in).final_state;
  for (const double angle : kAngles) {
    in.initial = turned(a, start, angle);
    const InitialState expected = turned(a, there, angle), s = simulate(a, in).final_state;
    double off = 0.0;
    for (std::size_t p = 0; p < a.size(); ++p) off = std::max({off, std::abs(s.ux[p] - expected.ux[p]), std::abs(s.uy[p] - expected.uy[p])});
    // Rounding as above, through a hundred steps; the motion is 1e-7 m.
    EXPECT_LT(off, 1e-7 * 1e-7) << angle;
  }
}

/// A bond that has turned by 60 degrees while its discs have turned by 50 has slipped by 10 degrees of its length.
TEST(FiniteRotations, SlipIsTheTurnOfTheBondLessThatOfItsDiscs) {
  constexpr double r = 1e-4;
  Packing p;
  p.x = {0.0, 2.0 * r}, p.y = {0.0, 0.0}, p.radius = {r, r}, p.length = 4.0 * r, p.width = 2.0 * r;
  const Assembly a = make_assembly(p, bonds_within_gap(p, 1e-6), 1.0, test::kDensity);
  for (const double slip : {0.17, -0.3, 1.5, -3.0}) {
    for (const double turn : {1.0, 2.5, -3.1, 6.0}) {
      SimulationInput in = input_of(a, {kNormalStiffness, 0.5, Kinematics::nonlinear}, {}, 1);
      in.initial.ux = {0.0, 2.0 * r * (std::cos(turn) - 1.0)}, in.initial.uy = {0.0, 2.0 * r * std::sin(turn)};
      in.initial.theta = {turn - slip, turn - slip};
      const InitialState s = simulate(a, in).final_state;
      const double kick = 0.5 * in.time_step * 0.5 * kNormalStiffness * 2.0 * r * slip / a.mass[0];
      EXPECT_NEAR(s.vx[0] / kick, -std::sin(turn), 1e-12);
      EXPECT_NEAR(s.vy[0] / kick, std::cos(turn), 1e-12);
      EXPECT_NEAR(s.omega[0] * r / (2.0 * kick), 1.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace ddem
