// Lagged strains against the published scheme written down bond by bond in double precision: what the kernels read of a
// bond's other end, when they write it, and who else moves discs between two steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "dem/assembly/bond_stiffness.h"
#include "dem/assembly/particle_volume.h"
#include "dem/simulation/simulation.h"
#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

using test::kNormalStiffness;

struct Strain {
  double xx = 0.0, yy = 0.0, xy = 0.0;
};

/// Normal forces, theory section 1: F_c = k_n (n.(u_j - u_i) - a_i n.eps_i.n - a_j n.eps_j.n), eps_p = D : (1/V_p) sum a F_c n (x) n
/// of the step before; a pair that may close pushes where that is below minus its gap.
class Reference {
 public:
  struct Bond {
    int i, j;
    double nx, ny, arm_i, arm_j, stiffness, gap;
    bool pushes_only;
  };

  Reference(const Assembly& a, const SimulationInput& in)
      : a_(a), in_(in), compliance_(disc_compliance(in.deformation)), volume_(particle_volumes(a, in.deformation)),
        ux_(in.initial.ux), uy_(in.initial.uy), vx_(a.size()), vy_(a.size()), strain_(a.size()) {
    const std::vector<double> k_n = normal_stiffnesses(a, in.contact);
    const Bonds& b = a.bonds;
    for (std::size_t c = 0; c < b.size(); ++c)
      bonds_.push_back({b.i[c], b.j[c], b.nx[c], b.ny[c], b.arm_i[c], b.arm_j[c], k_n[c], 0.0, false});
  }

  void watch(const Bond& pair) { bonds_.push_back(pair); }

  void run() {
    step(-0.5);  // v_{-1/2} = v_0 - dt a_0 / 2
    std::fill(strain_.begin(), strain_.end(), Strain{});
    for (long n = 0; n < in_.steps; ++n) {
      step(1.0);
      for (std::size_t p = 0; p < a_.size(); ++p) ux_[p] += in_.time_step * vx_[p], uy_[p] += in_.time_step * vy_[p];
      if (!in_.drive) continue;
      auto& driven = in_.drive->direction == Direction::x ? ux_ : uy_;
      for (const int d : in_.drive->discs) driven[d] = in_.drive->displacement(static_cast<double>(n + 1) * in_.time_step);
    }
  }

  const std::vector<double>& ux() const { return ux_; }
  const std::vector<double>& uy() const { return uy_; }

 private:
  double reach(int disc, double arm, const Bond& b) const {
    const Strain& e = strain_[disc];
    return arm * (e.xx * b.nx * b.nx + e.yy * b.ny * b.ny + 2.0 * e.xy * b.nx * b.ny);
  }

  bool held(const std::vector<std::uint8_t>& mask, std::size_t p, Direction direction) const {
    const bool driven = in_.drive && in_.drive->direction == direction &&
                        std::find(in_.drive->discs.begin(), in_.drive->discs.end(), static_cast<int>(p)) != in_.drive->discs.end();
    return driven || (!mask.empty() && mask[p]);
  }

  /// All evaluations; the last one's forces change the velocities, over a share of the step.
  void step(double share) {
    for (int m = 1; m < in_.deformation.evaluations; ++m) evaluate(0.0);
    evaluate(share);
  }

  /// Velocities by the forces at hand, over a share of the step; then the strains that these forces make.
  void evaluate(double share) {
    std::vector<double> fx(a_.size()), fy(a_.size());
    std::vector<Strain> stress(a_.size());
    for (const Bond& b : bonds_) {
      const double rigid = b.nx * (ux_[b.j] - ux_[b.i]) + b.ny * (uy_[b.j] - uy_[b.i]) + b.gap;
      const double u_n = rigid - reach(b.i, b.arm_i, b) - reach(b.j, b.arm_j, b);
      if (b.pushes_only && u_n >= 0.0) continue;
      pushed_ = pushed_ || b.pushes_only;
      const double f = b.stiffness * u_n;
      fx[b.i] += f * b.nx, fy[b.i] += f * b.ny;
      fx[b.j] -= f * b.nx, fy[b.j] -= f * b.ny;
      for (const auto& [p, arm] : {std::pair(b.i, b.arm_i), std::pair(b.j, b.arm_j)}) {
        const double s = arm * f / volume_[p];
        stress[p].xx += s * b.nx * b.nx, stress[p].yy += s * b.ny * b.ny, stress[p].xy += s * b.nx * b.ny;
      }
    }
    const double w = in_.deformation.relaxation;
    for (std::size_t p = 0; p < a_.size(); ++p) {
      const double kick = share * in_.time_step / a_.mass[p];
      if (!held(in_.held.x, p, Direction::x)) vx_[p] += kick * fx[p];
      if (!held(in_.held.y, p, Direction::y)) vy_[p] += kick * fy[p];
      const Strain &s = stress[p], &e = strain_[p];
      strain_[p] = {(1.0 - w) * e.xx + w * (compliance_.direct * s.xx + compliance_.coupling * s.yy),
                    (1.0 - w) * e.yy + w * (compliance_.coupling * s.xx + compliance_.direct * s.yy),
                    (1.0 - w) * e.xy + w * compliance_.shear * s.xy};
    }
  }

 public:
  bool pushed() const { return pushed_; }

 private:
  const Assembly& a_;
  const SimulationInput& in_;
  Compliance compliance_;
  std::vector<double> volume_;
  std::vector<Bond> bonds_;
  std::vector<double> ux_, uy_, vx_, vy_;
  std::vector<Strain> strain_;
  bool pushed_ = false;
};

SimulationInput input_of(const Assembly& a, long steps) {
  SimulationInput in;
  in.contact = {kNormalStiffness, 0.0, Kinematics::linear};
  in.deformation = {Scheme::lagged, Correction::normal, 4.0 * kNormalStiffness, 0.3, Plane::stress};
  in.time_step = 0.3 * 2.0 / largest_frequency(a, in.contact, {});
  in.steps = steps;
  in.initial.ux = test::Noise(11).vector(a.size(), 1e-9);
  in.initial.uy = test::Noise(12).vector(a.size(), 1e-9);
  return in;
}

/// Two discs in a row round a period: a bond on either side.
Assembly bonded_twice() {
  constexpr double r = 1e-4;
  Packing p;
  p.x = {r, 3.0 * r}, p.y = {r, r}, p.radius = {r, r};
  p.length = p.period.x = 4.0 * r, p.width = 2.0 * r;
  Bonds b;
  b.i = {0, 0}, b.j = {1, 1};
  b.nx = {1.0, -1.0}, b.ny = {0.0, 0.0};
  b.length = {2.0 * r, 2.0 * r}, b.stretch = {1.0, 1.0};
  b.arm_i = b.arm_j = {r, r};
  return make_assembly(p, b, 1.0, test::kDensity);
}

void expect_same_motion(const Reference& reference, const InitialState& state) {
  double largest = 0.0, difference = 0.0;
  for (std::size_t p = 0; p < state.ux.size(); ++p) {
    largest = std::max({largest, std::abs(reference.ux()[p]), std::abs(reference.uy()[p])});
    difference = std::max({difference, std::abs(reference.ux()[p] - state.ux[p]), std::abs(reference.uy()[p] - state.uy[p])});
  }
  // Sums of some thirty terms a step, rounded to 1.1e-16 each, over tens of stable steps; a strain that is one step old or
  // young changes the motion by a tenth.
  EXPECT_LT(difference, 1e-13 * largest);
}

TEST(LaggedReference, OfEveryKindOfBond) {
  const std::vector<Assembly> assemblies{
      test::hexagonal_assembly({.columns = 30, .rows = 8, .radius = 1e-4, .periodic_y = true}), bonded_twice(),
      test::random_free_strip(), test::random_cell(2)};
  for (const Assembly& a : assemblies) {
    for (const double modulus : {0.0, 1e14}) {
      for (const auto& [relaxation, evaluations] : {std::pair(1.0, 1), std::pair(0.6, 1), std::pair(1.0, 3), std::pair(0.6, 2)}) {
        SimulationInput in = input_of(a, 40);
        in.contact.contact_modulus = modulus;
        in.deformation.relaxation = relaxation;
        in.deformation.evaluations = evaluations;
        in.time_step = 0.3 * 2.0 / largest_frequency(a, in.contact, {});
        Reference reference(a, in);
        reference.run();
        for (const int steps_a_sweep : {1, 5}) {
          in.steps_a_sweep = steps_a_sweep;
          expect_same_motion(reference, simulate(a, in).final_state);
        }
      }
    }
  }
}

TEST(LaggedReference, OfEdgesThatAreHeldAndDriven) {
  const Assembly a = test::random_free_strip();
  SimulationInput in = input_of(a, 60);
  const std::vector<int> left = edge_discs(a.packing, Edge::left, mean_radius(a.packing));
  in.held.x.assign(a.size(), 0);
  for (const int d : edge_discs(a.packing, Edge::right, mean_radius(a.packing))) in.held.x[d] = 1;
  for (const Direction direction : {Direction::x, Direction::y}) {
    in.drive = EdgeDrive{left, direction, 1e-8, 40.0 * in.time_step};
    auto& driven = direction == Direction::x ? in.initial.ux : in.initial.uy;
    for (const int d : left) driven[d] = 0.0;
    Reference reference(a, in);
    reference.run();
    for (const auto& [threads, steps_a_sweep] : {std::pair(1, 1), std::pair(1, 7), std::pair(2, 1), std::pair(3, 1)}) {
      in.threads = threads, in.steps_a_sweep = steps_a_sweep;
      for (const ContactWatch watch : {ContactWatch::off, ContactWatch::bound}) {
        in.new_contacts = watch;
        expect_same_motion(reference, simulate(a, in).final_state);
      }
    }
  }
}

/// Three discs in a row, the third at a gap that closes: its push is read at the next step.
TEST(LaggedReference, OfANewContact) {
  constexpr double r = 1e-4, gap = 1e-8;
  const Assembly a = test::three_discs(r, gap);
  SimulationInput in = input_of(a, 100);
  in.initial.uy = {0.0, 0.0, 0.0};
  in.new_contacts = ContactWatch::bound;
  const double arm = 0.5 * (2.0 * r + gap);
  for (const int evaluations : {1, 3}) {
    for (const double shift : {0.0, 4e-8}) {  // open and closed at the start
      in.deformation.evaluations = evaluations;
      in.initial.ux = {shift + 2e-8, shift - 2e-8, 0.0};
      Reference reference(a, in);
      reference.watch({1, 2, 1.0, 0.0, arm, arm, kNormalStiffness, gap, true});
      reference.run();
      ASSERT_TRUE(reference.pushed());
      const SimulationResult result = simulate(a, in);
      ASSERT_TRUE(result.new_contacts);
      // The gap itself is the difference of coordinates 5e4 times as large: 1e-11 of the motion while it is closed.
      for (int d = 0; d < 3; ++d) EXPECT_NEAR(result.final_state.ux[d], reference.ux()[d], 1e-10 * 2e-8) << d;
    }
  }
}

/// Both ends of a bond see the same force to the last bit: a pair of equal discs has opposite velocities.
TEST(LaggedReference, ForcesAreOppositeToTheBit) {
  Packing p;
  p.x = {1e-4, 2.9e-4}, p.y = {1e-4, 1.7e-4}, p.radius = {1e-4, 1e-4};
  p.length = 4e-4, p.width = 3e-4;
  const std::vector<std::pair<int, int>> bonded{{0, 1}};
  const Assembly a = make_assembly(p, bonds_between(p, bonded), 1.0, test::kDensity);
  const InitialState s = simulate(a, input_of(a, 1000)).final_state;
  EXPECT_NE(s.vx[0], 0.0);
  EXPECT_EQ(s.vx[0], -s.vx[1]);
  EXPECT_EQ(s.vy[0], -s.vy[1]);
}

}  // namespace
}  // namespace ddem
