// New contacts: a piecewise exact solution, conservation, and that the bound which says when to look costs no contact.

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "dem/simulation/new_contacts.h"
#include "dem/simulation/simulation.h"
#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"
#include "tests/support/sanitized.h"

namespace ddem {
namespace {

using test::kDensity;
using test::kNormalStiffness;

constexpr double kRadius = 1e-4, kGap = 1e-8, kAmplitude = 2e-8;

Assembly three_discs() { return test::three_discs(kRadius, kGap); }

/// Stiffness of the bond, and of the bond and the closed contact in series with the discs' strains where they are soft:
/// overlaps (bond, gap) = e - B F, F = k (bond, min(gap, 0)), so F = (1/k + B)^-1 e for closed contacts. Each disc of
/// radius r adds a^2 n.D(nn).n / V to the two ends that press on it: here D_xxxx = 1/E_p and V = pi r^2, a = r.
struct Chain {
  double bond = 0.0;        // force of the bond per elongation while the contact is open
  Eigen::Matrix2d closed;   // forces per (elongation, gap)
};

Chain chain(double softness) {
  const double compliance = 1.0 / kNormalStiffness, disc = softness / (std::numbers::pi * kNormalStiffness);
  Chain c;
  c.bond = 1.0 / (compliance + 2.0 * disc);
  Eigen::Matrix2d flexibility;
  flexibility << compliance + 2.0 * disc, disc, disc, compliance + 2.0 * disc;
  c.closed = flexibility.inverse();
  return c;
}

/// Exact motion: harmonic between openings and closings, whose times are found by bisection.
class Exact {
 public:
  explicit Exact(double softness) : chain_(chain(softness)), mass_(kDensity * std::numbers::pi * kRadius * kRadius) {}

  Eigen::Vector3d at(double time) {
    Eigen::Vector3d u(kAmplitude, -kAmplitude, 0.0), v = Eigen::Vector3d::Zero();
    bool closed = false;
    const double look = 0.002 * std::sqrt(mass_ / kNormalStiffness);
    for (double t = 0.0; t < time;) {
      const double step = std::min(look, time - t);
      auto [u1, v1] = advance(u, v, closed, step);
      if (shut(u1, closed) != closed) {
        double low = 0.0, high = step;
        for (int k = 0; k < 100; ++k) {
          const double middle = 0.5 * (low + high);
          (shut(advance(u, v, closed, middle).first, closed) == closed ? low : high) = middle;
        }
        std::tie(u1, v1) = advance(u, v, closed, high);
        closed = !closed;
        t += high;
        ++events_;
      } else {
        t += step;
      }
      u = u1, v = v1;
    }
    return u;
  }
  int events() const { return events_; }

 private:
  double contact_force(const Eigen::Vector3d& u) const {
    return (chain_.closed * Eigen::Vector2d(u[1] - u[0], kGap + u[2] - u[1]))[1];
  }
  /// Open: the gap of the boundaries, the bond's strain of disc 1 included, has closed; closed: it still presses.
  bool shut(const Eigen::Vector3d& u, bool closed) const {
    if (closed) return contact_force(u) < 0.0;
    const double disc = 1.0 / chain_.bond - 1.0 / kNormalStiffness;  // of both ends of the bond
    return kGap + u[2] - u[1] - 0.5 * disc * chain_.bond * (u[1] - u[0]) < 0.0;
  }
  /// m u'' = -K u + f, by the eigenvectors of K.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> advance(const Eigen::Vector3d& u, const Eigen::Vector3d& v, bool closed, double t) const {
    Eigen::Matrix<double, 2, 3> c;
    c << -1.0, 1.0, 0.0, 0.0, -1.0, 1.0;
    Eigen::Matrix2d k = Eigen::Matrix2d::Zero();
    k(0, 0) = chain_.bond;
    if (closed) k = chain_.closed;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(c.transpose() * k * c);
    const Eigen::Vector3d load = -c.transpose() * k * Eigen::Vector2d(0.0, kGap);
    const Eigen::Vector3d q = modes.eigenvectors().transpose() * u, p = modes.eigenvectors().transpose() * v,
                          f = modes.eigenvectors().transpose() * load / mass_;
    Eigen::Vector3d q1, p1;
    for (int m = 0; m < 3; ++m) {
      const double w2 = modes.eigenvalues()[m] / mass_;
      if (w2 * mass_ < 1e-9 * kNormalStiffness) {  // free motion
        q1[m] = q[m] + t * p[m] + 0.5 * t * t * f[m];
        p1[m] = p[m] + t * f[m];
      } else {
        const double w = std::sqrt(w2), rest = f[m] / w2;
        q1[m] = rest + (q[m] - rest) * std::cos(w * t) + p[m] / w * std::sin(w * t);
        p1[m] = -(q[m] - rest) * w * std::sin(w * t) + p[m] * std::cos(w * t);
      }
    }
    return {modes.eigenvectors() * q1, modes.eigenvectors() * p1};
  }

  Chain chain_;
  double mass_;
  int events_ = 0;
};

double period() { return 2.0 * std::numbers::pi * std::sqrt(kDensity * std::numbers::pi * kRadius * kRadius / (2.0 * kNormalStiffness)); }

SimulationInput three_disc_input(Scheme scheme, double softness, double fraction_of_period, double periods) {
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.0, Kinematics::linear};
  if (scheme != Scheme::none) {
    in.deformation = {scheme, Correction::full, kNormalStiffness / softness, 0.0, Plane::stress};
    in.deformation.tolerance = 1e-12;
  }
  in.initial.ux = {kAmplitude, -kAmplitude, 0.0};
  in.steps = std::lround(periods / fraction_of_period);
  in.time_step = periods * period() / static_cast<double>(in.steps);
  in.receivers = {{{0}}, {{1}}, {{2}}};
  in.new_contacts = ContactWatch::bound;
  return in;
}

TEST(NewContacts, ThreeDiscsFollowThePiecewiseExactMotion) {
  const Assembly a = three_discs();
  for (const auto& [scheme, softness] : {std::pair(Scheme::none, 0.0), std::pair(Scheme::implicit, 0.25)}) {
    Exact exact(softness);
    // Past the collision; the discs part again before.
    const Eigen::Vector3d u = exact.at(1.5 * period());
    ASSERT_EQ(exact.events(), 2);
    std::array<double, 3> error;
    for (int k = 0; k < 3; ++k) {
      const SimulationResult r = simulate(a, three_disc_input(scheme, softness, 0.01 / (1 << k), 1.5));
      ASSERT_FALSE(r.breakdown);
      ASSERT_TRUE(r.new_contacts);
      EXPECT_EQ(r.new_contacts->most, 1u);
      error[k] = 0.0;
      for (int d = 0; d < 3; ++d) error[k] = std::max(error[k], std::abs(r.final_state.ux[d] - u[d]) / kAmplitude);
    }
    // Second order; the instants of closing and opening fall anywhere within a step.
    EXPECT_LT(error[0], 5e-3);
    EXPECT_GT(std::log2(error[0] / error[2]) / 2.0, 1.7) << error[0] << " " << error[1] << " " << error[2];
  }
}

TEST(NewContacts, TheThirdDiscRestsUntilItIsTouchedAndMomentumStaysZero) {
  const Assembly a = three_discs();
  const SimulationInput in = three_disc_input(Scheme::none, 0.0, 0.001, 2.0);
  const SimulationResult r = simulate(a, in);
  // u_1 = -A cos(w t) reaches the gap A/2 at w t = 2 pi / 3, a third of the period.
  const long closing = static_cast<long>(std::ceil(period() / 3.0 / in.time_step));
  ASSERT_TRUE(r.new_contacts);
  EXPECT_NEAR(static_cast<double>(r.new_contacts->first_step), static_cast<double>(closing), 1.0);
  for (long n = 0; n <= r.new_contacts->first_step; ++n) EXPECT_EQ(r.signals.ux[2][n], 0.0) << n;
  EXPECT_GT(r.signals.ux[2].back(), kGap);
  const InitialState& s = r.final_state;
  EXPECT_NEAR(s.vx[0] + s.vx[1] + s.vx[2], 0.0, 1e-13 * std::abs(s.vx[0]));
  // Closing or opening within a step changes the invariant by k (v dt)^2 / 8 at most, of m A^2 w^2 = 2 k A^2 and less.
  const double turn = in.time_step * 2.0 * std::numbers::pi / period();
  EXPECT_LT(r.energy_drift.value(), turn * turn);
}

TEST(NewContacts, EnergyIsKeptToSecondOrderAtAnySoftness) {
  const Assembly a = three_discs();
  for (const double softness : {0.25, 5.0}) {
    std::array<double, 2> drift;
    for (int k = 0; k < 2; ++k) drift[k] = simulate(a, three_disc_input(Scheme::implicit, softness, 0.004 / (1 << (2 * k)), 2.0)).energy_drift.value();
    EXPECT_LT(drift[0], 1e-3) << softness;
    EXPECT_LT(drift[1], drift[0] / 4.0) << softness;
  }
}

TEST(NewContacts, FieldsHoldTheForcesOfTheContact) {
  // The contact presses from a third of the period on, for about half of it: the snapshot is amidst. The law of the disc ties
  // its strain, which the solver found, to the stress, which the fields are made of: nu_p = 0, so eps_xx = s_xx / E_p.
  const Assembly a = three_discs();
  for (const Scheme scheme : {Scheme::implicit, Scheme::lagged}) {
    SimulationInput in = three_disc_input(scheme, 0.25, 1e-4, 0.45);
    in.snapshots = 1;
    const SimulationResult r = simulate(a, in);
    ASSERT_EQ(r.snapshots.size(), 1u);
    const Snapshot& s = r.snapshots.front();
    EXPECT_LT(s.stress.xx[2], 0.0);
    // Lagged strains are those of the step before: within a step's turn.
    const double tolerance = scheme == Scheme::implicit ? 1e-9 : 2e-3;
    for (int d = 0; d < 3; ++d) {
      EXPECT_NEAR(s.strain.xx[d] * in.deformation.young_modulus, s.stress.xx[d], tolerance * std::abs(s.stress.xx[1])) << d;
    }
  }
}

/// A random strip shaken by velocities at random (m/s).
SimulationInput shaken(const Assembly& a, Scheme scheme, double amplitude, Kinematics kinematics) {
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.5, kinematics};
  if (scheme != Scheme::none) in.deformation = {scheme, Correction::normal, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  in.time_step = 0.2 * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = 300;
  test::Noise noise(7);
  in.initial.vx = noise.vector(a.size(), amplitude), in.initial.vy = noise.vector(a.size(), amplitude);
  in.receivers = {{{10}}, {{300}}};
  return in;
}

/// Of a run that looks at every pair in every step, and of one that does not, with so many threads and steps a sweep.
void expect_none_missed(const Assembly& a, SimulationInput in, const std::vector<std::pair<int, int>>& threads_and_steps) {
  in.energy_samples = 0;  // each would end a sweep
  in.new_contacts = ContactWatch::every_step;
  const SimulationResult always = simulate(a, in);
  ASSERT_FALSE(always.breakdown);
  in.new_contacts = ContactWatch::bound;
  for (const auto& [threads, steps] : threads_and_steps) {
    in.threads = threads, in.steps_a_sweep = steps;
    const SimulationResult bound = simulate(a, in);
    SCOPED_TRACE(testing::Message() << a.size() << " discs, scheme " << static_cast<int>(in.deformation.scheme) << ", k_t/k_n "
                                    << in.contact.stiffness_ratio << ", threads " << threads << ", steps a sweep " << steps);
    ASSERT_EQ(bound.new_contacts.has_value(), always.new_contacts.has_value());
    if (always.new_contacts) {
      EXPECT_GT(always.new_contacts->first_step, 2);  // not from the start
      EXPECT_EQ(bound.new_contacts->first_step, always.new_contacts->first_step);
      EXPECT_EQ(bound.new_contacts->most, always.new_contacts->most);
      // Nonlinear kinematics searches for pairs anew, more often where it always looks.
      if (in.contact.kinematics == Kinematics::linear) {
        EXPECT_EQ(bound.new_contacts->critical_time_step, always.new_contacts->critical_time_step);
      }
    }
    EXPECT_EQ(bound.signals.ux, always.signals.ux);
    EXPECT_EQ(bound.final_state.ux, always.final_state.ux);
    EXPECT_EQ(bound.final_state.vy, always.final_state.vy);
    EXPECT_EQ(bound.final_state.omega, always.final_state.omega);
  }
}

TEST(NewContacts, TheBoundMissesNone) {
  const Assembly a = test::random_free_strip();
  for (const Kinematics kinematics : {Kinematics::linear, Kinematics::nonlinear}) {
    for (const Scheme scheme : {Scheme::none, Scheme::lagged, Scheme::implicit}) {
      if (scheme == Scheme::implicit && kinematics == Kinematics::nonlinear) continue;
      SimulationInput in = shaken(a, scheme, 500.0, kinematics);
      expect_none_missed(a, in, {{1, 0}, {3, 0}});
      const SimulationResult off = simulate(a, in);
      in.new_contacts = ContactWatch::bound;
      const SimulationResult bound = simulate(a, in);
      EXPECT_TRUE(bound.new_contacts);
      EXPECT_NE(off.final_state.ux, bound.final_state.ux);
    }
  }
}

/// Where nothing can close unless all goes much faster, a sweep takes several steps; where it did go faster, it is taken back.
TEST(NewContacts, SweepsOfSeveralStepsMissNone) {
  const Assembly a = test::random_free_strip();
  for (const Scheme scheme : {Scheme::none, Scheme::lagged, Scheme::implicit}) {
    for (const double stiffness_ratio : {0.0, 0.5}) {
      for (const double speed : {50.0, 500.0}) {
        SimulationInput in = shaken(a, scheme, speed, Kinematics::linear);
        in.contact.stiffness_ratio = stiffness_ratio;
        in.steps = test::kSanitized ? 40 : 150;
        expect_none_missed(a, in, test::kSanitized ? std::vector<std::pair<int, int>>{{1, 16}} : std::vector<std::pair<int, int>>{{1, 16}, {1, 1}, {3, 5}});
      }
    }
  }
}

/// Discs that start from rest: with a constant acceleration a gap of g times the first step closes in sqrt(g) steps, and is free for g/4.
TEST(NewContacts, ASweepInWhichAGapClosesIsTakenBack) {
  const Assembly a = three_discs();
  for (const Scheme scheme : {Scheme::none, Scheme::lagged, Scheme::implicit}) {
    for (const double stiffness_ratio : {0.0, 0.5}) {
      for (double fraction = 0.022; fraction < 0.04; fraction += 0.001) {
        SimulationInput in = three_disc_input(scheme, 0.02, fraction, 1.0);
        in.contact.stiffness_ratio = stiffness_ratio;
        expect_none_missed(a, in, {{1, 16}});
      }
    }
  }
}

/// The same of an edge that is driven.
TEST(NewContacts, ASweepInWhichADrivenEdgeClosesAGapIsTakenBack) {
  const Assembly a = three_discs();
  for (const Scheme scheme : {Scheme::none, Scheme::lagged, Scheme::implicit}) {
    for (double first_way = kGap / 120.0; first_way < kGap / 50.0; first_way *= 1.1) {
      SimulationInput in = three_disc_input(scheme, 0.25, 0.02, 1.0);
      in.initial.ux = {};
      const double duration = 100.0;  // steps
      in.drive = EdgeDrive{{2}, Direction::x, -first_way * std::pow(duration / std::numbers::pi, 2), duration * in.time_step};
      expect_none_missed(a, in, {{1, 16}});
    }
  }
}

/// Of a sweep that is taken back, the shares of all threads are: two chains, the upper of which is driven onto the lower, whose discs move
/// a little.
TEST(NewContacts, ASweepOfSeveralThreadsIsTakenBackAsAWhole) {
  constexpr int kDiscs = 800;  // shares wide enough for sweeps of two steps, but for implicit strains
  Packing p;
  std::vector<std::pair<int, int>> bonded;
  std::vector<int> upper;
  for (int d = 0; d < 2 * kDiscs; ++d) {
    p.x.push_back(2.0 * kRadius * (d % kDiscs) + kRadius), p.y.push_back(d < kDiscs ? kRadius : 3.0 * kRadius + kGap), p.radius.push_back(kRadius);
    if (d % kDiscs != 0) bonded.emplace_back(d - 1, d);
    if (d >= kDiscs) upper.push_back(d);
  }
  p.length = 2.0 * kRadius * kDiscs, p.width = 4.0 * kRadius + kGap;
  const Assembly a = make_assembly(p, bonds_between(p, bonded), 1.0, kDensity, RattlerRule::apart);
  for (const Scheme scheme : {Scheme::none, Scheme::lagged}) {
    SimulationInput in = three_disc_input(scheme, 0.02, 0.02, 0.24);
    in.initial.ux = {};
    in.initial.vx = test::Noise(5).vector(a.size(), 1e-3);
    // Two steps are free by the way of the first, and the next ways are longer.
    const double duration = 100.0, first_way = kGap / 15.0;  // steps, m
    in.drive = EdgeDrive{upper, Direction::y, -first_way * std::pow(duration / std::numbers::pi, 2), duration * in.time_step};
    expect_none_missed(a, in, {{2, 16}});
  }
}

TEST(NewContacts, ARunThatDivergesEndsAsOneThatDoesNotWatch) {
  // Displacements grow by orders of magnitude in a step: pairs that are watched must not, nor may their search.
  const Assembly a = test::random_free_strip();
  for (const Kinematics kinematics : {Kinematics::linear, Kinematics::nonlinear}) {
    SimulationInput in = shaken(a, Scheme::none, 100.0, kinematics);
    in.time_step *= 1e3;
    in.steps = 2000;
    in.new_contacts = ContactWatch::bound;
    for (const auto& [threads, steps] : {std::pair(1, 0), std::pair(2, 0), std::pair(1, 16)}) {
      in.threads = threads, in.steps_a_sweep = steps;
      const auto breakdown = simulate(a, in).breakdown;
      ASSERT_TRUE(breakdown);
      EXPECT_EQ(breakdown->cause, Breakdown::Cause::diverged);
    }
  }
}

TEST(NewContacts, LinearKinematicsKnowsTheNearPairsOnly) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = shaken(a, Scheme::none, 1.0, Kinematics::linear);
  in.new_contacts = ContactWatch::bound;
  std::vector<int> place(a.size());
  std::iota(place.begin(), place.end(), 0);
  NewContacts watch(a, in, place);
  std::vector<double> motion(kQuad * a.size(), 0.0);
  for (const double far : {1e-4, 1e-3, 1e-1, 1e9, HUGE_VAL, std::nan("")}) {
    motion[0] = far;
    watch.moved(far);
    watch.look(motion.data(), nullptr, 0.0);
    // Those within a gap of four mean radii have their centres within 6.5 or so, where there are (6.5^2 - 1) / 2 pairs a disc
    // at a solid fraction of one.
    EXPECT_LT(watch.all_closed().bonds.size(), 21 * a.size()) << far;
  }
}

TEST(NewContacts, WatchingInVainChangesNoBit) {
  const Assembly a = test::random_free_strip();
  for (const Scheme scheme : {Scheme::none, Scheme::lagged, Scheme::implicit}) {
    SimulationInput in = shaken(a, scheme, 1e-3, Kinematics::linear);
    const SimulationResult off = simulate(a, in);
    in.new_contacts = ContactWatch::bound;
    const SimulationResult watched = simulate(a, in);
    EXPECT_FALSE(watched.new_contacts);
    EXPECT_EQ(watched.final_state.ux, off.final_state.ux);
    EXPECT_EQ(watched.final_state.omega, off.final_state.omega);
  }
}

TEST(NewContacts, ConjugateGradientsSayThatTheyTakeNone) {
  const Assembly a = three_discs();
  SimulationInput in = three_disc_input(Scheme::implicit, 0.25, 0.01, 1.0);
  in.deformation.solver = StrainSolver::conjugate_gradients;
  const auto breakdown = simulate(a, in).breakdown;
  ASSERT_TRUE(breakdown);
  EXPECT_EQ(breakdown->cause, Breakdown::Cause::contacts_undecided);
}

TEST(NewContacts, PiecesApartAreNoNetwork) {
  EXPECT_THROW(require_one_network(make_assembly(three_discs().packing, {}, 1.0, kDensity, RattlerRule::apart)), std::invalid_argument);
  EXPECT_EQ(three_discs().rattlers, std::vector<int>{2});
}

}  // namespace
}  // namespace ddem
