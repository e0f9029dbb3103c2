// The laws of one bond, for eight discs at once: overlaps by linear or nonlinear kinematics, stiffness the same for all
// bonds or bond by bond, and what a disc's uniform strain adds. Pointwise; the loop that applies them is in
// step_kernel.h. Include only from there.

#include "dem/kernel/pack.h"
#include "dem/kernel/step_data.h"

namespace ddem::DDEM_ISA {
namespace {

/// Overlaps of a row of bonds and their current normals and arms.
struct BondState {
  Pack nx, ny, arm_own, arm_other;
  Pack u_n, u_t;
};

/// A vector of the plane.
struct Vector {
  Pack x, y;
};

DDEM_INLINE BondState bond_at(const StepData& d, int k) {
  return {load(d.nx + k), load(d.ny + k), load(d.arm_own + k), load(d.arm_other + k), Pack{}, Pack{}};
}

/// theory section 1: small displacement, the geometry of the start. `k`: the row's first half-bond; u: displacement of the
/// other disc less the own.
struct LinearKinematics {
  static constexpr bool kLinear = true;

  template <bool kRotation>
  DDEM_INLINE static BondState overlaps(const StepData& d, int k, const Vector& u, Pack theta_own, Pack theta_other) {
    BondState b = bond_at(d, k);
    b.u_n = b.nx * u.x + b.ny * u.y;
    // The sum of the two rotations first: symmetric in the two ends, so both ends of a bond get the same bits.
    if constexpr (kRotation) b.u_t = (b.nx * u.y - b.ny * u.x) - (b.arm_own * theta_own + b.arm_other * theta_other);
    return b;
  }
};

/// Current geometry; the slip is summed from step to step along the current tangent:
/// du_t = L (d alpha - d(w_i theta_i + w_j theta_j)), alpha the angle of the bond, w = a / L.
struct NonlinearKinematics {
  static constexpr bool kLinear = false;

  template <bool kRotation>
  DDEM_INLINE static BondState overlaps(const StepData& d, int k, const Vector& u, Pack theta_own, Pack theta_other) {
    BondState b = bond_at(d, k);
    const Pack l0 = load(d.length + k), x0 = l0 * b.nx, y0 = l0 * b.ny;
    const Pack x = x0 + u.x, y = y0 + u.y, l = square_root(x * x + y * y);
    const Pack stretch = l / l0;
    const Pack rotation = (b.arm_own * theta_own + b.arm_other * theta_other) / l0;
    b = {x / l, y / l, b.arm_own * stretch, b.arm_other * stretch, Pack{}, Pack{}};
    // L - L0 without the cancellation.
    b.u_n = (2.0 * (x0 * u.x + y0 * u.y) + (u.x * u.x + u.y * u.y)) / (l + l0);
    if constexpr (kRotation) {
      const Pack dx = load(d.previous_dx + k), dy = load(d.previous_dy + k);
      const Pack px = x0 + dx, py = y0 + dy, pl = square_root(px * px + py * py);
      const Pack sine = (px * (u.y - dy) - py * (u.x - dx)) / (pl * l);
      // asin to the fifth power: a step turns a bond by far less than 1e-2, where the rest is below 1e-15 of it.
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

/// How far the boundaries of the two discs move towards each other at the contact: (a_i eps_i + a_j eps_j).n, whose normal
/// and tangential parts a n.eps.n and a t.eps.n are taken from the overlaps. The same bits from either end.
DDEM_INLINE Vector approach(const BondState& b, const Triple& own, const Triple& other) {
  const Pack xx = b.arm_own * own.a + b.arm_other * other.a, yy = b.arm_own * own.b + b.arm_other * other.b,
             xy = b.arm_own * own.c + b.arm_other * other.c;
  return {xx * b.nx + xy * b.ny, xy * b.nx + yy * b.ny};
}

/// k_n and k_t of the row's bonds.
struct UniformStiffness {
  DDEM_INLINE static Pack normal(const StepData& d, int) { return all(d.normal_stiffness); }
  DDEM_INLINE static Pack shear(const StepData& d, int) { return all(d.shear_stiffness); }
};
struct BondStiffness {
  DDEM_INLINE static Pack normal(const StepData& d, int k) { return load(d.bond_stiffness + k); }
  DDEM_INLINE static Pack shear(const StepData& d, int k) { return d.stiffness_ratio * load(d.bond_stiffness + k); }
};

}  // namespace
}  // namespace ddem::DDEM_ISA
