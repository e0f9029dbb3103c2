// Signals that are exact in time, against the dense eigenvectors of small strips: released, struck and
// driven; rigid discs and implicit strains.

#include "dem/simulation/exact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"
#include "tests/support/dense_modes.h"

namespace ddem {
namespace {

using std::numbers::pi;
using test::DenseModes;
using test::kNormalStiffness;

struct Law {
  const char* name;
  double stiffness_ratio;
  DeformationParameters deformation;
};

DeformationParameters implicit(Correction c) {
  DeformationParameters d{Scheme::implicit, c, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  // The polynomial's stiffness is then that of converged strains to 1e-11 for any motion
  // (strain_polynomial.h).
  d.tolerance = 1e-13;
  return d;
}

const Law laws[] = {{"Dem", 0.25, {}},
                    {"DemWithoutShear", 0.0, {}},
                    {"Full", 0.5, implicit(Correction::full)},
                    {"NormalOnlyStress", 0.5, implicit(Correction::normal_only_stress)},
                    {"NormalWithoutShear", 0.0, implicit(Correction::normal)}};

/// Radii and places differ: no symmetry hides an error.
Assembly uneven_strip() {
  Assembly a = test::hexagonal_assembly({.columns = 10, .rows = 5, .radius = 1e-4});
  Packing p = a.packing;
  test::Noise noise(5);
  for (std::size_t d = 0; d < p.size(); ++d)
    p.radius[d] *= 1.0 + 0.05 * noise(), p.x[d] += 2e-6 * noise(), p.y[d] += 2e-6 * noise();
  return make_assembly(p, bonds_within_gap(p, 0.3 * mean_radius(p)), 1.0, test::kDensity);
}

class Exact : public testing::TestWithParam<Law> {
 protected:
  Exact() : a_(uneven_strip()) {
    in_.contact = {kNormalStiffness, GetParam().stiffness_ratio, Kinematics::linear};
    in_.deformation = GetParam().deformation;
    in_.held.x.assign(a_.size(), 0);
    for (const int d : edge_discs(a_.packing, Edge::right, 0.5e-4)) in_.held.x[d] = 1;
    for (const int d : {0, 7, 23, 49}) in_.receivers.push_back({{d}});
    critical_ = 2.0 / largest_frequency(a_, in_.contact, in_.held);
    in_.time_step = exact_step(critical_, std::nullopt);
    // Not commensurate with the march; to the end some tens of its steps.
    sampling_ = {0.377 * critical_, 200};
  }

  std::vector<int> left() const { return edge_discs(a_.packing, Edge::left, 0.5e-4); }
  DenseModes modes() const { return {a_, in_.contact, in_.deformation, in_.held}; }

  /// Largest difference from exact(t), over the largest of exact itself.
  double error(const SimulationResult& r, const DenseModes& m,
               const std::function<Eigen::VectorXd(double)>& exact) const {
    double size = 0.0, worst = 0.0;
    const double radius = mean_radius(a_.packing);
    for (std::size_t n = 0; n < sampling_.samples; ++n) {
      const double t = sampling_.interval * static_cast<double>(n);
      EXPECT_DOUBLE_EQ(r.signals.time[n], t);
      const Eigen::VectorXd q = exact(t);
      for (std::size_t k = 0; k < in_.receivers.size(); ++k) {
        const int d = in_.receivers[k].discs[0];
        worst = std::max({worst, std::abs(r.signals.ux[k][n] - m.displacement(q, d, 0)),
                          std::abs(r.signals.uy[k][n] - m.displacement(q, d, 1))});
        size = std::max({size, std::abs(m.displacement(q, d, 0)), std::abs(m.displacement(q, d, 1))});
        if (in_.contact.has_rotation())
          worst = std::max(worst, radius * std::abs(r.signals.theta[k][n] - m.displacement(q, d, 2)));
      }
    }
    return worst / size;
  }

  Assembly a_;
  SimulationInput in_;
  double critical_ = 0.0;
  Sampling sampling_;
};
INSTANTIATE_TEST_SUITE_P(Laws, Exact, testing::ValuesIn(laws), [](const auto& p) { return p.param.name; });

double struck(double w, double t) {
  return w == 0.0 ? t : std::sin(w * t) / w;
}

// Round-off: a few hundred coefficients, 1e-16 each of their sum of order 20, and the eigenvectors' 1e-13;
// with the strains' 1e-11. The strip that the issue of accuracy names must be met within 1e-10.
constexpr double kTolerance = 1e-10;

TEST_P(Exact, Released) {
  auto& u = in_.initial.ux;
  u.assign(a_.size(), 0.0);
  for (const int d : left()) u[d] = 1e-9;
  const SimulationResult r = simulate_exact(a_, in_, sampling_);
  ASSERT_FALSE(r.breakdown || r.new_contacts);
  EXPECT_LT(r.energy_drift.value(), 1e-11);
  const DenseModes m = modes();
  const Eigen::VectorXd start = m.unknowns(u, {}, {});
  EXPECT_LT(error(r, m, [&](double t) { return m.apply([t](double w) { return std::cos(w * t); }, start); }),
            kTolerance);
  // At any step below: what the march would err by in itself has gone.
  in_.time_step *= 0.43;
  EXPECT_LT(error(simulate_exact(a_, in_, sampling_), m,
                  [&](double t) { return m.apply([t](double w) { return std::cos(w * t); }, start); }),
            kTolerance);
}

TEST_P(Exact, DisplacedAndStruck) {
  test::Noise noise(7);
  InitialState& s = in_.initial;
  for (auto* v : {&s.ux, &s.uy}) *v = noise.vector(a_.size(), 1e-9);
  for (auto* v : {&s.vx, &s.vy}) *v = noise.vector(a_.size(), 1e-2);
  s.theta = noise.vector(a_.size(), 1e-5), s.omega = noise.vector(a_.size(), 1e2);
  for (std::size_t d = 0; d < a_.size(); ++d) {
    if (in_.held.x[d]) s.ux[d] = s.vx[d] = 0.0;
  }
  const DenseModes m = modes();
  const Eigen::VectorXd u = m.unknowns(s.ux, s.uy, s.theta), v = m.unknowns(s.vx, s.vy, s.omega);
  EXPECT_LT(error(simulate_exact(a_, in_, sampling_), m,
                  [&](double t) -> Eigen::VectorXd {
                    return m.apply([t](double w) { return std::cos(w * t); }, u) +
                           m.apply([t](double w) { return struck(w, t); }, v);
                  }),
            kTolerance);
}

/// int_0^t sin(w (t - s))/w (1 - cos(W s))/2 ds, with no difference of nearly equal terms at w = W or w = 0.
double cosine_drive(double w, double pulse, double t) {
  if (t <= 0.0) return 0.0;
  const double d = 0.5 * (w - pulse) * t;
  const double constant = w == 0.0 ? 0.5 * t * t : 2.0 * std::pow(std::sin(0.5 * w * t) / w, 2);
  const double sinc = std::abs(d) < 1e-8 ? 1.0 : std::sin(d) / d;
  return 0.5 * (constant - std::sin(0.5 * (w + pulse) * t) * t * sinc / (w + pulse));
}

TEST_P(Exact, Driven) {
  for (const Direction direction : {Direction::x, Direction::y}) {
    const double duration = 30.0 * critical_;
    in_.drive = EdgeDrive{left(), direction, 1e-9, duration};
    in_.receivers[0] = {{left()[1]}};  // prescribed
    in_.time_step = exact_step(critical_, in_.drive);
    const SimulationResult r = simulate_exact(a_, in_, sampling_);
    ASSERT_FALSE(r.breakdown || r.new_contacts);

    HeldDofs held = in_.held;
    auto& driven = direction == Direction::x ? held.x : held.y;
    driven.resize(a_.size(), 0);
    std::vector<double> edge(a_.size(), 0.0);
    for (const int d : in_.drive->discs) driven[d] = 1, edge[d] = in_.drive->amplitude;
    const DenseModes m(a_, in_.contact, in_.deformation, held);
    const Eigen::VectorXd moved =
        direction == Direction::x ? m.unknowns(edge, {}, {}) : m.unknowns({}, edge, {});
    const Eigen::VectorXd acceleration = m.acceleration(moved);
    const double pulse = 2.0 * pi / duration;
    EXPECT_LT(error(r, m,
                    [&](double t) -> Eigen::VectorXd {
                      return m.apply(
                                 [&](double w) {
                                   return cosine_drive(w, pulse, t) - cosine_drive(w, pulse, t - duration);
                                 },
                                 acceleration) +
                             in_.drive->displacement(t) / in_.drive->amplitude * moved;
                    }),
              kTolerance);
  }
}

TEST_P(Exact, VerletConvergesToIt) {
  in_.drive = EdgeDrive{left(), Direction::y, 1e-9, 30.0 * critical_};
  sampling_ = {critical_, 50};
  SimulationInput fine = in_;
  in_.time_step = exact_step(critical_, in_.drive);
  const Signals exact = simulate_exact(a_, in_, sampling_).signals;
  double error[2] = {0.0, 0.0};
  for (const int refinement : {0, 1}) {
    fine.sample_every = refinement == 0 ? 20 : 40;
    fine.time_step = critical_ / static_cast<double>(fine.sample_every);
    fine.steps = 49L * fine.sample_every;
    const Signals verlet = simulate(a_, fine).signals;
    for (std::size_t k = 0; k < exact.uy.size(); ++k) {
      for (std::size_t n = 0; n < exact.time.size(); ++n)
        error[refinement] = std::max(error[refinement], std::abs(verlet.uy[k][n] - exact.uy[k][n]));
    }
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.05);
}

class ExactRefuses : public testing::Test {
 protected:
  ExactRefuses() : a_(test::hexagonal_assembly({.columns = 6, .rows = 4, .radius = 1e-4})) {
    in_.contact = {kNormalStiffness, 0.5, Kinematics::linear};
    in_.time_step = 1e-8;
    in_.receivers = {{{3}}};
  }
  void expect_refused() { EXPECT_THROW(simulate_exact(a_, in_, {1e-8, 10}), std::invalid_argument); }

  Assembly a_;
  SimulationInput in_;
};

TEST_F(ExactRefuses, WhatIsNotLinearOrHasNoEnergy) {
  in_.deformation = {Scheme::lagged, Correction::full, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  expect_refused();
  in_.deformation.scheme = Scheme::implicit;
  EXPECT_NO_THROW(simulate_exact(a_, in_, {1e-8, 10}));
  in_.deformation.solver = StrainSolver::conjugate_gradients;
  expect_refused();
  in_.deformation.solver = StrainSolver::polynomial;
  in_.deformation.correction = Correction::normal;
  expect_refused();
  in_.deformation = {};
  in_.contact.kinematics = Kinematics::nonlinear;
  expect_refused();
  in_.contact.kinematics = Kinematics::linear;
  in_.drive = EdgeDrive{{99}, Direction::x, 1e-9, 1e-6};
  expect_refused();
}

/// Two discs 1 um apart, not bonded, each bonded to a neighbour: a push of 4 um closes the gap, of 0.02 um
/// does not.
TEST(ExactContacts, ThatCloseAreReportedAndNothingElse) {
  Packing p;
  p.x = {0.0, 2e-4, 4.01e-4, 6.01e-4};
  p.y = {0.0, 0.0, 0.0, 0.0};
  p.radius.assign(4, 1e-4);
  p.length = 8e-4, p.width = 2e-4;
  const std::vector<std::pair<int, int>> bonded{{0, 1}, {2, 3}};
  const Assembly a = make_assembly(p, bonds_between(p, bonded), 1.0, test::kDensity, RattlerRule::apart);
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.0, Kinematics::linear};
  in.new_contacts = ContactWatch::bound;
  in.receivers = {{{1}}};
  const double critical = 2.0 / largest_frequency(a, in.contact, {});
  in.time_step = exact_step(critical, std::nullopt);
  for (const bool struck : {false, true}) {
    for (const double push : {0.02e-6, 4e-6}) {
      in.initial = {};
      // With omega = 2/critical: v0/2 (t - sin(omega t)/omega), ten times the push at the end.
      (struck ? in.initial.vx : in.initial.ux) = {struck ? push * 2.0 / critical : push, 0.0, 0.0, 0.0};
      const SimulationResult r = simulate_exact(a, in, {0.1 * critical, 100});
      EXPECT_EQ(r.new_contacts.has_value(), push > 1e-6) << struck << " " << push;
      EXPECT_EQ(r.signals.time.size(), push > 1e-6 ? 0u : 100u);
    }
  }
}

}  // namespace
}  // namespace ddem
