// The one loop over bonds. Compiled once per instruction set (DDEM_ISA names the namespace), always with the same bits:
// no contraction, no reassociation. Include only from step_kernel.cc.
//
// Per slice of eight discs: gather the neighbours' motion, form the overlaps of a bond, correct them by the particle
// strains, apply the law, sum the force, moment and stress of each disc; then kick. The drift of the leapfrog is a sweep of its
// own over what is still in cache (simulation/stepper.h).
//
// Implicit strains solve (V C + S K G) eps = S K C u (theory section 3). With T = (V C)^-1 S K G, whose eigenvalues lie
// in [0, rho], that is (1 + T) eps = (V C)^-1 S K C u =: f, solved by a fixed number of relaxations from zero: a
// polynomial of T (spectra/strain_polynomial.h), so that the effective stiffness is as symmetric as S K G, and conserves
// its energy exactly.
// Without rotation and with linear kinematics all that a bond reads of its other disc is one number: what that disc's
// displacement and strain add to the bond's length. Where a disc writes it for each of its bonds (kPulls), the sweep over the
// other ends gathers one double where it would take five, and forms products only that its own disc needs. A disc's pull is of its
// displacement (lagged: and of its strain), its press of its strain alone.
// What a run does not use is not compiled into its kernel (if constexpr on the template parameters).

#include "dem/kernel/slice_loop.h"

namespace ddem::DDEM_ISA {
namespace {

template <class Kinematics, class Bond, bool kRotation, StrainCoupling kStrain, bool kPulls = false>
struct StepKernel {
  static_assert(kRotation || kStrain == StrainCoupling::none || kStrain == StrainCoupling::normal,
                "without rotation there are forces along the normals alone");
  using State = typename Bond::State;
  static constexpr bool kDeformable = kStrain != StrainCoupling::none;
  /// Stress by forces along the normals: its two shear stresses are the same.
  static constexpr bool kCentral = !kRotation || kStrain == StrainCoupling::normal_only_stress;

  /// What the bonds of a slice read of their own disc.
  struct Own {
    Triple motion, strain;
  };
  DDEM_INLINE static Own own_state(const StepData& d, int p) {
    Own o{load_triple(d.motion, p), {}};
    if constexpr (kDeformable) o.strain = load_triple(d.strain, p);
    return o;
  }

  DDEM_INLINE static State rigid(const StepData& d, int k, const Triple& own) {
    const Triple other = gather(d.motion, d.neighbour + k);
    return Kinematics::template overlaps<Bond, kRotation>(d, k, {other.a - own.a, other.b - own.b}, own.c, other.c);
  }

  /// Overlaps with the discs' strains. Where both are corrected and the normal stands still, the approach of the boundaries
  /// is taken from the displacement itself.
  DDEM_INLINE static State deformed(const StepData& d, int k, const Own& own) {
    if constexpr (!kDeformable) {
      return rigid(d, k, own.motion);
    } else if constexpr (kPulls) {
      State b = bond_at<Bond>(d, k);
      b.u_n = both_ends(d, d.pull, k);
      return b;
    } else if constexpr (Kinematics::kLinear && kStrain == StrainCoupling::full) {
      const Vector v = approach(bond_at<Bond>(d, k), own.strain, gather(d.strain, d.neighbour + k));
      const Triple other = gather(d.motion, d.neighbour + k);
      const Vector u{(other.a - own.motion.a) - v.x, (other.b - own.motion.b) - v.y};
      return Kinematics::template overlaps<Bond, kRotation>(d, k, u, own.motion.c, other.c);
    } else {
      State b = rigid(d, k, own.motion);
      const Triple other = gather(d.strain, d.neighbour + k);
      if constexpr (kStrain == StrainCoupling::full) {
        const Vector v = approach(b, own.strain, other);
        b.u_n -= b.nx * v.x + b.ny * v.y;
        b.u_t -= b.nx * v.y - b.ny * v.x;
      } else {
        b.u_n -= normal_approach(b, dyad(b), own.strain, other);
      }
      return b;
    }
  }

  /// Force and moment on the disc, or the stress in it, or both.
  template <bool kForce, bool kStress>
  DDEM_INLINE static void add(const StepData& d, const State& b, int k, Sums& sum) {
    const Pack f_n = Bond::normal(d, k) * b.u_n;
    Pack fx = f_n * b.nx, fy = f_n * b.ny;
    if constexpr (kStress && kCentral) add_central_stress(b, fx, fy, sum);
    if constexpr (kRotation) {
      const Pack f_t = Bond::shear(d, k) * b.u_t;
      fx -= f_t * b.ny;
      fy += f_t * b.nx;
      if constexpr (kForce) sum.moment += b.stretch * f_t;
      if constexpr (kStress && !kCentral) add_stress(b, fx, fy, sum);
    }
    if constexpr (kForce) {
      sum.fx += fx;
      sum.fy += fy;
    }
  }

  /// V_p sigma_p / r = sum_c s n (x) F_c; sxy holds the sum of both shear stresses, or one of two that are the same.
  DDEM_INLINE static void add_stress(const State& b, Pack fx, Pack fy, Sums& sum) {
    const Pack sx = b.stretch * b.nx, sy = b.stretch * b.ny;
    sum.sxx += sx * fx;
    sum.syy += sy * fy;
    sum.sxy += sx * fy + sy * fx;
  }
  DDEM_INLINE static void add_central_stress(const State& b, Pack fx, Pack fy, Sums& sum) {
    const Pack sx = b.stretch * fx, sy = b.stretch * fy;
    sum.sxx += sx * b.nx;
    sum.syy += sy * b.ny;
    sum.sxy += sx * b.ny;
  }
  DDEM_INLINE static void add_normal_stress(const State& b, const Dyad& n, Pack f_n, Sums& sum) {
    const Pack g = b.stretch * f_n;
    sum.sxx += g * n.xx;
    sum.syy += g * n.yy;
    sum.sxy += (kCentral ? g : g + g) * n.xy;
  }

  /// r eps_p = r D : sigma_p.
  DDEM_INLINE static Triple strain_from(const StepData& d, const Sums& sum) {
    return {d.compliance_direct * sum.sxx + d.compliance_coupling * sum.syy,
            d.compliance_coupling * sum.sxx + d.compliance_direct * sum.syy, (kCentral ? 1.0 : 0.5) * d.compliance_shear * sum.sxy};
  }

  template <bool kWatched>
  DDEM_INLINE static void relax_strain(const StepData& d, int p, const Triple& before, const Triple& e, Watch<kWatched>& watch) {
    const Triple next = combine(d.keep_strain, before, d.new_strain, e);
    watch.note_strain(next);
    store_triple(d.strain_next, p, next);
  }

  template <bool kWatched>
  DDEM_INLINE static void kick(const StepData& d, int p, const Sums& sum, Watch<kWatched>& watch) {
    const auto kicked = [p](double* velocity, const double* kick, Pack force) DDEM_INLINE_LAMBDA {
      const Pack v = load(velocity + p) + load(kick + p) * force;
      store(velocity + p, v);
      return v;
    };
    const Pack vx = kicked(d.vx, d.kick_x, sum.fx), vy = kicked(d.vy, d.kick_y, sum.fy);
    watch.note_velocity(vx, vy);
    if constexpr (kRotation) kicked(d.omega, d.kick_theta, kRotationalKick * sum.moment);
  }

  DDEM_INLINE static void drift_discs(const StepData& d, int p) {
    Triple moved{d.dt * load(d.vx + p), d.dt * load(d.vy + p), Pack{}};
    if constexpr (kRotation) moved.c = d.dt * load(d.omega + p);
    add_triple(d.motion, p, moved);
  }
  static void drift(const StepData& data, int begin, int end) {
    const StepData d = data;
    for (int p = begin * kWidth; p < end * kWidth; p += kWidth) drift_discs(d, p);
  }

  /// What the discs add to the elongation of their bonds; lagged: with the strains to come, -n.(u + s r eps.n).
  template <bool kLagged, bool kDrift>
  static void pull(const StepData& data, int begin, int end) {
    const StepData d = data;
    const auto turned = [](const Triple& t) DDEM_INLINE_LAMBDA { return Triple{-t.a, -t.b, -t.c}; };
    for_slices(
        d, begin, end,
        [&](int p) DDEM_INLINE_LAMBDA {
          if constexpr (kDrift) drift_discs(d, p);
          return Own{turned(load_triple(d.motion, p)), turned(load_triple(d.strain_next, p))};
        },
        [&d](int k, const Own& own, Sums&) DDEM_INLINE_LAMBDA {
          const State b = bond_at<Bond>(d, k);
          Vector v{own.motion.a, own.motion.b};
          if constexpr (kLagged) {
            const Vector strained = boundary(b, own.strain);
            v.x += strained.x, v.y += strained.y;
          }
          store(d.pull + k, b.nx * v.x + b.ny * v.y);
        },
        [](int, const Own&, const Sums&) {});
  }

  /// The approach of the boundaries by the strain e of the discs p .. p + 7 alone, on each of their bonds.
  DDEM_INLINE static void press(const StepData& d, int p, const Triple& e, double* to) {
    for_slices(
        d, p / kWidth, p / kWidth + 1, [&e](int) DDEM_INLINE_LAMBDA { return Triple{e.a, e.b, e.c + e.c}; },
        [&d, to](int k, const Triple& own, Sums&) DDEM_INLINE_LAMBDA {
          store(to + k, (own.a * load(d.dyad_xx + k) + own.b * load(d.dyad_yy + k)) + own.c * load(d.dyad_xy + k));
        },
        [](int, const Triple&, const Sums&) {});
  }
  static void press_next(const StepData& data, int begin, int end) {
    const StepData d = data;
    for (int p = begin * kWidth; p < end * kWidth; p += kWidth) press(d, p, load_triple(d.strain_next, p), d.press_next);
  }

  /// What a row of bonds adds under the displacements and strains at hand.
  template <bool kForce, bool kStress>
  DDEM_INLINE static auto moved(const StepData& d) {
    return [&d](int k, const Own& own, Sums& sum) DDEM_INLINE_LAMBDA {
      add<kForce, kStress>(d, deformed(d, k, own), k, sum);
    };
  }

  /// What a row of bonds adds by what both of its ends have written.
  template <bool kForce, bool kStress>
  DDEM_INLINE static void add_shares(const StepData& d, const double* shares, int k, Sums& sum) {
    const Pack f_n = Bond::normal(d, k) * both_ends(d, shares, k);
    if constexpr (kForce) sum.fx += f_n * load(d.nx + k), sum.fy += f_n * load(d.ny + k);
    if constexpr (kStress) {
      sum.sxx += f_n * load(d.dyad_xx + k), sum.syy += f_n * load(d.dyad_yy + k), sum.sxy += f_n * load(d.dyad_xy + k);
    }
  }

  /// Under the strains alone: overlaps G eps, whose stress gives T eps, or whose force is what the discs' strains take off.
  template <bool kForce, bool kStress>
  DDEM_INLINE static auto strained(const StepData& d) {
    return [&d](int k, const Triple& own, Sums& sum) DDEM_INLINE_LAMBDA {
      if constexpr (kPulls) return add_shares<kForce, kStress>(d, d.press, k, sum);
      const State b = bond_at<Bond>(d, k);
      const Pack k_n = Bond::normal(d, k);
      const Triple other = gather(d.strain, d.neighbour + k);
      if constexpr (kStrain == StrainCoupling::full) {
        // k_n n (n.v) + k_t t (t.v), where the second part is k_t (v - n (n.v)).
        const Vector v = approach(b, own, other);
        const Pack k_t = Bond::shear(d, k), g = (k_n - k_t) * (b.nx * v.x + b.ny * v.y);
        const Pack fx = k_t * v.x + g * b.nx, fy = k_t * v.y + g * b.ny;
        if constexpr (kStress) add_stress(b, fx, fy, sum);
        if constexpr (kForce) {
          sum.fx += fx, sum.fy += fy;
          sum.moment += b.stretch * (k_t * (b.nx * v.y - b.ny * v.x));
        }
      } else {
        const Dyad n = dyad(b);
        const Pack f_n = k_n * normal_approach(b, n, own, other);
        if constexpr (kStress) add_normal_stress(b, n, f_n, sum);
        if constexpr (kForce) sum.fx += f_n * b.nx, sum.fy += f_n * b.ny;
      }
    };
  }

  /// Forces from the strains at hand; lagged: and from these forces the strains to come.
  template <bool kLagged, bool kWatched>
  static void step(const StepData& data, int begin, int end) {
    const StepData d = data;  // pointers in registers: no store can change them
    Watch<kWatched> watch;
    for_slices(
        d, begin, end, [&d](int p) DDEM_INLINE_LAMBDA { return own_state(d, p); }, moved<true, kLagged>(d),
        [&d, &watch](int p, const Own& own, const Sums& sum) DDEM_INLINE_LAMBDA {
          kick(d, p, sum, watch);
          if constexpr (kLagged) relax_strain(d, p, own.strain, strain_from(d, sum), watch);
        });
    watch.tell_speed(d);
    if constexpr (kLagged) watch.tell_strain(d);
  }

  template <bool kWatched>
  static void evaluate(const StepData& data, int begin, int end) {
    const StepData d = data;
    Watch<kWatched> watch;
    for_slices(
        d, begin, end, [&d](int p) DDEM_INLINE_LAMBDA { return own_state(d, p); }, moved<false, true>(d),
        [&d, &watch](int p, const Own& own, const Sums& sum) DDEM_INLINE_LAMBDA {
          relax_strain(d, p, own.strain, strain_from(d, sum), watch);
        });
    watch.tell_strain(d);
  }

  /// f = (V C)^-1 S K C u, and the forces of rigid discs.
  static void source(const StepData& data, int begin, int end) {
    const StepData d = data;
    for_slices(
        d, begin, end, [&d](int p) DDEM_INLINE_LAMBDA { return load_triple(d.motion, p); },
        [&d](int k, const Triple& own, Sums& sum) DDEM_INLINE_LAMBDA {
          if constexpr (kPulls) return add_shares<true, true>(d, d.pull, k, sum);
          add<true, true>(d, rigid(d, k, own), k, sum);
        },
        [&d](int p, const Triple&, const Sums& sum) DDEM_INLINE_LAMBDA {
          store(d.rigid_fx + p, sum.fx);
          store(d.rigid_fy + p, sum.fy);
          if constexpr (kRotation) store(d.rigid_moment + p, sum.moment);
          const Triple e = strain_from(d, sum);
          store_triple(d.source, p, e);
          if constexpr (kPulls) press(d, p, e, d.press);
        });
  }

  /// The next approximation, by the residual f - eps - T eps; the first from eps = f.
  template <bool kWatched, bool kFirst>
  static void iterate(const StepData& data, int begin, int end) {
    const StepData d = data;
    Watch<kWatched> watch;
    for_slices(
        d, begin, end, [&d](int p) DDEM_INLINE_LAMBDA { return load_triple(d.strain, p); }, strained<false, true>(d),
        [&d, &watch](int p, const Triple& e, const Sums& sum) DDEM_INLINE_LAMBDA {
          const Triple known = combine(d.of_strain, e, d.of_source, kFirst ? e : load_triple(d.source, p));
          const Triple next = along(known, -d.of_coupling, strain_from(d, sum));
          watch.note_strain(next);
          store_triple(d.strain_next, p, next);
          if constexpr (kPulls) press(d, p, next, d.press_next);
        });
    watch.tell_strain(d);
  }

  /// The kick by the forces of rigid discs, less what the strains take off them.
  template <bool kWatched>
  static void respond(const StepData& data, int begin, int end) {
    const StepData d = data;
    Watch<kWatched> watch;
    for_slices(
        d, begin, end, [&d](int p) DDEM_INLINE_LAMBDA { return load_triple(d.strain, p); }, strained<true, false>(d),
        [&d, &watch](int p, const Triple&, const Sums& off) DDEM_INLINE_LAMBDA {
          Sums sum;
          sum.fx = load(d.rigid_fx + p) - off.fx;
          sum.fy = load(d.rigid_fy + p) - off.fy;
          if constexpr (kRotation) sum.moment = load(d.rigid_moment + p) - off.moment;
          kick(d, p, sum, watch);
        });
    watch.tell_speed(d);
  }

  /// Conjugate gradients for (1 + T) eps = f, preconditioned with V C, in whose inner product 1 + T is symmetric:
  /// the residual r = f - T eps - eps of the strains at hand, the first direction, and the products <r, r>, <f - T eps,
  /// f - T eps> to compare it with.
  static void residual(const StepData& data, int begin, int end) {
    const StepData d = data;
    for_slices(
        d, begin, end, [&d](int p) DDEM_INLINE_LAMBDA { return own_state(d, p); }, moved<false, true>(d),
        [&d](int p, const Own& own, const Sums& sum) DDEM_INLINE_LAMBDA {
          const Triple s = strain_from(d, sum), r = difference(s, own.strain);
          store_triple(d.source, p, r);
          store_triple(d.direction, p, r);
          store(d.product + p, inner(d, r, r));
          store(d.scale + p, inner(d, s, s));
        });
  }

  /// q = (1 + T) direction and <direction, q>.
  static void apply(const StepData& data, int begin, int end) {
    StepData d = data;
    d.strain = d.direction;
    for_slices(
        d, begin, end, [&d](int p) DDEM_INLINE_LAMBDA { return load_triple(d.strain, p); }, strained<false, true>(d),
        [&d](int p, const Triple& e, const Sums& sum) DDEM_INLINE_LAMBDA {
          const Triple t = strain_from(d, sum), q{e.a + t.a, e.b + t.b, e.c + t.c};
          store_triple(d.applied, p, q);
          store(d.product + p, inner(d, e, q));
        });
  }

  /// The next strains and their residual, by the step length along the direction; <r, r>.
  static void advance(const StepData& data, int begin, int end) {
    const StepData d = data;
    for (int p = begin * kWidth; p < end * kWidth; p += kWidth) {
      store_triple(d.strain_next, p, along(load_triple(d.strain, p), d.step_length, load_triple(d.direction, p)));
      const Triple r = along(load_triple(d.source, p), -d.step_length, load_triple(d.applied, p));
      store_triple(d.source, p, r);
      store(d.product + p, inner(d, r, r));
    }
  }

  /// The next direction: the residual, conjugate to the directions before.
  static void turn(const StepData& data, int begin, int end) {
    const StepData d = data;
    for (int p = begin * kWidth; p < end * kWidth; p += kWidth) {
      store_triple(d.direction, p, along(load_triple(d.source, p), d.direction_weight, load_triple(d.direction, p)));
    }
  }

  /// V_p x : C_p : y.
  DDEM_INLINE static Pack inner(const StepData& d, const Triple& x, const Triple& y) {
    return d.elasticity_direct * (x.a * y.a + x.b * y.b) + d.elasticity_coupling * (x.a * y.b + x.b * y.a) +
           d.elasticity_shear * (x.c * y.c);
  }

  static StepKernels kernels(const StepFeatures& f) { return f.watched ? chosen<true>(f) : chosen<false>(f); }

  template <bool kWatched>
  static StepKernels chosen(const StepFeatures& f) {
    StepKernels k;
    k.drift = &drift;
    if constexpr (kDeformable) {
      if constexpr (Kinematics::kLinear) {
        if (f.implicit) {
          k.step = &step<false, kWatched>;
          k.source = &source, k.respond = &respond<kWatched>;
          k.first_iterate = &iterate<kWatched, true>, k.iterate = &iterate<false, false>, k.last_iterate = &iterate<kWatched, false>;
          if constexpr (kPulls) {
            k.drift = &pull<false, true>, k.pull = &pull<false, false>, k.press = &press_next;
            return k;
          }
          k.residual = &residual, k.apply = &apply, k.advance = &advance, k.turn = &turn;
          return k;
        }
      }
      k.step = &step<true, kWatched>;
      if constexpr (kPulls) {
        k.drift = &pull<true, true>, k.pull = &pull<true, false>;
      } else {
        k.evaluate = &evaluate<kWatched>;
      }
    } else {
      k.step = &step<false, kWatched>;
    }
    return k;
  }
};

}  // namespace
}  // namespace ddem::DDEM_ISA
