#include "dem/spectra/extreme_eigenvalues.h"

#include <Spectra/GenEigsSolver.h>
#include <Spectra/SymEigsSolver.h>
#include <algorithm>
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

std::vector<EigenPair> outstanding_eigenvectors(LinearOperator op) {
  constexpr Eigen::Index restarts = 4, basis = 12;
  constexpr double residual = 1e-3;
  require_size(op, basis, "outstanding eigenvalues");
  Spectra::GenEigsSolver<LinearOperator> solver(op, 2, basis);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, restarts, residual);
  const Eigen::VectorXcd values = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  std::vector<EigenPair> pairs;
  for (Eigen::Index k = 0; k < values.size(); ++k) pairs.push_back({values[k], vectors.col(k)});
  return pairs;
}

}  // namespace ddem
