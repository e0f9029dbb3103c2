#pragma once
// Plane elastic constants from wave speeds, with first-order propagation of independent standard deviations.

namespace ddem::harness {

struct Uncertain {
  double value = 0.0, stddev = 0.0;
};

/// All of these throw std::invalid_argument unless speeds and density are positive and finite and standard
/// deviations finite and not negative. Speeds in m/s, density (bulk, kg/m3), moduli in Pa.

/// E = rho c_bar^2.
Uncertain young_modulus_from_bar(double bulk_density, Uncertain bar_speed);

/// G = rho c_s^2.
Uncertain shear_modulus_from_shear(double bulk_density, Uncertain shear_speed);

/// M = rho c_p^2, what resists a P wave: K + G of plane elasticity, K + 4 G/3 of a solid.
Uncertain p_modulus_from_p(double bulk_density, Uncertain p_speed);

/// nu = c_bar^2/(2 c_s^2) - 1; d(nu) = 2 (1 + nu) (d_bar - d_s), d relative errors.
Uncertain poisson_ratio_from_bar_and_shear(Uncertain bar_speed, Uncertain shear_speed);

/// nu = 1 - 2 (c_s/c_p)^2, plane elasticity (c_p^2 = (K + G)/rho); d(nu) = 2 (1 - nu) (d_p - d_s).
Uncertain poisson_ratio_from_p_and_shear(Uncertain p_speed, Uncertain shear_speed);

}  // namespace ddem::harness
