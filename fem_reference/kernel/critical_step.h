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

}  // namespace ddem::fem
