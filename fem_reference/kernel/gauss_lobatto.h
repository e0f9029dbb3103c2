#pragma once
// Gauss-Lobatto points: nodes of the elements and points of their quadrature at once, which makes the mass
// diagonal (spectral elements).

#include <vector>

namespace ddem::fem {

inline constexpr int max_degree = 8;

/// The rule of degree + 1 points on [0, 1]: end points included, weights summing to 1, exact for
/// polynomials up to degree 2 * degree - 1.
struct GaussLobatto {
  std::vector<double> points;
  std::vector<double> weights;
  /// (degree+1)^2, row-major: derivative[q * (degree+1) + k] is the slope at point q of the Lagrange
  /// polynomial of point k.
  std::vector<double> derivative;
};

/// Throws std::invalid_argument unless 1 <= degree <= max_degree.
GaussLobatto gauss_lobatto(int degree);

/// The degree + 1 Lagrange polynomials on `points`, all at `x`.
std::vector<double> lagrange_values(const std::vector<double>& points, double x);

}  // namespace ddem::fem
