#pragma once
// Eigenvalues, products and least squares of dense matrices by Eigen, compiled once: they take longer to compile than all that
// calls them.

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

/// `basis` * `form` * the basis transposed: a form of one row below the diagonal, an orthogonal basis.
struct Hessenberg {
  Eigen::MatrixXd form, basis;
};
Hessenberg hessenberg(const Eigen::MatrixXd& a);

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The x of the least |a x - b|, column by column, and of several such x the smallest.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace ddem
