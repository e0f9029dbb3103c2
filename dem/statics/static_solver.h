#pragma once
// Static equilibrium of an assembly under a macroscopic strain, with converged particle strains.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "dem/statics/held_dofs.h"
#include "dem/statics/operators.h"

namespace ddem {

/// Equilibrium: displacement E . x + fluctuation (without a macroscopic strain the displacement itself), and the forces of
/// the bonds.
struct StaticState {
  Eigen::VectorXd fluctuation;  ///< q as in Operators
  Eigen::VectorXd bond_forces;  ///< rows as in Operators::overlap, N
};

/// How the operators change with a parameter p: C, G and S do not.
struct OperatorRates {
  Eigen::VectorXd stiffness;           ///< diagonal of dK/dp, N/m a unit of p
  std::array<double, 3> compliance{};  ///< d ln/dp of the compliance of a disc in each mode (strain_modes.h)
};

/// Force (x, y) of bond c on its disc i, N.
Eigen::Vector2d bond_force(const Bonds& bonds, const OperatorFrame& operators, const StaticState& state, std::size_t c);

/// Factorises once, solves for any number of strains; not from several threads at once. The system in (q, eps) is
///   [ C^T K C    -C^T K G      ] [q  ]     [ C^T K e_E ]
///   [ -S K C     V C + S K G   ] [eps] = - [ -S K e_E  ],   e_E = affine overlaps;
/// symmetric positive definite for F and NN; scaled (bond_system.h) and factorised front by front (front_factors.h).
/// Modes without stiffness (rigid motion, floppy discs) get a regularisation of 1e-11 of the stiffest entry, the
/// same for every scaled unknown, whose influence refinement takes out again. Forces are refined beside the unknowns and
/// not made from them in the end: of soft discs they are what is left of large overlaps, which loses their digits.
class StaticSolver {
 public:
  /// Throws std::runtime_error if the factorisation fails.
  StaticSolver(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation,
               const HeldDofs& held);
  ~StaticSolver();
  StaticSolver(StaticSolver&&) noexcept;

  /// Throws std::runtime_error if the forces out of balance do not fall below 1e-12 of the forces.
  StaticState solve(const MacroStrain& strain) const;
  /// Of several at once, the same bits in less time.
  std::vector<StaticState> solve(std::span<const MacroStrain> strains) const;
  /// The same for held degrees of freedom that are moved: their entries of `displacement` (q as in Operators, the others 0).
  StaticState solve_moved(const Eigen::VectorXd& displacement) const;
  /// d(state)/dp of an equilibrium that solve() returned, macroscopic strain and held degrees of freedom as they are:
  ///   M [dq; deps] = [ -C^T dK w; S dK w - d(V C) eps ],  dF = dK w + K (C dq - G deps),  w = K^-1 F,
  /// by the same factorisation; V C eps = S F, so that d(V C) eps is S F times minus d ln of the compliance. Throws as solve().
  StaticState rate(const StaticState& state, const OperatorRates& rates) const;
  const OperatorFrame& operators() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ddem
