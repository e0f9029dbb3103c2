#include "dem/spectra/extreme_eigenvalues.h"

#include <Spectra/GenEigsSolver.h>
#include <Spectra/SymEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>

namespace ddem {
namespace {

constexpr Eigen::Index kMostIterations = 2000;
constexpr double kResidual = 1e-5;

void require_size(const LinearOperator& op, Eigen::Index least, const char* what) {
  if (op.size < least) throw std::invalid_argument(std::string(what) + ": too few unknowns");
}

void require_success(Spectra::CompInfo info, const char* what) {
  if (info != Spectra::CompInfo::Successful) {
    throw std::runtime_error(std::string(what) + ": the eigenvalue iteration did not converge");
  }
}

}  // namespace

double largest_eigenvalue(LinearOperator op, const char* what) {
  require_size(op, 3, what);
  Spectra::SymEigsSolver<LinearOperator> solver(op, 1, std::min<Eigen::Index>(op.size, 40));
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, kMostIterations, kResidual);
  require_success(solver.info(), what);
  return solver.eigenvalues()[0];
}

double largest_magnitude(LinearOperator op, const char* what) {
  require_size(op, 6, what);
  Spectra::GenEigsSolver<LinearOperator> solver(op, 2, std::min<Eigen::Index>(op.size, 60));
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, kMostIterations, kResidual);
  require_success(solver.info(), what);
  return std::abs(solver.eigenvalues()[0]);
}

std::optional<EigenPair> outstanding_eigenvector(const LinearOperator& op, double outside) {
  constexpr Eigen::Index first_look = 8, last_look = 16, most = 60;
  constexpr double residual = 1e-3;
  require_size(op, most, "outstanding eigenvalue");
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(op.size, most + 1), h = Eigen::MatrixXd::Zero(most + 1, most);
  std::mt19937_64 generator(1);
  for (Eigen::Index k = 0; k < op.size; ++k) basis(k, 0) = static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1.0;
  basis.col(0).normalize();
  for (Eigen::Index m = 1; m <= most; ++m) {
    Eigen::VectorXd next = op.apply(basis.col(m - 1));
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough
      const Eigen::VectorXd overlap = basis.leftCols(m).transpose() * next;
      next -= basis.leftCols(m) * overlap;
      h.col(m - 1).head(m) += overlap;
    }
    h(m, m - 1) = next.norm();
    if (h(m, m - 1) > 0.0) basis.col(m) = next / h(m, m - 1);
    if (m < first_look) continue;
    const Eigen::EigenSolver<Eigen::MatrixXd> ritz(h.topLeftCorner(m, m));
    Eigen::Index best = 0;
    ritz.eigenvalues().cwiseAbs().maxCoeff(&best);
    const std::complex<double> value = ritz.eigenvalues()[best];
    if (std::abs(value) <= outside) {
      if (m < last_look) continue;
      return std::nullopt;
    }
    const Eigen::VectorXcd y = ritz.eigenvectors().col(best);
    if (h(m, m - 1) * std::abs(y[m - 1]) <= residual * std::abs(value)) return EigenPair{value, basis.leftCols(m) * y};
  }
  throw std::runtime_error("outstanding eigenvalue: the Arnoldi iteration did not converge");
}

}  // namespace ddem
