#pragma once
// Energy and virial of rows, as LAMMPS asks bond and pair styles for them.

#include "dem/lammps/bond_loop.h"

namespace ddem::lammps {

/// What is asked for; a null pointer: not that.
struct Tally {
  double* energy = nullptr;         ///< sum of (k_n u_n^2 + k_t u_t^2) / 2
  double* virial = nullptr;         ///< xx, yy, zz, xy, xz, yz
  double* energy_of_disc = nullptr;
  double** virial_of_disc = nullptr;
};

/// Of a row whose both ends this rank sums, all; of any other, which the rank of the other end has, too, half. Each disc has
/// half of what is its own.
void tally(const LoopLaw& law, const BondRows& rows, const Discs& discs, const Tally& to);

}  // namespace ddem::lammps
