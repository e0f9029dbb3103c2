// The laws of one bond, for eight discs at once: overlaps by linear or nonlinear kinematics, stiffness and arms the same
// for all bonds or bond by bond, and what a disc's uniform strain adds. Pointwise; the loop that applies them is in
// step_kernel.h. Include only from there.

#include "dem/kernel/pack.h"
#include "dem/kernel/step_data.h"

namespace ddem::DDEM_ISA {
namespace {

/// Overlaps of a row of bonds, their current normals, and their arms over the radii.
template <class Stretch>
struct BondState {
  Pack nx, ny;
  Stretch stretch;
  Pack u_n, u_t;
};

/// The arms of discs that touch: products with it cost nothing.
struct One {};
DDEM_INLINE Pack operator*(One, Pack x) { return x; }

/// A vector of the plane.
struct Vector {
  Pack x, y;
};

/// Bonds with arms of their own, which are zero where a row is filled up.
struct StretchedBonds {
  using State = BondState<Pack>;
  DDEM_INLINE static Pack stretch(const StepData& d, int k) { return load_once(d.stretch + k); }
  /// By how much the two discs roll apart.
  DDEM_INLINE static Pack roll(const State& b, Pack rotations) { return b.stretch * rotations; }
};
/// Between discs that touch. What fills up a row has no normal, and so gives no force; nor must it roll.
struct TouchingBonds {
  using State = BondState<One>;
  DDEM_INLINE static One stretch(const StepData&, int) { return {}; }
  DDEM_INLINE static Pack roll(const State& b, Pack rotations) { return unless_zero(b.nx, b.ny, rotations); }
};

/// k_n and k_t of the row's bonds.
template <class Bonds>
struct UniformStiffness : Bonds {
  DDEM_INLINE static Pack normal(const StepData& d, int) { return all(d.normal_stiffness); }
  DDEM_INLINE static Pack shear(const StepData& d, int) { return all(d.shear_stiffness); }
};
struct BondStiffness : StretchedBonds {
  DDEM_INLINE static Pack normal(const StepData& d, int k) { return load(d.bond_stiffness + k); }
  DDEM_INLINE static Pack shear(const StepData& d, int k) { return d.stiffness_ratio * load(d.bond_stiffness + k); }
};

template <class Bond>
DDEM_INLINE typename Bond::State bond_at(const StepData& d, int k) {
  return {load_once(d.nx + k), load_once(d.ny + k), Bond::stretch(d, k), Pack{}, Pack{}};
}

/// theory section 1: small displacement, the geometry of the start. `k`: the row's first half-bond; u: displacement of the
/// other disc less the own; roll: r theta.
struct LinearKinematics {
  static constexpr bool kLinear = true;

  template <class Bond, bool kRotation>
  DDEM_INLINE static typename Bond::State overlaps(const StepData& d, int k, const Vector& u, Pack roll_own, Pack roll_other) {
    auto b = bond_at<Bond>(d, k);
    b.u_n = b.nx * u.x + b.ny * u.y;
    // The sum of the two rotations first: symmetric in the two ends, so both ends of a bond get the same bits.
    if constexpr (kRotation) b.u_t = (b.nx * u.y - b.ny * u.x) - Bond::roll(b, roll_own + roll_other);
    return b;
  }
};

/// Current geometry; the slip is summed from step to step along the current tangent:
/// du_t = L (d alpha - d(w_i theta_i + w_j theta_j)), alpha the angle of the bond, w = a / L.
struct NonlinearKinematics {
  static constexpr bool kLinear = false;

  template <class Bond, bool kRotation>
  DDEM_INLINE static typename Bond::State overlaps(const StepData& d, int k, const Vector& u, Pack roll_own, Pack roll_other) {
    auto b = bond_at<Bond>(d, k);
    const Pack l0 = load(d.length + k), x0 = l0 * b.nx, y0 = l0 * b.ny;
    const Pack x = x0 + u.x, y = y0 + u.y, l = square_root(x * x + y * y);
    const Pack elongation = l / l0;
    const Pack rotation = b.stretch * (roll_own + roll_other) / l0;
    b = {x / l, y / l, b.stretch * elongation, Pack{}, Pack{}};
    // L - L0 without the cancellation.
    b.u_n = (2.0 * (x0 * u.x + y0 * u.y) + (u.x * u.x + u.y * u.y)) / (l + l0);
    if constexpr (kRotation) {
      const Pack dx = load(d.previous_dx + k), dy = load(d.previous_dy + k);
      const Pack px = x0 + dx, py = y0 + dy, pl = square_root(px * px + py * py);
      const Pack sine = (px * (u.y - dy) - py * (u.x - dx)) / (pl * l);
      // asin to the fifth power: the rest is 1e-15 of a turn by 5e-3, 1e-11 of one by 0.03. A step turns no bond further, and
      // where the start does, the whole turn is in the slip already (simulation/stepper_start.cc).
      const Pack s2 = sine * sine;
      const Pack turn = sine * (1.0 + s2 * (1.0 / 6.0 + s2 * (3.0 / 40.0)));
      b.u_t = load(d.slip + k) + 0.5 * (l + pl) * (turn - (rotation - load(d.previous_rotation + k)));
      store(d.slip + k, b.u_t);
      store(d.previous_dx + k, u.x);
      store(d.previous_dy + k, u.y);
      store(d.previous_rotation + k, rotation);
    }
    return b;
  }
};

/// How far a disc's strain moves its boundary at the contact: a eps.n.
template <class Stretch>
DDEM_INLINE Vector boundary(const BondState<Stretch>& b, const Triple& e) {
  return {b.stretch * (e.a * b.nx + e.c * b.ny), b.stretch * (e.c * b.nx + e.b * b.ny)};
}

/// How far the boundaries of the two discs move towards each other there: (a_i eps_i + a_j eps_j).n, whose normal
/// and tangential parts a n.eps.n and a t.eps.n are taken from the overlaps. The same bits from either end.
template <class Stretch>
DDEM_INLINE Vector approach(const BondState<Stretch>& b, const Triple& own, const Triple& other) {
  return boundary(b, Triple{own.a + other.a, own.b + other.b, own.c + other.c});
}

/// n (x) n.
struct Dyad {
  Pack xx, yy, xy;
};
template <class Stretch>
DDEM_INLINE Dyad dyad(const BondState<Stretch>& b) {
  return {b.nx * b.nx, b.ny * b.ny, b.nx * b.ny};
}

/// The normal part of that.
template <class Stretch>
DDEM_INLINE Pack normal_approach(const BondState<Stretch>& b, const Dyad& n, const Triple& own, const Triple& other) {
  const Pack xy = own.c + other.c;
  return b.stretch * (n.xx * (own.a + other.a) + n.yy * (own.b + other.b) + n.xy * (xy + xy));
}

}  // namespace
}  // namespace ddem::DDEM_ISA
