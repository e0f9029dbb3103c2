#pragma once
// The laws of one bond (theory section 1), pointwise and pure. A disc is a row of numbers: ux, uy, theta, and with strains
// eps_xx, eps_yy, eps_xy and the sums s (x) F: xx, yy, xy. They read the same from either end of a bond, to the last bit.

#include <cmath>

#include "dem/core/material.h"

namespace ddem::lammps {

enum Column { kUx, kUy, kTheta, kStrain, kStress = kStrain + 3, kMotionColumns = kStrain, kAllColumns = kStress + 3 };

/// Of the reference: the unit normal from i to j, and the arms, a_i + a_j = L.
struct BondGeometry {
  double nx, ny, arm_i, arm_j;
  int j;
};

/// With the normal and the arms that the kinematics make of it.
struct Overlap {
  double nx, ny, arm_i, arm_j;
  double u_n, u_t;
};

struct BondForce {
  double normal, shear;  ///< F_n, F_t
  double x, y;           ///< on i; -F on j
};

// Each source that includes this has functions of its own: those of bond_sweeps.cc are for an instruction set each.
namespace {

/// u_n = n.(u_j - u_i), u_t = t.(u_j - u_i) - a_i theta_i - a_j theta_j, by the geometry of the reference.
inline Overlap linear_overlap(const BondGeometry& b, const double* disc_i, const double* disc_j) {
  const double dx = disc_j[kUx] - disc_i[kUx], dy = disc_j[kUy] - disc_i[kUy];
  return {b.nx, b.ny, b.arm_i, b.arm_j, b.nx * dx + b.ny * dy, (b.nx * dy - b.ny * dx) - (b.arm_i * disc_i[kTheta] + b.arm_j * disc_j[kTheta])};
}

/// The vector from i to j and the turns of the two discs there, w_i theta_i + w_j theta_j, w = a / L of the reference.
struct Placement {
  double x, y, length, rotation;
};

inline Placement placed(const BondGeometry& b, const double* disc_i, const double* disc_j) {
  const double l0 = b.arm_i + b.arm_j;
  const double x = l0 * b.nx + (disc_j[kUx] - disc_i[kUx]), y = l0 * b.ny + (disc_j[kUy] - disc_i[kUy]);
  return {x, y, std::sqrt(x * x + y * y), (b.arm_i * disc_i[kTheta] + b.arm_j * disc_j[kTheta]) / l0};
}

/// Slip of a step from the bond's place before it: du_t = L (d alpha - d(w_i theta_i + w_j theta_j)), alpha the angle of the
/// bond; `dx`, `dy`: what (u_j - u_i) grew by, with more digits than the difference of the places has.
inline double slip_of_step(const Placement& before, const Placement& now, double dx, double dy) {
  const double cross = before.x * dy - before.y * dx, dot = before.x * now.x + before.y * now.y;
  return 0.5 * (now.length + before.length) * (std::atan2(cross, dot) - (now.rotation - before.rotation));
}

/// Current geometry; `slip`: summed from step to step.
inline Overlap nonlinear_overlap(const BondGeometry& b, const double* disc_i, const double* disc_j, const Placement& now, double slip) {
  const double l0 = b.arm_i + b.arm_j, dx = disc_j[kUx] - disc_i[kUx], dy = disc_j[kUy] - disc_i[kUy];
  const double elongation = now.length / l0;
  // L - L0 without the cancellation.
  const double u_n = (2.0 * l0 * (b.nx * dx + b.ny * dy) + (dx * dx + dy * dy)) / (now.length + l0);
  return {now.x / now.length, now.y / now.length, b.arm_i * elongation, b.arm_j * elongation, u_n, slip};
}

/// The boundaries of the two discs approach each other by (a_i eps_i + a_j eps_j).n at the contact.
template <Correction kCorrection>
void correct(Overlap& o, const double* disc_i, const double* disc_j) {
  const double xx = o.arm_i * disc_i[kStrain] + o.arm_j * disc_j[kStrain];
  const double yy = o.arm_i * disc_i[kStrain + 1] + o.arm_j * disc_j[kStrain + 1];
  const double xy = o.arm_i * disc_i[kStrain + 2] + o.arm_j * disc_j[kStrain + 2];
  const double x = xx * o.nx + xy * o.ny, y = xy * o.nx + yy * o.ny;
  o.u_n -= o.nx * x + o.ny * y;
  if constexpr (kCorrection == Correction::full) o.u_t -= o.nx * y - o.ny * x;
}

/// F = k_n u_n n + k_t u_t t, t = (-n_y, n_x).
inline BondForce force_of(const Overlap& o, double k_n, double k_t) {
  const double normal = k_n * o.u_n, shear = k_t * o.u_t;
  return {normal, shear, normal * o.nx - shear * o.ny, normal * o.ny + shear * o.nx};
}

/// n (x) F, symmetrised: times the arm of either end it is that disc's s (x) F.
struct Dyad {
  double xx, yy, xy;
};

template <Correction kCorrection>
Dyad dyad_of(const Overlap& o, const BondForce& f) {
  if constexpr (kCorrection == Correction::normal_only_stress) {
    const double x = f.normal * o.nx, y = f.normal * o.ny;
    return {o.nx * x, o.ny * y, o.nx * y};
  }
  return {o.nx * f.x, o.ny * f.y, 0.5 * (o.nx * f.y + o.ny * f.x)};
}

}  // namespace
}  // namespace ddem::lammps
