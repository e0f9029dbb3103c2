#pragma once
// The bonds of a rank by their first disc, or its contacts without bonds, and the one loop over them.

#include <optional>
#include <utility>
#include <vector>

#include "dem/lammps/bond_law.h"
#include "dem/lammps/bond_sweeps.h"

namespace ddem::lammps {

/// Bonds of disc i: bond[first[i]] to bond[first[i + 1]].
struct BondRows {
  std::vector<int> first;
  std::vector<BondGeometry> bond;
  /// One a bond, or one for all (stride 0).
  std::vector<double> k_n, k_t;
  int stride = 0;
  std::vector<double> slip;       ///< bonds in nonlinear kinematics alone
  std::vector<double> start_gap;  ///< contacts alone

  int discs() const { return static_cast<int>(first.size()) - 1; }
};

/// Adds the forces of all bonds and, with strains, their s (x) F. Slip of nonlinear kinematics advances.
void add_forces(const LoopLaw& law, BondRows& rows, const Discs& discs, const Loads& loads);

/// Adds s (x) F alone; `from_rest`: as if all strains were zero.
void add_stresses(const LoopLaw& law, bool from_rest, BondRows& rows, const Discs& discs);

/// The overlap and force that bond b of disc i had in add_forces(); of a contact that is open they are 0.
struct BondState {
  Overlap overlap;
  BondForce force;
  double energy;  ///< (k_n u_n^2 + k_t u_t^2) / 2
};
/// Its overlap alone; of a contact the gap, open or not.
Overlap overlap_of(const LoopLaw& law, const BondRows& rows, const Discs& discs, int i, int b);
BondState state_of(const LoopLaw& law, const BondRows& rows, const Discs& discs, int i, int b);

/// The row of discs i and j, first disc either of them; nothing where there is none. `same(a, b)`: local disc b is an image of a.
template <class Same>
std::optional<BondState> find_state(const LoopLaw& law, const BondRows& rows, const Discs& discs, int i, int j, Same&& same) {
  for (const auto& [from, to] : {std::pair{i, j}, std::pair{j, i}}) {
    if (from >= rows.discs()) continue;
    for (int b = rows.first[static_cast<std::size_t>(from)]; b < rows.first[static_cast<std::size_t>(from) + 1]; ++b) {
      if (same(rows.bond[static_cast<std::size_t>(b)].j, to)) return state_of(law, rows, discs, from, b);
    }
  }
  return std::nullopt;
}

}  // namespace ddem::lammps
