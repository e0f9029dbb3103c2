// No work where nothing can have moved yet, and several steps in one sweep: the same bits, and the front where the bonds
// carry it.

#include "dem/simulation/front.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include "dem/simulation/simulation.h"
#include "dem/simulation/stepper.h"
#include "dem/spectra/spectra.h"
#include "dem/spectra/strain_polynomial.h"
#include "tests/support/assemblies.h"
#include "tests/support/sanitized.h"

namespace ddem {
namespace {

using test::kNormalStiffness;

enum class Source { column, cosine, drive, inside, nothing };

struct Case {
  const char* name;
  Source source;
  double stiffness_ratio;
  DeformationParameters deformation = {};
  Kinematics kinematics = Kinematics::linear;
};

DeformationParameters front_strains(Scheme scheme, StrainSolver solver = StrainSolver::polynomial, int evaluations = 1) {
  DeformationParameters d{scheme, Correction::full, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  d.solver = solver;
  d.evaluations = evaluations;
  return d;
}

const Case cases[] = {
    {"Column", Source::column, 0.25},
    {"ColumnWithoutShear", Source::column, 0.0},
    {"Cosine", Source::cosine, 0.25},
    {"Drive", Source::drive, 0.25},
    {"Inside", Source::inside, 0.25},
    {"Nothing", Source::nothing, 0.25},
    {"Nonlinear", Source::column, 0.25, {}, Kinematics::nonlinear},
    {"Lagged", Source::column, 0.25, front_strains(Scheme::lagged)},
    {"LaggedWithoutShear", Source::column, 0.0, front_strains(Scheme::lagged)},
    {"LaggedWithoutShearDriven", Source::drive, 0.0, front_strains(Scheme::lagged)},
    {"LaggedThrice", Source::drive, 0.25, front_strains(Scheme::lagged, StrainSolver::polynomial, 3)},
    {"Implicit", Source::column, 0.25, front_strains(Scheme::implicit)},
    {"ImplicitWithoutShear", Source::column, 0.0, front_strains(Scheme::implicit)},
    {"ImplicitWithoutShearDriven", Source::drive, 0.0, front_strains(Scheme::implicit)},
    {"ImplicitDriven", Source::drive, 0.25, front_strains(Scheme::implicit)},
    {"Gradients", Source::column, 0.25, front_strains(Scheme::implicit, StrainSolver::conjugate_gradients)}};

class Front : public testing::TestWithParam<Case> {
 protected:
  SimulationInput input(const Assembly& a) const {
    SimulationInput in;
    in.contact = {kNormalStiffness, GetParam().stiffness_ratio, GetParam().kinematics};
    in.deformation = GetParam().deformation;
    in.time_step = 0.9 * 2.0 / largest_frequency(a, in.contact, {});
    in.snapshots = 3;
    in.receivers = {{{100}}, {{300, 301}}};
    const std::vector<int> left = edge_discs(a.packing, Edge::left, mean_radius(a.packing));
    auto& u = in.initial.uy;
    u.assign(a.size(), 0.0);
    switch (GetParam().source) {
      case Source::column:
        for (const int d : left) u[d] = 1e-8;
        break;
      case Source::cosine:
        for (std::size_t d = 0; d < a.size(); ++d) {
          const double s = a.packing.x[d] / 3e-3;
          if (s < 1.0) u[d] = 5e-9 * (1.0 + std::cos(std::numbers::pi * s));
        }
        break;
      case Source::drive:
        in.drive = EdgeDrive{left, Direction::y, 1e-8, 30.0 * in.time_step};
        break;
      case Source::inside:
        in.initial.omega.assign(a.size(), 0.0), in.initial.omega[a.size() / 2] = 1.0;
        break;
      case Source::nothing:
        break;
    }
    return in;
  }
};
INSTANTIATE_TEST_SUITE_P(Cases, Front, testing::ValuesIn(cases), [](const auto& p) { return p.param.name; });

/// Zeros with their signs too.
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

void expect_same_bits(const SimulationResult& a, const SimulationResult& b) {
  ASSERT_EQ(a.signals.ux.size(), b.signals.ux.size());
  for (std::size_t r = 0; r < a.signals.ux.size(); ++r) {
    EXPECT_TRUE(same_bits(a.signals.ux[r], b.signals.ux[r]) && same_bits(a.signals.uy[r], b.signals.uy[r]) &&
                same_bits(a.signals.theta[r], b.signals.theta[r]));
  }
  const auto expect_same_state = [](const InitialState& s, const InitialState& t) {
    EXPECT_TRUE(same_bits(s.ux, t.ux) && same_bits(s.uy, t.uy) && same_bits(s.theta, t.theta));
    EXPECT_TRUE(same_bits(s.vx, t.vx) && same_bits(s.vy, t.vy) && same_bits(s.omega, t.omega));
  };
  expect_same_state(a.final_state, b.final_state);
  ASSERT_EQ(a.snapshots.size(), b.snapshots.size());
  for (std::size_t k = 0; k < a.snapshots.size(); ++k) {
    expect_same_state(a.snapshots[k].state, b.snapshots[k].state);
    EXPECT_TRUE(same_bits(a.snapshots[k].strain.xx, b.snapshots[k].strain.xx) &&
                same_bits(a.snapshots[k].strain.xy, b.snapshots[k].strain.xy));
  }
  EXPECT_EQ(a.energy_drift, b.energy_drift);
}

TEST_P(Front, KeepsTheBits) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = input(a);
  // While the front is under way, and well after it has arrived: 90 or so bonds from end to end.
  for (const long steps : {5L, 40L, 150L}) {
    in.steps = steps;
    for (const ContactWatch watch : {ContactWatch::off, ContactWatch::bound}) {
      if (watch != ContactWatch::off && in.deformation.solver == StrainSolver::conjugate_gradients) continue;
      in.new_contacts = watch;
      in.threads = 1;
      in.follow_front = false;
      const SimulationResult everywhere = simulate(a, in);
      in.follow_front = true;
      // More threads than slices that move at first.
      in.threads = steps == 5 ? 3 : 1;
      expect_same_bits(everywhere, simulate(a, in));
    }
  }
}

/// Where a sweep may take several steps: one stage a step or the polynomial's, and shares wide enough; elsewhere it takes one.
TEST_P(Front, SeveralStepsASweepKeepTheBits) {
  const DeformationParameters& d = GetParam().deformation;
  const bool passes = d.scheme == Scheme::implicit ? d.solver == StrainSolver::polynomial : d.evaluations == 1;
  std::vector<std::pair<int, int>> threads_and_steps{{1, 7}, {2, 3}};
  if (passes && d.scheme == Scheme::implicit) {
    threads_and_steps = {{1, 2}, {1, 16}, {2, 3}, {3, 16}};
  } else if (passes) {
    threads_and_steps = {{1, 2}, {1, 3}, {1, 7}, {1, 16}, {2, 2}, {2, 3}, {2, 16}, {3, 16}};
  }
  if (test::kSanitized) threads_and_steps = {{d.scheme == Scheme::lagged ? 2 : 1, 16}};  // threads that wait are slow there
  std::vector<Assembly> assemblies{test::random_free_strip()};
  const int columns = d.scheme == Scheme::implicit ? 1500 : 750;  // its steps are more passes
  if (passes) assemblies.push_back(test::hexagonal_assembly({.columns = columns, .rows = 5, .radius = 1e-4}));
  for (const Assembly& a : assemblies) {
    SimulationInput in = input(a);
    in.steps = test::kSanitized ? 20 : a.size() > 3000 ? 60 : 150;
    in.follow_front = false;
    if (passes && d.scheme == Scheme::implicit) in.relaxations = strain_relaxations(a, in.contact, d);
    std::vector<int> all(a.size());
    std::iota(all.begin(), all.end(), 0);
    in.receivers.push_back({all});
    in.energy_samples = 2;  // each ends a sweep
    in.initial.vx = test::Noise(7).vector(a.size(), 1e-3);  // all of them move, where shares meet too
    for (const int sample_every : {1, 3}) {
      if (test::kSanitized && sample_every == 1) continue;
      in.sample_every = sample_every;
      in.threads = in.steps_a_sweep = 1;
      in.new_contacts = ContactWatch::off;
      const SimulationResult single = simulate(a, in);
      for (const auto& [threads, steps] : threads_and_steps) {
        in.threads = threads, in.steps_a_sweep = steps;
        for (const ContactWatch watch : {ContactWatch::off, ContactWatch::bound}) {
          if (watch != ContactWatch::off && d.solver == StrainSolver::conjugate_gradients) continue;
          if (test::kSanitized && watch == ContactWatch::off) continue;
          in.new_contacts = watch;
          SCOPED_TRACE(testing::Message() << threads << " threads, steps a sweep " << steps << ", watch " << static_cast<int>(watch));
          expect_same_bits(single, simulate(a, in));
          Stepper stepper(a, in, best_instruction_set());
          while (watch != ContactWatch::off && stepper.step() < 4) {  // how fast it goes is known then
            for (int k = 0; k < stepper.threads(); ++k) stepper.advance(k);
            if (stepper.finish_stage()) stepper.take_steps(1);
          }
          const bool may_be_free = watch == ContactWatch::off || in.contact.kinematics == Kinematics::linear;
          EXPECT_EQ(stepper.steps_at_once() > 1, passes && may_be_free && (threads == 1 || a.size() > 3000));
        }
      }
    }
  }
}

/// A sweep of several steps takes in the discs that the front reaches in all of them, also between the shares of threads.
TEST_P(Front, SeveralStepsASweepWhileItIsUnderWay) {
  std::vector<Assembly> assemblies{test::random_free_strip()};
  if (!test::kSanitized) assemblies.push_back(test::hexagonal_assembly({.columns = 750, .rows = 5, .radius = 1e-4}));
  for (const Assembly& a : assemblies) {
    SimulationInput in = input(a);
    in.steps = test::kSanitized ? 30 : 150;
    in.steps_a_sweep = 1;
    const SimulationResult single = simulate(a, in);
    in.steps_a_sweep = 5;
    for (const int threads : {1, 3}) {
      if (test::kSanitized && threads > 1) continue;  // threads that wait are slow there
      in.threads = threads;
      for (const ContactWatch watch : {ContactWatch::off, ContactWatch::bound}) {
        if (watch != ContactWatch::off && in.deformation.solver == StrainSolver::conjugate_gradients) continue;
        in.new_contacts = watch;
        expect_same_bits(single, simulate(a, in));
      }
    }
  }
}

/// With the period along the strip the first discs read the last: nothing drifts before all have been kicked.
TEST(Sweeps, RoundAPeriod) {
  const Assembly a = test::hexagonal_assembly({.columns = 40, .rows = 8, .radius = 1e-4, .periodic_x = true, .periodic_y = true});
  for (const auto& [stiffness_ratio, deformation] :
       {std::pair(0.25, DeformationParameters{}), std::pair(0.0, front_strains(Scheme::lagged)), std::pair(0.25, front_strains(Scheme::implicit))}) {
    SimulationInput in;
    in.contact = {kNormalStiffness, stiffness_ratio, Kinematics::linear};
    in.deformation = deformation;
    in.time_step = 0.5 * 2.0 / largest_frequency(a, in.contact, {});
    in.steps = 100;
    in.initial.ux = test::Noise(3).vector(a.size(), 1e-9);
    in.receivers = {{{0}}, {{150}}};
    in.steps_a_sweep = 1;
    const SimulationResult single = simulate(a, in);
    in.steps_a_sweep = 5;
    expect_same_bits(single, simulate(a, in));
    in.threads = 3;
    expect_same_bits(single, simulate(a, in));
  }
}

/// Two rows of twenty discs that no bond joins: the motion gets across when the gap closes.
TEST(FrontWithContacts, CrossesAGapThatCloses) {
  Packing p;
  std::vector<std::pair<int, int>> bonded;
  for (int d = 0; d < 40; ++d) {
    p.x.push_back(2e-4 * d + (d >= 20 ? 1e-9 : 0.0));
    p.y.push_back(1e-4);
    p.radius.push_back(1e-4);
    if (d % 20 != 0) bonded.emplace_back(d - 1, d);
  }
  p.length = 81e-4, p.width = 2e-4;
  const Assembly a = make_assembly(p, bonds_between(p, bonded), 1.0, test::kDensity, RattlerRule::apart);
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.0, Kinematics::linear};
  in.time_step = 0.5 * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = 300;
  in.initial.ux.assign(40, 0.0);
  in.initial.ux[0] = 1e-8;
  in.receivers = {{{10}}, {{30}}};
  in.new_contacts = ContactWatch::bound;
  const SimulationResult followed = simulate(a, in);
  in.follow_front = false;
  expect_same_bits(simulate(a, in), followed);
  ASSERT_TRUE(followed.new_contacts.has_value());
  EXPECT_NE(followed.signals.ux[1].back(), 0.0);
}

TEST(Fronts, AdvanceOneBondASweep) {
  // A chain of 80 discs, ten slices, moved at its left end: sweep n reaches disc n + 1.
  const Assembly a = test::hexagonal_assembly({.columns = 80, .rows = 1, .radius = 1e-4});
  std::vector<int> position(80);
  std::iota(position.begin(), position.end(), 0);
  const SlicedBonds sliced = slice_bonds(a.bonds, position, {}, false);
  std::vector<char> moving(80, 0);
  moving[0] = 1;
  const std::vector<int> fronts = motion_fronts(sliced, moving);
  ASSERT_EQ(fronts.size(), 72u);  // sweep 71 reaches disc 72, the first of the last slice
  for (int n = 0; n < 72; ++n) EXPECT_EQ(fronts[n], (n + 1) / 8 + 1) << n;
  // Nothing moves, and everything does.
  EXPECT_EQ(motion_fronts(sliced, std::vector<char>(80, 0)), std::vector<int>{0});
  EXPECT_EQ(motion_fronts(sliced, std::vector<char>(80, 1)), std::vector<int>{10});
}

TEST(Fronts, StopWhereTheBondsEnd) {
  Packing p;
  for (int d = 0; d < 32; ++d) p.x.push_back(2e-4 * d), p.y.push_back(1e-4), p.radius.push_back(1e-4);
  p.length = 64e-4, p.width = 2e-4;
  std::vector<std::pair<int, int>> bonded;
  for (int d = 1; d < 12; ++d) bonded.emplace_back(d - 1, d);
  std::vector<int> position(32);
  std::iota(position.begin(), position.end(), 0);
  std::vector<char> moving(32, 0);
  moving[9] = 1;
  EXPECT_EQ(motion_fronts(slice_bonds(bonds_between(p, bonded), position, {}, false), moving).back(), 2);
}

TEST(Threads, AreAsManyAsPay) {
  EXPECT_EQ(worthwhile_threads(2, 682), 1);
  EXPECT_EQ(worthwhile_threads(2, 100000), 2);
  EXPECT_EQ(worthwhile_threads(1, 100000), 1);
  EXPECT_EQ(worthwhile_threads(64, 10000), 5);
}

}  // namespace
}  // namespace ddem
