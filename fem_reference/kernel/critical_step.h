#pragma once
// The largest stable time step of the leapfrog scheme, 2/omega_max, from the sharp largest eigenvalue of
// M^-1 K on the free degrees of freedom.

#include <cstdint>
#include <span>

#include "fem_reference/kernel/elastic_operator.h"

namespace ddem::fem {

/// Relative width of the interval that must hold omega_max^2 before the iteration ends.
inline constexpr double eigenvalue_tolerance = 2e-4;

/// omega_max^2 (1/s^2) from above, by at most eigenvalue_tolerance: Lanczos on M^-1/2 K M^-1/2, the largest
/// Ritz value plus its residual. `inverse_mass` has vector_size() entries, 0 where the degree of freedom is
/// fixed. Deterministic; several processes come to the same end as one (to round-off) if `node_keys` numbers every node
/// as one process would, or in any other way that does not depend on how many there are. Throws std::runtime_error if the iteration does not converge,
/// std::invalid_argument if nothing is free.
double largest_squared_frequency(const ElasticOperator& stiffness, std::span<const double> inverse_mass,
                                 std::span<const std::uint64_t> node_keys = {});

/// 2/omega_max in seconds, from below by at most eigenvalue_tolerance/2.
double critical_time_step(const ElasticOperator& stiffness, std::span<const double> inverse_mass,
                          std::span<const std::uint64_t> node_keys = {});

/// nx x ny equal rectangles of hx x hy (m), free all around but for periodic edges above and below.
struct RectangleStrip {
  int degree = 1;
  unsigned nx = 1, ny = 1;
  double hx = 0.0, hy = 0.0;
  bool periodic = false;
};

/// Elements along x that are worth cutting into pieces.
inline constexpr unsigned columns_to_cut = 16;

/// 2/omega_max in seconds of a strip of columns_to_cut columns or more, from pieces of 8 to 15 columns with free ends:
/// stiffness and mass are sums over the pieces, hence omega_max^2 of the strip is at most the largest of theirs. From
/// below, whatever is held. Sharp where an end is free, as those of the pieces are: of 144 strips (degrees 1 to 8, nu to
/// 0.45, free and periodic, one end held or none) all but 8 are within 2e-4, bilinear elements with nu = 0.45 within
/// 1.5e-3. With both ends held it may be a tenth below. A fifth of the work of the whole.
/// The two sizes of pieces are work for two threads.
double critical_time_step(const RectangleStrip& strip, const PlaneMaterial& material, Team& team);

}  // namespace ddem::fem
