#pragma once
// The bonds of a rank by their first disc, and the one loop over them.

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
  std::vector<double> slip;  ///< nonlinear kinematics alone

  int discs() const { return static_cast<int>(first.size()) - 1; }
};

/// Adds the forces of all bonds and, with strains, their s (x) F. Slip of nonlinear kinematics advances.
void add_forces(const LoopLaw& law, BondRows& rows, const Discs& discs, const Loads& loads);

/// Adds s (x) F alone; `from_rest`: as if all strains were zero.
void add_stresses(const LoopLaw& law, bool from_rest, BondRows& rows, const Discs& discs);

/// The overlap and force that bond b of disc i had in add_forces().
struct BondState {
  Overlap overlap;
  BondForce force;
  double energy;  ///< (k_n u_n^2 + k_t u_t^2) / 2
};
BondState state_of(const LoopLaw& law, const BondRows& rows, const Discs& discs, int i, int b);

}  // namespace ddem::lammps
