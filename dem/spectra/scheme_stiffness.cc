#include "dem/spectra/scheme_stiffness.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dem/spectra/extreme_eigenvalues.h"

namespace ddem {
namespace {

constexpr double kSeriesTolerance = 1e-10;
constexpr int kMostTerms = 1 << 14;

using Cholesky = Eigen::SimplicialLLT<SparseMatrix>;

std::shared_ptr<Cholesky> factorised(const SparseMatrix& m) {
  auto factor = std::make_shared<Cholesky>(m);
  if (factor->info() != Eigen::Success) throw std::invalid_argument("the lagged strains do not converge: no flip limit");
  return factor;
}

/// Coefficients of the Chebyshev series of g on [0, high], as many as decay below 1e-10 of the first.
std::vector<double> chebyshev_series(const std::function<double(double)>& g, double high) {
  for (int n = 16; n <= kMostTerms; n *= 2) {
    std::vector<double> values(n), series(n);
    for (int j = 0; j < n; ++j) values[j] = g(0.5 * high * (1.0 + std::cos(std::numbers::pi * (j + 0.5) / n)));
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) series[k] += values[j] * std::cos(std::numbers::pi * k * (j + 0.5) / n) * 2.0 / n;
    }
    series[0] *= 0.5;
    const auto small = [&](double c) { return std::abs(c) < kSeriesTolerance * std::abs(series[0]); };
    if (!small(series[n - 1]) || !small(series[n - 2])) continue;
    while (series.size() > 2 && small(series.back())) series.pop_back();
    return series;
  }
  throw std::invalid_argument("the lagged strains are too near to where they cease to converge");
}

/// g(T) x by Clenshaw's recurrence, the spectrum of T in [0, high].
Eigen::VectorXd apply_series(const std::vector<double>& series, double high, const StrainIteration& t, const Eigen::VectorXd& x) {
  Eigen::VectorXd b1 = Eigen::VectorXd::Zero(x.size()), b2 = b1;
  const auto argument = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return (2.0 / high) * t.apply(v) - v; };
  for (std::size_t k = series.size() - 1; k > 0; --k) {
    const Eigen::VectorXd b = 2.0 * argument(b1) - b2 + series[k] * x;
    b2 = b1;
    b1 = b;
  }
  return argument(b1) - b2 + series[0] * x;
}

/// g(T) (V C)^-1, the spectrum of T below its `radius`, g smooth below `reach`.
std::function<Eigen::VectorXd(const Eigen::VectorXd&)> function_of_iteration(const Operators& op, const std::function<double(double)>& g, double radius, double reach) {
  // Lanczos finds the radius to 1e-5 or better; the series may reach a little beyond it, but not to the pole.
  const double high = std::min(radius * (1.0 + 1e-4), 0.5 * (radius + reach));
  const auto t = std::make_shared<StrainIteration>(op);
  return [t, high, series = chebyshev_series(g, high)](const Eigen::VectorXd& stress) -> Eigen::VectorXd {
    return t->upper_solve(apply_series(series, high, *t, t->lower_solve(stress)));
  };
}

}  // namespace

void hold(const HeldDofs& held, int components, Eigen::VectorXd& values) {
  const auto hold_component = [&](const std::vector<std::uint8_t>& mask, int component) {
    for (std::size_t p = 0; p < mask.size(); ++p) {
      if (mask[p]) values[components * static_cast<Eigen::Index>(p) + component] = 0.0;
    }
  };
  hold_component(held.x, 0);
  hold_component(held.y, 1);
  if (components == 3) hold_component(held.theta, 2);
}

Eigen::VectorXd mass_scaling(const Operators& op, const HeldDofs& held) {
  Eigen::VectorXd s = op.inverse_mass.cwiseSqrt();
  hold(held, op.dofs_per_disc, s);
  return s;
}

SparseMatrix strain_coupling(const Operators& op) { return op.stress * op.stiffness.asDiagonal() * op.strain_overlap; }

namespace {

/// Of blocks of 3 x 3 on the diagonal.
SparseMatrix inverse_of_blocks(const SparseMatrix& lower) {
  std::vector<Eigen::Triplet<double>> t;
  for (Eigen::Index p = 0; p < lower.cols(); p += 3) {
    const Eigen::Matrix3d of = lower.block(p, p, 3, 3);
    const Eigen::Matrix3d block = of.triangularView<Eigen::Lower>().solve(Eigen::Matrix3d::Identity());
    for (Eigen::Index k = 0; k < 3; ++k) {
      for (Eigen::Index m = k; m < 3; ++m) t.emplace_back(static_cast<int>(p + m), static_cast<int>(p + k), block(m, k));
    }
  }
  SparseMatrix inverse(lower.rows(), lower.cols());
  inverse.setFromTriplets(t.begin(), t.end());
  return inverse;
}

}  // namespace

StrainIteration::StrainIteration(const Operators& op) : factor_(op.strain_stiffness) {
  const SparseMatrix inverse = inverse_of_blocks(factor_.matrixL().nestedExpression());
  const SparseMatrix right = op.strain_overlap * SparseMatrix(inverse.transpose());
  matrix_ = SparseMatrix(inverse * op.stress) * op.stiffness.asDiagonal() * right;
}

double spectral_radius(const StrainIteration& t) {
  return largest_eigenvalue({t.size(), [&](LinearOperator::In x, LinearOperator::Out y) { y = t.apply(x); }}, "fixed-point radius");
}

SchemeStiffness SchemeStiffness::converged(const Operators& op) {
  if (!op.deformable) return {op, nullptr};
  const auto inner = factorised(op.strain_stiffness + strain_coupling(op));
  return {op, [inner](const Eigen::VectorXd& stress) -> Eigen::VectorXd { return inner->solve(stress); }};
}

SchemeStiffness SchemeStiffness::polynomial(const Operators& op, std::vector<double> relaxations) {
  const auto t = std::make_shared<StrainIteration>(op);
  return {op, [t, w = std::move(relaxations)](const Eigen::VectorXd& stress) -> Eigen::VectorXd {
            const Eigen::VectorXd f = t->lower_solve(stress);
            Eigen::VectorXd strain = Eigen::VectorXd::Zero(f.size());
            for (const double weight : w) strain += weight * (f - strain - t->apply(strain));
            return t->upper_solve(strain);
          }};
}

SchemeStiffness SchemeStiffness::flip(const Operators& op, const DeformationParameters& d, double radius) {
  const double w = d.relaxation, reach = 2.0 / w - 1.0;
  if (!(radius < reach)) throw std::invalid_argument("the lagged strains do not converge: no flip limit");
  const int s = d.evaluations;
  if (s == 1) {
    const auto inner = factorised(reach * op.strain_stiffness - strain_coupling(op));
    return {op, [inner](const Eigen::VectorXd& stress) -> Eigen::VectorXd { return -inner->solve(stress); }};
  }
  const auto g = [=](double b) {
    const double r = 1.0 - w - w * b;
    return (1.0 - 2.0 * std::pow(r, s - 1) / (1.0 + std::pow(r, s))) / (1.0 + b);
  };
  return {op, function_of_iteration(op, g, radius, reach)};
}

SchemeStiffness SchemeStiffness::lag(const Operators& op, const DeformationParameters& d, double radius) {
  const double w = d.relaxation, reach = 2.0 / w - 1.0;
  if (!(radius < reach)) throw std::invalid_argument("the lagged strains do not converge: they lag without bound");
  const int s = d.evaluations;
  const auto g = [=](double b) {
    const double r = 1.0 - w - w * b;
    return std::pow(r, s - 1) / ((1.0 - std::pow(r, s)) * (1.0 + b));
  };
  return {op, function_of_iteration(op, g, radius, reach)};
}

Eigen::VectorXd SchemeStiffness::apply(const Eigen::VectorXd& q) const {
  Eigen::VectorXd force = op_->stiffness.cwiseProduct(op_->overlap * q);
  if (strains_) force -= op_->stiffness.cwiseProduct(op_->strain_overlap * strains_(op_->stress * force));
  return op_->overlap.transpose() * force;
}

}  // namespace ddem
