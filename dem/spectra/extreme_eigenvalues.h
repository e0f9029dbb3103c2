#pragma once
// Extreme eigenvalues of operators that are given as functions, by Lanczos and Arnoldi iteration.

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

namespace ddem {

struct LinearOperator {
  using Scalar = double;
  Eigen::Index size;
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> apply;

  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, size) = apply(Eigen::Map<const Eigen::VectorXd>(x, size));
  }
};

/// Largest eigenvalue of a symmetric operator. The residual is r = 1e-5 of the eigenvalue at most, and the eigenvalue then
/// right to about r^2 or better. `what` names it in errors: throws std::invalid_argument for fewer than three unknowns,
/// std::runtime_error if the iteration does not converge.
double largest_eigenvalue(LinearOperator op, const char* what);

/// Largest magnitude of the eigenvalues of any operator; residual 1e-5 of it. Needs six unknowns; errors as above.
double largest_magnitude(LinearOperator op, const char* what);

struct EigenPair {
  std::complex<double> value;
  Eigen::VectorXcd vector;
};

/// Pairs of largest magnitude of an operator that is dear to apply, as far as they stand out of the rest: at most two, and
/// none if no one has converged to 1e-3 within 4 restarts (some 40 applications).
std::vector<EigenPair> outstanding_eigenvectors(LinearOperator op);

}  // namespace ddem
