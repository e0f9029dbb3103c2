#pragma once
// Chebyshev iteration for (1 + T) x = f with the eigenvalues of T in [0, rho]: which weights, how many iterations.

#include <vector>

namespace ddem {

/// x_1 = d_0 = first f; then d_k = change d_{k-1} + residual (f - (1 + T) x_k), x_{k+1} = x_k + d_k.
/// (Saad, Iterative methods for sparse linear systems, algorithm 12.1.)
struct ChebyshevWeights {
  double first = 0.0;  ///< of the first approximation only
  double change = 0.0, residual = 0.0;
};

/// Weights of the first approximation (entry 0) and of each iteration after it, as many as make the effective stiffness
/// (1 - T p(T)) of every mode right within `tolerance` of itself: its relative error is t r(t), r the residual
/// polynomial, |r| <= 1 / T_m((2 + rho) / rho) after m approximations.
/// Throws std::invalid_argument unless rho is finite and not negative, and tolerance in (0, 0.5): below that the
/// effective stiffness stays positive.
std::vector<ChebyshevWeights> chebyshev_weights(double rho, double tolerance);

}  // namespace ddem
