#include "dem/spectra/gauss_quadrature.h"

#include <algorithm>

#include "dem/spectra/dense_eigen.h"

namespace ddem {

Quadrature gauss_quadrature(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply, const Eigen::VectorXd& s, int n) {
  // What is left of a vector whose every component is known is round-off.
  constexpr double exhausted = 1e-12;
  const Eigen::Index most = std::min<Eigen::Index>(n, s.size());
  if (most == 0 || s.norm() == 0.0) return {};
  Eigen::MatrixXd basis(s.size(), most);
  Eigen::VectorXd diagonal(most), beside(most);
  basis.col(0) = s.normalized();
  Eigen::Index m = 0;
  for (double scale = 0.0; m < most;) {
    Eigen::VectorXd next = apply(basis.col(m));
    diagonal[m] = basis.col(m).dot(next);
    scale = std::max(scale, next.norm());
    ++m;
    for (int pass = 0; pass < 2; ++pass) next -= basis.leftCols(m) * (basis.leftCols(m).transpose() * next);
    const double rest = next.norm();
    if (m == most || !(rest > exhausted * scale)) break;
    beside[m - 1] = rest;
    basis.col(m) = next / rest;
  }
  const SymmetricPairs jacobi = tridiagonal_pairs(diagonal.head(m), beside.head(m - 1), "Gauss quadrature");
  return {jacobi.values, jacobi.vectors.row(0).cwiseAbs2().transpose()};
}

}  // namespace ddem
