#pragma once
// The paper's trigger, exactly: the discs of the left edge are displaced and let go.

#include <vector>

namespace ddem::references {

/// Displacement u_j/amplitude of columns j = 0 .. columns-1 at the dimensionless time tau >= 0. Hexagonal
/// lattice with close-packed rows along y, periodic in y, k_t = 0, free left edge, column 0 displaced by the
/// amplitude at rest: columns move as a chain with nearest-neighbour springs, and before the right end has
/// answered
///   u_j/A = J_2j(tau) + J_2j+2(tau),
/// the infinite chain's J_2j and the image of the free end at column -1.
std::vector<double> column_release(int columns, double tau);

/// tau = t sqrt(2 k_n/m): a column of discs moves along y, adjacent columns are joined by two bonds a disc at
/// 60 degrees to it: stiffness k_n/2, omega_max = 2 sqrt(k_n/(2 m)).
double column_shear_rate(double normal_stiffness, double mass);

/// tau = t sqrt(6 k_n/m): along x the same bonds have the stiffness 3 k_n/2.
double column_p_rate(double normal_stiffness, double mass);

/// Phase speed over long-wave speed of a chain with nearest-neighbour springs: sin(q)/q, q = k a/2, a the
/// spacing of columns (sqrt(3) r here). 1 - (k a)^2/24 for long waves. Throws std::invalid_argument unless 0
/// <= k a <= pi, the first Brillouin zone.
double chain_phase_speed(double wave_number_times_spacing);

}  // namespace ddem::references
