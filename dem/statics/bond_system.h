#pragma once
// The equations of static equilibrium as a sum over bonds, over the unknowns (q, eps) of the discs that it joins:
//   A = sum_c l_c^T k_c r_c + V C,   r = [C, -G], l = [C, -S^T]
// With V C on the diagonal of the strains, a disc's unknowns together, in the order of elimination. What is held has no
// part in any row and a 1 on the diagonal.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "dem/statics/elimination_tree.h"
#include "dem/statics/held_dofs.h"
#include "dem/statics/operators.h"

namespace ddem {

struct BondSystem {
  int displacements = 2;              ///< a disc's unknowns: those of q, and behind them
  int strains = 0;                    ///< none, or 3
  int rows_per_bond = 1;
  std::vector<int> place;             ///< of each disc
  std::vector<int> first, second;     ///< places of a bond's discs
  std::vector<double> right, left;    ///< r and l: of each row the unknowns of the first disc and of the second; without l symmetric
  Eigen::VectorXd stiffness;          ///< of each row, over the scale
  std::vector<double> strain_stiffness;  ///< V C of each place, 3 x 3, over the scale
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
  /// A x.
  Eigen::VectorXd product(const Eigen::VectorXd& x) const;
};

/// `scale`: of the stiffnesses, N/m.
BondSystem bond_system(const Assembly& assembly, const Operators& operators, const DeformationParameters& deformation, const HeldDofs& held,
                       const EliminationTree& tree, double scale);

}  // namespace ddem
