#pragma once
// The equations of static equilibrium as a sum over bonds, over the unknowns (q, z) of the discs that it joins:
//   A = sum_c l_c^T k_c r_c + D,   r = [C, -G s], l = [C, -S^T s]
// The strains are taken in their modes (strain_modes.h), eps = s z, each in such a unit that its stiffness is of order one
// however soft or stiff the disc is: with d the compliance of a mode over V, as a number, s^2 = d/(1 + d), and D = s^2/d = 1/(1 + d) on
// the diagonal of z. So all stays regular where a disc does not give, d = 0. A disc's unknowns stand together, in the order
// of elimination. What is held has no part in any row and a 1 on the diagonal.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "dem/statics/elimination_tree.h"
#include "dem/statics/held_dofs.h"
#include "dem/statics/operators.h"

namespace ddem {

struct BondSystem {
  int displacements = 2;              ///< a disc's unknowns: those of q, and behind them
  int strains = 0;                    ///< none, or 3: (a, d, s)
  int rows_per_bond = 1;
  std::vector<int> place;             ///< of each disc
  std::vector<int> first, second;     ///< places of a bond's discs
  std::vector<double> right, left;    ///< r and l: of each row the unknowns of the first disc and of the second; without l symmetric
  Eigen::VectorXd stiffness;          ///< of each row, over the scale
  std::vector<double> strain_stiffness;  ///< D: three of each place
  std::vector<std::uint8_t> held;     ///< of each unknown

  int unknowns_per_disc() const { return displacements + strains; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(place.size()) * unknowns_per_disc(); }
  bool symmetric() const { return left.empty(); }
  /// Where the unknowns of a disc begin.
  Eigen::Index at(int disc) const { return static_cast<Eigen::Index>(place[disc]) * unknowns_per_disc(); }

  /// r x of each row: C q - G eps.
  Eigen::VectorXd overlaps(const Eigen::VectorXd& x) const;
  /// l^T f: [C^T f; -S f].
  Eigen::VectorXd loads(const Eigen::VectorXd& forces) const;
  /// l^T f + D x, and x where it is held.
  Eigen::VectorXd balance(const Eigen::VectorXd& forces, const Eigen::VectorXd& x) const;
};

/// `scale`: of the stiffnesses, N/m.
BondSystem bond_system(const Assembly& assembly, const OperatorFrame& operators, const DeformationParameters& deformation, const HeldDofs& held,
                       const EliminationTree& tree, double scale);

}  // namespace ddem
