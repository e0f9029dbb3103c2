#include "dem/spectra/extreme_eigenvalues.h"

#include <Spectra/GenEigsSolver.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
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

/// Lanczos' matrix, and what is asked of its largest eigenvalue as it grows.
class GrowingTridiagonal {
 public:
  void add(double diagonal) { diagonal_.push_back(diagonal); }
  void add_beside(double value) {
    beside_.push_back(value);
    reach_ = std::max(reach_, value);
  }
  std::size_t size() const { return diagonal_.size(); }
  double first() const { return diagonal_.front(); }

  /// The largest eigenvalue, which never falls as the matrix grows, and the last component of its unit eigenvector.
  std::pair<double, double> largest() {
    double high = *std::max_element(diagonal_.begin(), diagonal_.end()) + 2.0 * reach_;  // Gershgorin
    high += kRoundOff * std::abs(high) + std::numeric_limits<double>::min();
    if (!std::isfinite(high)) return {high, high};
    low_ = std::max(low_, *std::max_element(diagonal_.begin(), diagonal_.end()));
    while (high - low_ > 4.0 * kRoundOff * std::max(std::abs(high), std::abs(low_))) {
      const double middle = 0.5 * (low_ + high);
      if (middle <= low_ || middle >= high) break;
      (factorise(middle) ? high : low_) = middle;
    }
    return {high, last_component(high)};
  }

 private:
  /// Pivots of shift - T: all positive above the largest eigenvalue, and nowhere else.
  bool factorise(double shift) {
    pivot_.resize(size());
    double pivot = 1.0, coupling = 0.0;
    for (std::size_t k = 0; k < size(); ++k) {
      pivot = shift - diagonal_[k] - coupling * coupling / pivot;
      if (!(pivot > 0.0)) return false;
      pivot_[k] = pivot;
      if (k < beside_.size()) coupling = beside_[k];
    }
    return true;
  }

  /// Inverse iteration from just above the eigenvalue.
  double last_component(double shift) {
    while (!factorise(shift)) shift += kRoundOff * std::max(std::abs(shift), reach_);
    const auto n = static_cast<Eigen::Index>(size());
    Eigen::VectorXd x = Eigen::VectorXd::Ones(n);
    for (int pass = 0; pass < 3; ++pass) {
      for (Eigen::Index k = 1; k < n; ++k) x[k] += x[k - 1] * beside_[k - 1] / pivot_[k - 1];
      x[n - 1] /= pivot_[n - 1];
      for (Eigen::Index k = n - 1; k-- > 0;) x[k] = (x[k] + beside_[k] * x[k + 1]) / pivot_[k];
      x.normalize();
    }
    return std::abs(x[n - 1]);
  }

  std::vector<double> diagonal_, beside_, pivot_;
  double low_ = -std::numeric_limits<double>::infinity(), reach_ = 0.0;
};

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
  GrowingTridiagonal matrix;
  Eigen::VectorXd before = Eigen::VectorXd::Zero(op.size), now = start_vector(op.size), next;
  double rest = 0.0;
  for (std::size_t look = kFirstLook; matrix.size() < kMostSteps;) {
    next = op.apply(now) - rest * before;
    const double diagonal = next.dot(now);
    matrix.add(diagonal);
    next -= diagonal * now;
    rest = next.norm();
    if (matrix.size() == look || !(rest > kRoundOff * std::abs(matrix.first()))) {
      const auto [value, last] = matrix.largest();
      if (rest * last <= residual_of(op.size) * std::abs(value)) return value;
      look += std::max<std::size_t>(kFirstLook / 4, look / 16);
    }
    matrix.add_beside(rest);
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
