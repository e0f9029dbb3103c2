#include "dem/spectra/step_map.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dem/spectra/dense_eigen.h"
#include "dem/spectra/scheme_stiffness.h"
#include "dem/spectra/strain_polynomial.h"

namespace ddem {
namespace {

using Eigen::MatrixXd;
using Complex = std::complex<double>;

constexpr const char* kStepMap = "step map";

Eigen::VectorXcd scaled_to_one(Eigen::VectorXcd motion) {
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  return motion / motion[largest];
}

/// Factors whose magnitudes differ by round-off alone are told apart by their frequencies.
bool leads(const Complex& z, const Complex& best) {
  const double difference = std::abs(z) - std::abs(best);
  return difference > 1e-12 || (std::abs(difference) <= 1e-12 && std::abs(std::arg(z)) > std::abs(std::arg(best)));
}

class Leader {
 public:
  void look(const Complex& z, Eigen::Index column) {
    if (std::abs(z - 1.0) < kTranslationFactor || (column_ >= 0 && !leads(z, factor_))) return;
    factor_ = z, column_ = column;
  }
  Complex factor() const { return factor_; }
  Eigen::Index column() const {
    if (column_ < 0) throw std::runtime_error("step map: the assembly has no motion but rigid ones");
    return column_;
  }

 private:
  Complex factor_ = 0.0;
  Eigen::Index column_ = -1;
};

/// M^-1/2 K M^-1/2.
MatrixXd scaled_matrix(const SchemeStiffness& stiffness, const Eigen::VectorXd& s) {
  MatrixXd a(s.size(), s.size());
  for (Eigen::Index k = 0; k < s.size(); ++k) a.col(k) = s.cwiseProduct(stiffness.apply(s[k] * Eigen::VectorXd::Unit(s.size(), k)));
  return a;
}

/// The larger root of z - 2 + 1/z = -(omega dt)^2.
Complex leapfrog_factor(const Complex& squared_frequency, double dt) {
  const Complex half = 1.0 - 0.5 * dt * dt * squared_frequency, root = std::sqrt(half * half - 1.0);
  return std::abs(half + root) > std::abs(half - root) ? half + root : half - root;
}

/// Frequencies of rigid motions, squared, are round-off.
double rigid_below(const Eigen::VectorXcd& squared) { return 1e-10 * squared.cwiseAbs().maxCoeff(); }

StepMode converged_mode(const Operators& op, double dt) {
  const Eigen::VectorXd s = mass_scaling(op, {});
  const MatrixXd a = scaled_matrix(SchemeStiffness::converged(op), s);
  Eigen::VectorXcd squared;
  Eigen::MatrixXcd vectors;
  if (op.symmetric) {
    const SymmetricPairs pairs = symmetric_pairs(0.5 * (a + a.transpose()), kStepMap);
    squared = pairs.values.cast<Complex>(), vectors = pairs.vectors.cast<Complex>();
  } else {
    EigenPairs pairs = eigen_pairs(a, kStepMap);
    squared = std::move(pairs.values), vectors = std::move(pairs.vectors);
  }
  Leader leader;
  const double rigid = rigid_below(squared);
  for (Eigen::Index k = 0; k < squared.size(); ++k) {
    if (std::abs(squared[k]) >= rigid) leader.look(leapfrog_factor(squared[k], dt), k);
  }
  return {leader.factor(), scaled_to_one(s.cast<Complex>().cwiseProduct(vectors.col(leader.column())))};
}

/// State (q_n, w_n, eps_n).
MatrixXd lagged_map(const Operators& op, const DeformationParameters& d, double dt) {
  const MatrixXd c(op.overlap), g(op.strain_overlap), sk = MatrixXd(op.stress) * op.stiffness.asDiagonal();
  const Eigen::Index n = c.cols(), m = g.cols();
  MatrixXd vc_inverse(op.strain_stiffness);
  for (Eigen::Index k = 0; k < m; k += 3) vc_inverse.block<3, 3>(k, k) = vc_inverse.block<3, 3>(k, k).inverse().eval();
  const MatrixXd h = d.relaxation * product(vc_inverse, product(sk, c)), t = product(vc_inverse, product(sk, g));
  const MatrixXd r = (1.0 - d.relaxation) * MatrixXd::Identity(m, m) - d.relaxation * t;
  MatrixXd power = MatrixXd::Identity(m, m), sum = MatrixXd::Zero(m, m);  // R^(s-1), 1 + .. + R^(s-2)
  for (int k = 1; k < d.evaluations; ++k) sum += power, power = product(r, power);

  const MatrixXd push = -dt * dt * op.inverse_mass.asDiagonal() * c.transpose() * op.stiffness.asDiagonal();
  MatrixXd map = MatrixXd::Zero(2 * n + m, 2 * n + m);
  map.block(n, 0, n, n) = product(push, c - product(g, product(sum, h)));
  map.block(n, n, n, n).setIdentity();
  map.block(n, 2 * n, n, m) = -product(push, product(g, power));
  map.topRows(n) = map.middleRows(n, n);
  map.topLeftCorner(n, n) += MatrixXd::Identity(n, n);
  map.block(2 * n, 0, m, n) = product(sum + power, h);
  map.block(2 * n, 2 * n, m, m) = product(r, power);
  return map;
}

/// Eigenvector of a Hessenberg matrix by inverse iteration: the factor is known to round-off, so that twice is enough.
Eigen::VectorXcd eigenvector_of(const MatrixXd& hessenberg, const Complex& factor) {
  const Eigen::Index n = hessenberg.rows();
  const double off = 1e-12 * hessenberg.cwiseAbs().maxCoeff();  // at the very factor there is no inverse
  // Row-wise elimination of the one subdiagonal with the larger of two rows as pivot, L^-1 applied to x on the way.
  const Eigen::MatrixXcd shifted = hessenberg.cast<Complex>() - (factor + off) * Eigen::MatrixXcd::Identity(n, n);
  Eigen::VectorXcd x = Eigen::VectorXcd::LinSpaced(n, 1.0, 2.0);  // has a share in every mode but by accident
  for (int pass = 0; pass < 2; ++pass) {
    Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> u = shifted;
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
      const Eigen::Index rest = n - k;
      if (std::norm(u(k + 1, k)) > std::norm(u(k, k))) u.row(k).tail(rest).swap(u.row(k + 1).tail(rest)), std::swap(x[k], x[k + 1]);
      const Complex share = u(k + 1, k) / u(k, k);
      u.row(k + 1).tail(rest) -= share * u.row(k).tail(rest);
      x[k + 1] -= share * x[k];
    }
    x = u.triangularView<Eigen::Upper>().solve(x).normalized();
  }
  return x;
}

StepMode lagged_mode(const Operators& op, const DeformationParameters& deformation, double dt) {
  const auto [form, basis] = hessenberg(lagged_map(op, deformation, dt));
  const Eigen::VectorXcd factors = eigenvalues(form, kStepMap);
  Leader leader;
  for (Eigen::Index k = 0; k < factors.size(); ++k) leader.look(factors[k], k);
  const Eigen::VectorXcd x = eigenvector_of(form, leader.factor());
  MatrixXd parts(x.size(), 2);  // the basis is real
  parts << x.real(), x.imag();
  parts = product(basis, parts);
  const Eigen::VectorXcd state = parts.col(0) + Complex(0.0, 1.0) * parts.col(1);
  return {leader.factor(), scaled_to_one(state.head(op.overlap.cols()))};
}

/// All factors of motions that are not held.
Eigen::VectorXcd lagged_factors(const Operators& op, const DeformationParameters& d, const Eigen::VectorXd& scaling, double dt) {
  const Eigen::Index n = scaling.size(), all = 2 * n + op.strain_overlap.cols();
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < all; ++k) {
    if (k >= 2 * n || scaling[k % n] > 0.0) free.push_back(k);
  }
  return eigenvalues(MatrixXd(lagged_map(op, d, dt)(free, free)), kStepMap);
}

Eigen::VectorXcd converged_factors(const Operators& op, const SchemeStiffness& stiffness, const Eigen::VectorXd& scaling, double dt) {
  const MatrixXd a = scaled_matrix(stiffness, scaling);
  Eigen::VectorXcd z = op.symmetric ? Eigen::VectorXcd(symmetric_eigenvalues(MatrixXd(0.5 * (a + a.transpose())), kStepMap).cast<Complex>()) : eigenvalues(a, kStepMap);
  const double rigid = rigid_below(z);
  for (Complex& factor : z) factor = std::abs(factor) < rigid ? 1.0 : leapfrog_factor(factor, dt);
  return z;
}

}  // namespace

double step_growth(const Assembly& a, const ContactParameters& contact, const DeformationParameters& d, const HeldDofs& held, double dt) {
  const Operators op = make_operators(a, contact, d);
  const Eigen::VectorXd scaling = mass_scaling(op, held);
  const bool polynomial = d.scheme == Scheme::implicit && d.solver == StrainSolver::polynomial;
  const Eigen::VectorXcd factors =
      d.scheme == Scheme::lagged
          ? lagged_factors(op, d, scaling, dt)
          : converged_factors(op, polynomial ? SchemeStiffness::polynomial(op, strain_relaxations(a, contact, d)) : SchemeStiffness::converged(op), scaling, dt);
  double largest = 0.0;
  for (const Complex& z : factors) {
    if (std::abs(z - 1.0) >= kTranslationFactor) largest = std::max(largest, std::abs(z));
  }
  return largest - 1.0;
}

std::size_t step_unknowns(const Assembly& a, const ContactParameters& contact, const DeformationParameters& d) {
  const std::size_t dofs = contact.has_rotation() ? 3 : 2;
  return a.size() * (d.scheme == Scheme::lagged ? 2 * dofs + 3 : dofs);
}

StepMode leading_mode(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation, double time_step) {
  const Operators op = make_operators(assembly, contact, deformation);
  return deformation.scheme == Scheme::lagged ? lagged_mode(op, deformation, time_step) : converged_mode(op, time_step);
}

}  // namespace ddem
