#pragma once
// The strain of an isotropic disc by what resists it: its change of area, and two shears. In these modes the compliance is a
// number each, and stays one where a stiffness does not: as nu_p tends to 1/2 in plane strain or to 1 in plane stress the area
// no longer changes, as it tends to -1 the shape does not.
//
//   eps_xx = (a + d)/sqrt(2),  eps_yy = (a - d)/sqrt(2),  eps_xy = s/sqrt(2)
//   energy per volume = (2 K_p a^2 + 2 G_p (d^2 + s^2))/2

#include <array>
#include <numbers>

#include "dem/core/material.h"

namespace ddem {

/// What is linear in (eps_xx, eps_yy, eps_xy) with these coefficients has those in (a, d, s).
inline std::array<double, 3> in_strain_modes(const std::array<double, 3>& c) {
  constexpr double half = 1.0 / std::numbers::sqrt2;
  return {half * (c[0] + c[1]), half * (c[0] - c[1]), half * c[2]};
}

/// 1/(2 K_p), 1/(2 G_p) and once more 1/(2 G_p), 1/Pa. Plane strain: the plane constants E/(1 - nu^2) and nu/(1 - nu) put in,
/// without their differences.
inline std::array<double, 3> mode_compliances(const DeformationParameters& p) {
  const double nu = p.poisson_ratio, shear = (1.0 + nu) / p.young_modulus;
  const double area = p.plane == Plane::strain ? shear * (1.0 - 2.0 * nu) : (1.0 - nu) / p.young_modulus;
  return {area, shear, shear};
}

/// d/d(nu_p) of the above.
inline std::array<double, 3> mode_compliance_rates(const DeformationParameters& p) {
  const double shear = 1.0 / p.young_modulus;
  return {p.plane == Plane::strain ? -(1.0 + 4.0 * p.poisson_ratio) * shear : -shear, shear, shear};
}

}  // namespace ddem
