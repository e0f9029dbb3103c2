#include "harness/references/driven_columns.h"

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dem/spectra/dense_eigen.h"

namespace ddem::references {
namespace {

constexpr int kDriven = 2;

/// Twice the energy of a spring, k (sum_n c_n q_n)^2, added to the stiffness matrix.
struct Term {
  int unknown;
  double factor;
};

void add_spring(Eigen::MatrixXd& stiffness, double k, std::initializer_list<Term> terms) {
  for (const Term& a : terms) {
    for (const Term& b : terms) stiffness(a.unknown, b.unknown) += k * a.factor * b.factor;
  }
}

/// Unknowns: displacements of the columns, then (shear with k_t > 0) their phi.
Eigen::MatrixXd stiffness_of(const HexagonalColumns& l, ColumnWave wave, bool rotations) {
  const int n = l.columns;
  const double k_n = l.normal_stiffness, k_t = l.stiffness_ratio * k_n;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(rotations ? 2 * n : n, rotations ? 2 * n : n);
  for (int j = 0; j + 1 < n; ++j) {
    const int near = j + 1, far = j + 2;
    add_spring(k, wave == ColumnWave::p ? 0.5 * (k_n + 3.0 * k_t) : 1.5 * k_n, {{j, -1.0}, {near, 1.0}});
    if (rotations) add_spring(k, 2.0 * k_t, {{j, -0.5}, {near, 0.5}, {n + j, -1.0}, {n + near, -1.0}});
    if (far >= n) continue;
    if (wave == ColumnWave::p) add_spring(k, k_n, {{j, -1.0}, {far, 1.0}});
    if (rotations) add_spring(k, k_t, {{j, -1.0}, {far, 1.0}, {n + j, -1.0}, {n + far, -1.0}});
  }
  return k;
}

/// Response at rest to sin^2(pi t/T) = (1 - cos(w t))/2 from t = 0 on: a'' + f^2 a = that.
double response(double f, double w, double t) {
  if (t <= 0.0) return 0.0;
  // cos(wt) - cos(ft) = 2 sin((f - w) t/2) sin((f + w) t/2): finite at resonance.
  const double difference = 0.5 * (f - w) * t;
  const double sinc = std::abs(difference) < 1e-8 ? 1.0 : std::sin(difference) / difference;
  const double forced = t * sinc * std::sin(0.5 * (f + w) * t) / (f + w);
  return 0.5 * ((1.0 - std::cos(f * t)) / (f * f) - forced);
}

}  // namespace

DrivenColumns::DrivenColumns(const HexagonalColumns& l, ColumnWave wave, double duration)
    : columns_(l.columns), duration_(duration) {
  if (l.columns < 4) throw std::invalid_argument("driven columns: at least four are needed");
  for (const double value : {l.normal_stiffness, l.disc_mass, duration}) {
    if (!(value > 0.0) || !std::isfinite(value)) throw std::invalid_argument("stiffness, mass and duration must be positive and finite");
  }
  if (!(l.stiffness_ratio >= 0.0) || !std::isfinite(l.stiffness_ratio)) throw std::invalid_argument("k_t/k_n must not be negative");
  const bool rotations = wave == ColumnWave::shear && l.stiffness_ratio > 0.0;
  Eigen::MatrixXd k = stiffness_of(l, wave, rotations);
  Eigen::VectorXd root_mass = Eigen::VectorXd::Constant(k.rows(), std::sqrt(l.disc_mass));
  if (rotations) root_mass.tail(l.columns) *= std::sqrt(0.5);  // I = m r^2/2
  const Eigen::Index free = k.rows() - kDriven;
  const Eigen::VectorXd inverse = root_mass.tail(free).cwiseInverse();
  const Eigen::VectorXd force = -k.bottomLeftCorner(free, kDriven).rowwise().sum().cwiseProduct(inverse);
  const SymmetricPairs modes =
      symmetric_pairs(inverse.asDiagonal() * k.bottomRightCorner(free, free) * inverse.asDiagonal(), "driven columns");
  frequency_ = modes.values.cwiseMax(0.0).cwiseSqrt();
  load_ = modes.vectors.transpose() * force;
  shape_ = (inverse.asDiagonal() * modes.vectors).topRows(l.columns - kDriven);
}

std::vector<double> DrivenColumns::signal(std::span<const double> weights, double dt, std::size_t samples) const {
  if (weights.size() != static_cast<std::size_t>(columns_)) throw std::invalid_argument("driven columns: one weight a column");
  const Eigen::Map<const Eigen::VectorXd> behind(weights.data() + kDriven, columns_ - kDriven);
  const Eigen::VectorXd mode_weight = (shape_.transpose() * behind).cwiseProduct(load_);
  const double w = 2.0 * std::numbers::pi / duration_, driven = weights[0] + weights[1];
  std::vector<double> values(samples);
  for (std::size_t n = 0; n < samples; ++n) {
    const double t = static_cast<double>(n) * dt;
    double sum = t < duration_ ? driven * std::pow(std::sin(0.5 * w * t), 2) : 0.0;
    for (Eigen::Index m = 0; m < frequency_.size(); ++m) {
      // What stops after one period is the same load, less itself one period later.
      sum += mode_weight[m] * (response(frequency_[m], w, t) - response(frequency_[m], w, t - duration_));
    }
    values[n] = sum;
  }
  return values;
}

}  // namespace ddem::references
