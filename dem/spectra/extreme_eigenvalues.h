#pragma once
// Extreme eigenvalues of operators that are given as functions, by Lanczos and Arnoldi iteration.

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <optional>

namespace ddem {

struct LinearOperator {
  using Scalar = double;
  using In = const Eigen::Ref<const Eigen::VectorXd>&;
  using Out = Eigen::Ref<Eigen::VectorXd>;
  Eigen::Index size;
  std::function<void(In x, Out y)> apply;  ///< y = A x; x and y are apart

  Eigen::VectorXd operator*(In x) const {
    Eigen::VectorXd y(size);
    apply(x, y);
    return y;
  }
  // What Spectra asks for.
  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* x, double* y) const {
    apply(Eigen::Map<const Eigen::VectorXd>(x, size), Eigen::Map<Eigen::VectorXd>(y, size));
  }
};

/// Largest eigenvalue of a symmetric operator. The residual is r = 1e-5 of the eigenvalue at most, and the eigenvalue then
/// right to about r^2 or better; small problems are solved as matrices. `what` names it in errors: throws
/// std::runtime_error if the iteration does not converge. Needs an unknown.
double largest_eigenvalue(LinearOperator op, const char* what);

/// Largest magnitude of the eigenvalues of any operator; residual 1e-5 of it. Otherwise as above.
double largest_magnitude(LinearOperator op, const char* what);

struct EigenPair {
  std::complex<double> value;
  Eigen::VectorXcd vector;
};

/// The pair of largest magnitude of an operator that is dear to apply and whose other eigenvalues lie within the unit
/// circle: Arnoldi's iteration without restarts, from a fixed start. None if after 16 applications no Ritz value lies
/// beyond `outside` (> 1), else as many as bring its residual to 1e-3, 60 at most.
/// Spectra's iteration answers only what has converged, and would restart in vain where nothing stands out.
std::optional<EigenPair> outstanding_eigenvector(const LinearOperator& op, double outside);

}  // namespace ddem
