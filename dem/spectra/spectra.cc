#include "dem/spectra/spectra.h"

#include <Eigen/SparseCholesky>
#include <Spectra/SymEigsSolver.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace ddem {
namespace {

/// A symmetric operator for Spectra, given as a function.
struct SymmetricOperator {
  using Scalar = double;
  Eigen::Index size;
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> apply;

  Eigen::Index rows() const { return size; }
  Eigen::Index cols() const { return size; }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, size) = apply(Eigen::Map<const Eigen::VectorXd>(x, size));
  }
};

/// The residual is r = 1e-5 of the eigenvalue at most, and the eigenvalue then right to about r^2 or better.
double largest_eigenvalue(SymmetricOperator op, const char* what) {
  const Eigen::Index basis = std::min<Eigen::Index>(op.size, 40);
  if (op.size < 3) throw std::invalid_argument(std::string(what) + ": too few unknowns");
  Spectra::SymEigsSolver<SymmetricOperator> solver(op, 1, basis);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, 2000, 1e-5);
  if (solver.info() != Spectra::CompInfo::Successful) {
    throw std::runtime_error(std::string(what) + ": the Lanczos iteration did not converge");
  }
  return solver.eigenvalues()[0];
}

/// M^-1/2, zero where held.
Eigen::VectorXd mass_scaling(const Operators& op, const HeldDofs& held) {
  Eigen::VectorXd s = op.inverse_mass.cwiseSqrt();
  const auto hold = [&](const std::vector<std::uint8_t>& mask, int component) {
    for (std::size_t p = 0; p < mask.size(); ++p) {
      if (mask[p]) s[op.dofs_per_disc * static_cast<Eigen::Index>(p) + component] = 0.0;
    }
  };
  hold(held.x, 0);
  hold(held.y, 1);
  if (op.dofs_per_disc == 3) hold(held.theta, 2);
  return s;
}

using Cholesky = Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;

}  // namespace

double largest_frequency(const Assembly& a, const ContactParameters& contact, const HeldDofs& held) {
  const Operators op = make_operators(a, contact, {});
  const Eigen::VectorXd s = mass_scaling(op, held);
  const SparseMatrix k = s.asDiagonal() * op.stiffness_matrix() * s.asDiagonal();
  const double lambda = largest_eigenvalue(
      {k.rows(), [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return k * x; }}, "critical time step");
  return std::sqrt(lambda);
}

double fixed_point_radius(const Assembly& a, const ContactParameters& contact,
                          const DeformationParameters& deformation) {
  const Operators op = make_operators(a, contact, deformation);
  const SparseMatrix skg = op.stress * op.stiffness.asDiagonal() * op.strain_overlap;
  const Cholesky vc(op.strain_stiffness);  // 3 x 3 blocks
  const double radius = largest_eigenvalue({skg.rows(),
                                            [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
                                              const Eigen::VectorXd y = skg * vc.matrixU().solve(x);
                                              return vc.matrixL().solve(y);
                                            }},
                                           "fixed-point radius");
  return radius;
}

double flip_limit_step(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation,
                       const HeldDofs& held) {
  const Operators op = make_operators(a, contact, deformation);
  if (!op.symmetric) throw std::invalid_argument("the flip limit needs a correction that derives from an energy");
  const SparseMatrix kg = op.stiffness.asDiagonal() * op.strain_overlap;
  // (K^-1 - B)^-1 = K + K G (V C - G^T K G)^-1 G^T K by Woodbury.
  const Eigen::SimplicialLLT<SparseMatrix> inner(SparseMatrix(op.strain_stiffness - op.stress * kg));
  if (inner.info() != Eigen::Success) {
    throw std::invalid_argument("the lagged strains do not converge (fixed-point radius above 1): no flip limit");
  }
  const Eigen::VectorXd s = mass_scaling(op, held);
  const double lambda = largest_eigenvalue(
      {op.overlap.cols(),
       [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
         const Eigen::VectorXd force = op.stiffness.cwiseProduct(op.overlap * s.cwiseProduct(x));
         const Eigen::VectorXd correction = kg * inner.solve(op.strain_overlap.transpose() * force);
         return s.cwiseProduct(op.overlap.transpose() * (force + correction));
       }},
      "flip limit");
  return 2.0 / std::sqrt(lambda);
}

}  // namespace ddem
