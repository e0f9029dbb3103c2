#include "dem/spectra/extreme_eigenvalues.h"

#include <Spectra/GenEigsSolver.h>
#include <Spectra/SymEigsSolver.h>
#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>

#include "dem/spectra/dense_eigen.h"

namespace ddem {
namespace {

constexpr Eigen::Index kMostIterations = 2000;

/// The residual asked for, over the eigenvalue: an eigenvalue is off by less than it, and by about its square where the
/// next one is apart. The largest ones of a large assembly lie so close together that 1e-5 would take minutes.
double residual_of(Eigen::Index unknowns) { return unknowns <= 20000 ? 1e-5 : 1e-3; }

// Up to so many unknowns the matrix itself is solved. Lanczos breaks down on operators of small rank, as those of a few
// bonded discs are, and Spectra then answers with a wrong number; beyond, the rank exceeds the iteration's vectors. Of
// those, 40 take a quarter longer for the critical step of a random strip.
constexpr Eigen::Index kDense = 200, kVectors = 24;

Eigen::MatrixXd dense(const LinearOperator& op) {
  Eigen::MatrixXd m(op.size, op.size);
  for (Eigen::Index k = 0; k < op.size; ++k) op.apply(Eigen::VectorXd::Unit(op.size, k), m.col(k));
  return m;
}

void require_success(Spectra::CompInfo info, const char* what) {
  if (info != Spectra::CompInfo::Successful) {
    throw std::runtime_error(std::string(what) + ": the eigenvalue iteration did not converge");
  }
}

}  // namespace

double largest_eigenvalue(LinearOperator op, const char* what) {
  if (op.size <= kDense) return symmetric_eigenvalues(dense(op), what).maxCoeff();
  Spectra::SymEigsSolver<LinearOperator> solver(op, 1, kVectors);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, kMostIterations, residual_of(op.size));
  require_success(solver.info(), what);
  return solver.eigenvalues()[0];
}

double largest_magnitude(LinearOperator op, const char* what) {
  if (op.size <= kDense) return eigenvalues(dense(op), what).cwiseAbs().maxCoeff();
  Spectra::GenEigsSolver<LinearOperator> solver(op, 2, 60);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, kMostIterations, residual_of(op.size));
  require_success(solver.info(), what);
  return std::abs(solver.eigenvalues()[0]);
}

std::optional<EigenPair> outstanding_eigenvector(const LinearOperator& op, double outside) {
  const Eigen::Index most = std::min<Eigen::Index>(op.size, 60), first_look = std::min<Eigen::Index>(most, 8),
                     last_look = std::min<Eigen::Index>(most, 16);
  constexpr double residual = 1e-3;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(op.size, most + 1), h = Eigen::MatrixXd::Zero(most + 1, most);
  std::mt19937_64 generator(1);
  for (Eigen::Index k = 0; k < op.size; ++k) basis(k, 0) = static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1.0;
  basis.col(0).normalize();
  for (Eigen::Index m = 1; m <= most; ++m) {
    Eigen::VectorXd next = op * basis.col(m - 1);
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough
      const Eigen::VectorXd overlap = basis.leftCols(m).transpose() * next;
      next -= basis.leftCols(m) * overlap;
      h.col(m - 1).head(m) += overlap;
    }
    h(m, m - 1) = next.norm();
    if (h(m, m - 1) > 0.0) basis.col(m) = next / h(m, m - 1);
    if (m < first_look) continue;
    const EigenPairs ritz = eigen_pairs(Eigen::MatrixXd(h.topLeftCorner(m, m)), "outstanding eigenvalue");
    Eigen::Index best = 0;
    ritz.values.cwiseAbs().maxCoeff(&best);
    const std::complex<double> value = ritz.values[best];
    if (std::abs(value) <= outside) {
      if (m < last_look) continue;
      return std::nullopt;
    }
    const Eigen::VectorXcd y = ritz.vectors.col(best);
    if (h(m, m - 1) * std::abs(y[m - 1]) <= residual * std::abs(value)) return EigenPair{value, basis.leftCols(m) * y};
  }
  throw std::runtime_error("outstanding eigenvalue: the Arnoldi iteration did not converge");
}

}  // namespace ddem
