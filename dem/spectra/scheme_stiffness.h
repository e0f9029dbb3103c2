#pragma once
// The stiffness that a motion meets when the particle strains answer to it: C^T (K - K G Q S K) C in the symbols of
// statics/operators.h, with eps = Q S K C u. Which Q depends on the scheme and on the motion:
//   converged strains                Q = (V C_p + S K G)^-1
//   implicit strains                 Q = p(T) (V C_p)^-1, p the polynomial of strain_polynomial.h
//   lagged, a motion that alternates from step to step (the flip, z = -1): eps_n = -eps_{n-1} closes the recurrence
//   eps_{m+1} = R eps_m + w H u, R = 1 - w - w T, T = (V C_p)^-1 S K G, over the s evaluations of a step, hence
//     Q = g(T) (V C_p)^-1,  g(b) = (1 - 2 r^(s-1) / (1 + r^s)) / (1 + b),  r = 1 - w - w b.
//   For s = 1 that is Q = -((2/w - 1) V C_p - S K G)^-1.
//   lagged, a slow motion: its strains are converged ones less dt Q S K C u', with
//     Q = g(T) (V C_p)^-1,  g(b) = r^(s-1) / ((1 - r^s) (1 + b)),
//   since a step leaves R^s of what its strains lack, and the force is taken one evaluation before its end.

#include <Eigen/SparseCholesky>
#include <functional>
#include <vector>

#include "dem/statics/operators.h"
#include "dem/statics/static_solver.h"

namespace ddem {

class SchemeStiffness {
 public:
  /// Plain DEM too, where the operators have no strains.
  static SchemeStiffness converged(const Operators& operators);

  /// `relaxations` as strain_relaxations() gives them.
  static SchemeStiffness polynomial(const Operators& operators, std::vector<double> relaxations);

  /// `radius` is the spectral radius of T, and must be below 2/w - 1: throws std::invalid_argument otherwise.
  static SchemeStiffness flip(const Operators& operators, const DeformationParameters& deformation, double radius);

  /// Of the strains that a slow motion lacks, over dt: strains(S K C u') alone, not a stiffness. Same condition.
  static SchemeStiffness lag(const Operators& operators, const DeformationParameters& deformation, double radius);

  /// Q times that; not for plain DEM.
  Eigen::VectorXd strains(const Eigen::VectorXd& stress) const { return strains_(stress); }

  /// The operators must outlive this.
  Eigen::VectorXd apply(const Eigen::VectorXd& q) const;

 private:
  using Strains = std::function<Eigen::VectorXd(const Eigen::VectorXd& stress)>;
  SchemeStiffness(const Operators& operators, Strains strains) : op_(&operators), strains_(std::move(strains)) {}

  const Operators* op_;
  Strains strains_;  ///< Q; empty for plain DEM
};

/// Sets what is held to zero, of 2 or 3 `components` a disc.
void hold(const HeldDofs& held, int components, Eigen::VectorXd& values);

/// M^-1/2, zero where held.
Eigen::VectorXd mass_scaling(const Operators& operators, const HeldDofs& held);

/// S K G.
SparseMatrix strain_coupling(const Operators& operators);

/// T made symmetric: L^-1 S K G L^-T with V C_p = L L^T. S K G is symmetric for every correction, since where S takes
/// shear forces that G does not correct (N), they drop out.
class StrainIteration {
 public:
  explicit StrainIteration(const Operators& operators);

  Eigen::Index size() const { return matrix_.rows(); }
  Eigen::VectorXd apply(const Eigen::VectorXd& x) const { return matrix_ * x; }
  /// L^-1 x and L^-T x.
  Eigen::VectorXd lower_solve(const Eigen::VectorXd& x) const { return factor_.matrixL().solve(x); }
  Eigen::VectorXd upper_solve(const Eigen::VectorXd& x) const { return factor_.matrixU().solve(x); }

 private:
  Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> factor_;  // 3 x 3 blocks
  SparseMatrix matrix_;                                                                   // T
};

/// Of T: the lagged strains converge where it is below 2/w - 1.
double spectral_radius(const StrainIteration& t);

}  // namespace ddem
