#pragma once
// The vibrations of a small assembly by dense eigenvectors: functions of its frequencies, to compare time stepping with.

#include <Eigen/Core>
#include <functional>

#include "dem/simulation/simulation.h"
#include "dem/spectra/dense_eigen.h"
#include "dem/spectra/scheme_stiffness.h"
#include "dem/statics/operators.h"

namespace ddem::test {

/// With rigid discs, or converged particle strains that derive from an energy.
class DenseModes {
 public:
  DenseModes(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation, const HeldDofs& held)
      : op_(make_operators(a, contact, deformation)), root_inverse_mass_(mass_scaling(op_, held)) {
    const SchemeStiffness stiffness = SchemeStiffness::converged(op_);
    const Eigen::Index n = root_inverse_mass_.size();
    stiffness_.resize(n, n);
    for (Eigen::Index k = 0; k < n; ++k) stiffness_.col(k) = stiffness.apply(Eigen::VectorXd::Unit(n, k));
    const Eigen::MatrixXd scaled = root_inverse_mass_.asDiagonal() * stiffness_ * root_inverse_mass_.asDiagonal();
    const SymmetricPairs pairs = symmetric_pairs(0.5 * (scaled + scaled.transpose()), "dense modes");
    frequencies_ = pairs.values.cwiseMax(0.0).cwiseSqrt();
    vectors_ = pairs.vectors;
  }

  double largest_frequency() const { return frequencies_.maxCoeff(); }

  /// q as in Operators; a disc's rotation times the mean radius.
  Eigen::VectorXd unknowns(const std::vector<double>& ux, const std::vector<double>& uy, const std::vector<double>& theta) const {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(root_inverse_mass_.size());
    const auto put = [&](const std::vector<double>& from, int component, double scale) {
      if (component >= op_.dofs_per_disc) return;
      for (std::size_t d = 0; d < from.size(); ++d) q[op_.dofs_per_disc * static_cast<Eigen::Index>(d) + component] = scale * from[d];
    };
    put(ux, 0, 1.0), put(uy, 1, 1.0), put(theta, 2, op_.length_scale);
    return q;
  }
  double displacement(const Eigen::VectorXd& q, int disc, int component) const {
    return q[op_.dofs_per_disc * disc + component] / (component == 2 ? op_.length_scale : 1.0);
  }

  /// f(sqrt(M^-1 K)) q, zero where held.
  Eigen::VectorXd apply(const std::function<double(double)>& f, const Eigen::VectorXd& q) const {
    Eigen::VectorXd x = vectors_.transpose() * scaled(q);
    for (Eigen::Index k = 0; k < x.size(); ++k) x[k] *= f(frequencies_[k]);
    return root_inverse_mass_.cwiseProduct(vectors_ * x);
  }
  /// -M^-1 K q.
  Eigen::VectorXd acceleration(const Eigen::VectorXd& q) const {
    return -root_inverse_mass_.cwiseProduct(root_inverse_mass_.cwiseProduct(stiffness_ * q));
  }

 private:
  Eigen::VectorXd scaled(const Eigen::VectorXd& q) const {
    return (root_inverse_mass_.array() > 0.0).select(q.array() / root_inverse_mass_.array(), 0.0).matrix();
  }

  Operators op_;
  Eigen::VectorXd root_inverse_mass_, frequencies_;
  Eigen::MatrixXd stiffness_, vectors_;
};

}  // namespace ddem::test
