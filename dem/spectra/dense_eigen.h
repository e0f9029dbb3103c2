#pragma once
// Eigenvalues of dense matrices by Eigen, compiled once: its solvers take longer to compile than all that call them.

#include <Eigen/Core>

namespace ddem {

/// Column k of `vectors` belongs to `values[k]`, in no order.
struct EigenPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};

/// Of real ones from the smallest upwards, the vectors orthonormal.
struct SymmetricPairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

// All throw std::runtime_error "`what`: the eigenvalues did not converge".

/// Symmetric or self-adjoint `a`, whose lower half is read: from the smallest upwards.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a, const char* what);
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXcd& a, const char* what);
SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& a, const char* what);
/// Of the symmetric tridiagonal matrix with `diagonal` and, one shorter, what stands `beside` it.
SymmetricPairs tridiagonal_pairs(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& beside, const char* what);

/// Any square matrix.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a, const char* what);
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXcd& a, const char* what);
EigenPairs eigen_pairs(const Eigen::MatrixXd& a, const char* what);
EigenPairs eigen_pairs(const Eigen::MatrixXcd& a, const char* what);

}  // namespace ddem
