#pragma once
// One step of a scheme as it is written down, applied to every unit state in turn: the amplification matrix that closed forms
// are compared with. States are displacements q (as in Operators), their change since the step before, strains.

#include <Eigen/LU>
#include <vector>

#include "dem/spectra/dense_eigen.h"
#include "dem/spectra/scheme_stiffness.h"
#include "dem/statics/operators.h"

namespace ddem::test {

struct LaggedStep {
  LaggedStep(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation)
      : op(make_operators(a, contact, deformation)), d(deformation), answer(op.strain_stiffness) {
    for (Eigen::Index k = 0; k < answer.rows(); k += 3) answer.block<3, 3>(k, k) = answer.block<3, 3>(k, k).inverse().eval();
  }

  Eigen::VectorXd forces(const Eigen::VectorXd& q, const Eigen::VectorXd& eps) const {
    return op.stiffness.cwiseProduct(op.overlap * q - op.strain_overlap * eps);
  }
  /// An evaluation: eps <- (1 - w) eps + w (V C)^-1 S F.
  Eigen::VectorXd evaluated(const Eigen::VectorXd& q, const Eigen::VectorXd& eps) const {
    return (1.0 - d.relaxation) * eps + d.relaxation * (answer * (op.stress * forces(q, eps)));
  }
  /// All evaluations of a step but the last.
  Eigen::VectorXd before_force(const Eigen::VectorXd& q, Eigen::VectorXd eps) const {
    for (int m = 1; m < d.evaluations; ++m) eps = evaluated(q, eps);
    return eps;
  }
  Eigen::VectorXd acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& eps) const {
    return -op.inverse_mass.cwiseProduct(op.overlap.transpose() * forces(q, eps));
  }

  Operators op;
  DeformationParameters d;
  Eigen::MatrixXd answer;
};

/// Largest magnitude less 1 of its eigenvalues; those of rigid motions, nearer than 1e-5 to 1, are left out.
inline double amplification(const LaggedStep& s, const HeldDofs& held, double dt) {
  const Eigen::Index n = s.op.overlap.cols(), m = s.op.strain_overlap.cols(), all = 2 * n + m;
  const Eigen::VectorXd moves = mass_scaling(s.op, held).cwiseSign();
  Eigen::MatrixXd map(all, all);
  for (Eigen::Index k = 0; k < all; ++k) {
    const Eigen::VectorXd state = Eigen::VectorXd::Unit(all, k);
    const Eigen::VectorXd q = moves.cwiseProduct(state.head(n)), eps = s.before_force(q, state.tail(m));
    const Eigen::VectorXd change = moves.cwiseProduct(state.segment(n, n) + dt * dt * s.acceleration(q, eps));
    map.col(k) << q + change, change, s.evaluated(q, eps);
  }
  double largest = 0.0;
  for (const std::complex<double>& z : eigenvalues(map, "step matrix")) {
    if (std::abs(z - 1.0) > 1e-5) largest = std::max(largest, std::abs(z));
  }
  return largest - 1.0;
}

}  // namespace ddem::test
