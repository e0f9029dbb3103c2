#include "dem/spectra/extreme_eigenvalues.h"

#include <Spectra/GenEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ddem {
namespace {

constexpr Eigen::Index kMostIterations = 2000;

/// The residual asked for, over the eigenvalue: an eigenvalue is off by less than it, and by about its square where the
/// next one is apart. The largest ones of a large assembly lie so close together that 1e-5 would take minutes.
double residual_of(Eigen::Index unknowns) { return unknowns <= 20000 ? 1e-5 : 1e-3; }

// Up to so many unknowns the matrix itself is solved. Lanczos breaks down on operators of small rank, as those of a few
// bonded discs are, and Spectra then answers with a wrong number; beyond, the rank exceeds the iteration's 40 vectors.
constexpr Eigen::Index kDense = 200;

// Lanczos' iteration looks at its largest eigenvalue after so many steps, then after some more each time.
constexpr std::size_t kFirstLook = 16, kMostSteps = 20000;
constexpr double kRoundOff = std::numeric_limits<double>::epsilon();

Eigen::MatrixXd dense(const LinearOperator& op) {
  Eigen::MatrixXd m(op.size, op.size);
  for (Eigen::Index k = 0; k < op.size; ++k) m.col(k) = op.apply(Eigen::VectorXd::Unit(op.size, k));
  return m;
}

Eigen::VectorXd start_vector(Eigen::Index size) {
  std::mt19937_64 generator(1);
  Eigen::VectorXd v(size);
  for (double& x : v) x = static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1.0;
  return v.normalized();
}

/// The largest eigenvalue of Lanczos' tridiagonal matrix, and the size of the last component of its unit eigenvector.
std::pair<double, double> largest_of_tridiagonal(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  const Eigen::Map<const Eigen::VectorXd> a(diagonal.data(), n), b(beside.data(), n - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(a, b, Eigen::EigenvaluesOnly);
  const double value = solver.eigenvalues()[n - 1];
  // Inverse iteration from just above it, where no pivot of value - T vanishes.
  const double shift = value + kRoundOff * static_cast<double>(n) * solver.eigenvalues().cwiseAbs().maxCoeff();
  Eigen::VectorXd pivot(n), x = Eigen::VectorXd::Ones(n);
  for (Eigen::Index k = 0; k < n; ++k) pivot[k] = shift - a[k] - (k > 0 ? b[k - 1] * b[k - 1] / pivot[k - 1] : 0.0);
  for (int pass = 0; pass < 3; ++pass) {
    for (Eigen::Index k = 1; k < n; ++k) x[k] += x[k - 1] * b[k - 1] / pivot[k - 1];
    x[n - 1] /= pivot[n - 1];
    for (Eigen::Index k = n - 1; k-- > 0;) x[k] = (x[k] + b[k] * x[k + 1]) / pivot[k];
    x.normalize();
  }
  return {value, std::abs(x[n - 1])};
}

void require_success(Spectra::CompInfo info, const char* what) {
  if (info != Spectra::CompInfo::Successful) {
    throw std::runtime_error(std::string(what) + ": the eigenvalue iteration did not converge");
  }
}

}  // namespace

double largest_eigenvalue(const LinearOperator& op, const char* what) {
  if (op.size <= kDense) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense(op), Eigen::EigenvaluesOnly);
    return solver.eigenvalues().maxCoeff();
  }
  std::vector<double> diagonal, beside;
  Eigen::VectorXd before = Eigen::VectorXd::Zero(op.size), now = start_vector(op.size), next;
  double rest = 0.0;
  for (std::size_t look = kFirstLook; diagonal.size() < kMostSteps;) {
    next = op.apply(now) - rest * before;
    diagonal.push_back(next.dot(now));
    next -= diagonal.back() * now;
    rest = next.norm();
    if (diagonal.size() == look || !(rest > kRoundOff * std::abs(diagonal.front()))) {
      const auto [value, last] = largest_of_tridiagonal(diagonal, beside);
      if (rest * last <= residual_of(op.size) * std::abs(value)) return value;
      look += std::max<std::size_t>(kFirstLook / 4, look / 16);
    }
    beside.push_back(rest);
    before.swap(now);
    now = next / rest;
  }
  throw std::runtime_error(std::string(what) + ": the eigenvalue iteration did not converge");
}

double largest_magnitude(LinearOperator op, const char* what) {
  if (op.size <= kDense) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(dense(op), false);
    return solver.eigenvalues().cwiseAbs().maxCoeff();
  }
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
  basis.col(0) = start_vector(op.size);
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
