#pragma once
// The polynomial that stands for (1 + T)^-1 in implicit strains, the eigenvalues of T in [0, rho].
//
// eps = p(T) f makes the stiffness of a mode with eigenvalue t wrong by the fraction q(t) = t r(t), r the residual
// polynomial 1 - (1 + t) p(t), r(-1) = 1. So q has degree m + 1, q(0) = 0 and q(-1) = -1, and is to be small on [0, rho]:
// a Chebyshev polynomial whose first and last zeros are 0 and rho. (That q(rho) vanishes too costs a tenth of the bound;
// in return the modes of the largest t, which are long waves, are exact.) Its zeros t_k but 0 are those of r: a product of
// m relaxations, eps <- eps + w_k (f - (1 + T) eps) with w_k = 1 / (1 + t_k), from eps = 0.

#include <vector>

namespace ddem {

/// The weights w_k, as many as make the stiffness of every mode right within `tolerance` of itself, ordered (Leja) so
/// that round-off does not grow on the way.
/// Throws std::invalid_argument unless rho is finite and not negative and tolerance in (0, 0.5) (below that the effective
/// stiffness stays positive), and where it would take more than 2000 terms.
std::vector<double> strain_relaxations(double rho, double tolerance);

}  // namespace ddem
