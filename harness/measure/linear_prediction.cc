#include "harness/measure/linear_prediction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ddem::harness {
namespace {

Eigen::MatrixXd samples_of(std::span<const std::vector<double>> signals, std::size_t begin, std::size_t end) {
  Eigen::MatrixXd y(static_cast<Eigen::Index>(signals.size()), static_cast<Eigen::Index>(end - begin));
  for (std::size_t s = 0; s < signals.size(); ++s) {
    if (signals[s].size() < end) throw std::invalid_argument("linear prediction: a signal is too short");
    for (std::size_t n = begin; n < end; ++n) y(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(n - begin)) = signals[s][n];
  }
  if (!y.allFinite()) throw std::invalid_argument("linear prediction: a signal is not finite");
  return y;
}

/// Rows: every receiver at every sample, over the size of the signals from there to the sample that is predicted.
Prediction of_order(const Eigen::MatrixXd& y, Eigen::Index order) {
  const Eigen::Index receivers = y.rows(), equations = y.cols() - order;
  Eigen::MatrixXd past(receivers * equations, order);
  Eigen::VectorXd now(receivers * equations);
  double total = 0.0;
  for (Eigen::Index n = 0; n < equations; ++n) {
    const double size = y.middleCols(n, order + 1).norm();
    const double weight = size > 0.0 ? 1.0 / size : 0.0;
    for (Eigen::Index j = 0; j < order; ++j) past.block(n * receivers, j, receivers, 1) = weight * y.col(n + j);
    now.segment(n * receivers, receivers) = weight * y.col(n + order);
    total += size > 0.0 ? 1.0 : 0.0;
  }
  if (total == 0.0) return {};
  const Eigen::VectorXd c = past.colPivHouseholderQr().solve(now);
  Prediction p;
  p.residual = (past * c - now).norm() / std::sqrt(total);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.topRightCorner(order - 1, order - 1).setIdentity();
  companion.row(order - 1) = c.transpose();
  const Eigen::VectorXcd roots = Eigen::EigenSolver<Eigen::MatrixXd>(companion, false).eigenvalues();
  p.factors.assign(roots.begin(), roots.end());
  return p;
}

}  // namespace

double Prediction::largest() const {
  double most = 0.0;
  for (const std::complex<double>& z : factors) most = std::max(most, std::abs(z));
  return most;
}

Prediction predict_linearly(std::span<const std::vector<double>> signals, std::size_t begin, std::size_t end, double enough) {
  if (end <= begin + 1 || signals.empty()) return {};
  const Eigen::MatrixXd y = samples_of(signals, begin, end);
  Prediction best;
  for (const Eigen::Index order : {1, 2, 3, 4, 6, 8}) {
    if (y.cols() <= order || y.rows() * (y.cols() - order) < order) break;
    Prediction p = of_order(y, order);
    if (p.factors.empty()) return {};
    if (best.factors.empty() || p.residual < best.residual) best = std::move(p);
    if (best.residual < enough) break;
  }
  return best;
}

}  // namespace ddem::harness
