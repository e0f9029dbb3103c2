#pragma once
// Exact stability limits of the infinite hexagonal lattice of equal touching discs.

#include "harness/references/effective_moduli.h"

namespace ddem::references {

/// The largest k_n/(E h) for which the fixed point of the lagged scheme, F <- K (u - B F), converges
/// (rho(K B) < 1), E and nu the disc's plane constants:
///   min( pi/(6 (1 - nu)), pi/(3 (1 + nu) c) ),  c = 1 for N and NN, 1 + lambda for F.
/// The two bounds are the breathing and the shearing mode, uniform over the lattice: a disc's strain answers
/// the strains of its neighbours by A/(2 phi 2K_p) and A c/(4 phi 2G_p). A limit of the *static* iteration:
/// near the critical time step the lagged scheme fails earlier. std::invalid_argument for ContactModel::dem,
/// which has none.
double hexagonal_fixed_point_limit(ContactModel model, double poisson_ratio, double stiffness_ratio);

/// rho(K B) of the lattice: k_n/(E h) over the limit above.
double hexagonal_fixed_point_radius(ContactModel model, const Contact& contact, const Disc& disc);

/// With the published correction (N), lagged, the hexagonal lattice is unstable at any k_n/E_p above this
/// k_t/k_n.
inline constexpr double hexagonal_normal_ratio_limit = 1.0 / 3.0;

/// Critical time step (s) of plain DEM with k_t = 0: 2/omega_max, omega_max^2 = 6 k_n/m, by Bloch waves: the
/// three bonds' stiffness sum_b 4 k_n sin^2(k.d_b/2) n_b n_b is largest where two of the three sines are 1.
double hexagonal_critical_step(double normal_stiffness, double mass);

}  // namespace ddem::references
