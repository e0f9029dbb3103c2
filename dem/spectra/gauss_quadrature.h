#pragma once
// Gauss quadrature of a spectral measure by Lanczos' iteration.

#include <Eigen/Core>
#include <functional>

namespace ddem {

/// Nodes (increasing) and weights, which sum to 1.
struct Quadrature {
  Eigen::VectorXd nodes, weights;
};

/// For a symmetric operator A and a vector s: <s, f(A) s> / <s, s> = sum weights f(nodes), exact for polynomials up to
/// degree 2 n - 1. The nodes are the zeros of the polynomial of degree n that is orthogonal to all of lower degree in that
/// measure. Fewer than n nodes where the measure has no more; none for s = 0. Golub & Meurant 2010, section 4. Throws
/// std::runtime_error where they are not found.
Quadrature gauss_quadrature(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply, const Eigen::VectorXd& s, int n);

}  // namespace ddem
