#include "dem/spectra/dense_eigen.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <stdexcept>
#include <string>

namespace ddem {
namespace {

template <class Solver>
const Solver& converged(const Solver& solver, const char* what) {
  if (solver.info() != Eigen::Success) throw std::runtime_error(std::string(what) + ": the eigenvalues did not converge");
  return solver;
}

}  // namespace

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a, const char* what) {
  return converged(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a, Eigen::EigenvaluesOnly), what).eigenvalues();
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXcd& a, const char* what) {
  return converged(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(a, Eigen::EigenvaluesOnly), what).eigenvalues();
}

SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& a, const char* what) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  converged(solver, what);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricPairs tridiagonal_pairs(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& beside, const char* what) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside);
  converged(solver, what);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a, const char* what) {
  return converged(Eigen::EigenSolver<Eigen::MatrixXd>(a, false), what).eigenvalues();
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXcd& a, const char* what) {
  return converged(Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(a, false), what).eigenvalues();
}

EigenPairs eigen_pairs(const Eigen::MatrixXd& a, const char* what) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(a);
  converged(solver, what);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

EigenPairs eigen_pairs(const Eigen::MatrixXcd& a, const char* what) {
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(a);
  converged(solver, what);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Hessenberg hessenberg(const Eigen::MatrixXd& a) {
  const Eigen::HessenbergDecomposition<Eigen::MatrixXd> reduced(a);
  return {reduced.matrixH(), reduced.matrixQ()};
}

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a * b; }

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a.completeOrthogonalDecomposition().solve(b); }

}  // namespace ddem
