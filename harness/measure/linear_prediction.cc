#include "harness/measure/linear_prediction.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem/spectra/dense_eigen.h"

namespace ddem::harness {
namespace {

constexpr double kSignificant = 1e-4;

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
  const Eigen::VectorXd c = least_squares(past, now);
  Prediction p;
  p.residual = (past * c - now).norm() / std::sqrt(total);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.topRightCorner(order - 1, order - 1).setIdentity();
  companion.row(order - 1) = c.transpose();
  const Eigen::VectorXcd roots = eigenvalues(companion, "linear prediction");
  p.factors.assign(roots.begin(), roots.end());
  return p;
}

/// Takes out the factors that have no part in the signals: a recurrence of too high an order has roots anywhere.
void keep_significant(const Eigen::MatrixXd& y, Prediction& p) {
  const Eigen::Index samples = y.cols(), order = static_cast<Eigen::Index>(p.factors.size());
  // Each motion in units of its largest value in the window, so that the columns are of one size; complex ones as real ones of
  // twice the size.
  Eigen::MatrixXd motions(2 * samples, 2 * order);
  for (Eigen::Index j = 0; j < order; ++j) {
    const std::complex<double> z = p.factors[static_cast<std::size_t>(j)];
    const double from = std::abs(z) > 1.0 ? static_cast<double>(samples - 1) : 0.0;
    for (Eigen::Index n = 0; n < samples; ++n) {
      const std::complex<double> motion = std::exp((static_cast<double>(n) - from) * std::log(z));
      motions(n, j) = motions(samples + n, order + j) = motion.real();
      motions(samples + n, j) = motion.imag(), motions(n, order + j) = -motion.imag();
    }
  }
  Eigen::MatrixXd measured = Eigen::MatrixXd::Zero(2 * samples, y.rows());
  measured.topRows(samples) = y.transpose();
  const Eigen::MatrixXd parts_of_both = least_squares(motions, measured);
  const Eigen::VectorXd parts = (parts_of_both.topRows(order).cwiseAbs2() + parts_of_both.bottomRows(order).cwiseAbs2()).rowwise().sum().cwiseSqrt();
  std::vector<std::complex<double>> kept;
  for (Eigen::Index j = 0; j < order; ++j) {
    if (parts[j] >= kSignificant * parts.maxCoeff()) kept.push_back(p.factors[static_cast<std::size_t>(j)]);
  }
  p.factors = std::move(kept);
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
  if (!best.factors.empty()) keep_significant(y, best);
  return best;
}

}  // namespace ddem::harness
