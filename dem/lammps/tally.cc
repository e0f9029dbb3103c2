#include "dem/lammps/tally.h"

namespace ddem::lammps {
namespace {

/// Components xx, yy and xy of LAMMPS' six; `share` of them.
void add_virial(double* to, double share, const BondState& s) {
  // The centres' distance is the sum of the arms; F acts on the first disc, at -L n from the second.
  const double length = s.overlap.arm_i + s.overlap.arm_j, dx = -length * s.overlap.nx, dy = -length * s.overlap.ny;
  to[0] += share * dx * s.force.x;
  to[1] += share * dy * s.force.y;
  to[3] += share * 0.5 * (dx * s.force.y + dy * s.force.x);
}

}  // namespace

void tally(const LoopLaw& law, const BondRows& rows, const Discs& discs, const Tally& to) {
  for (int i = 0; i < rows.discs(); ++i) {
    for (int b = rows.first[static_cast<std::size_t>(i)]; b < rows.first[static_cast<std::size_t>(i) + 1]; ++b) {
      const int j = rows.bond[static_cast<std::size_t>(b)].j;
      const BondState s = state_of(law, rows, discs, i, b);
      const bool whole = j < discs.writable;
      const double share = whole ? 1.0 : 0.5;
      if (to.energy != nullptr) *to.energy += share * s.energy;
      if (to.virial != nullptr) add_virial(to.virial, share, s);
      for (const int d : {i, j}) {
        if (d == j && !whole) continue;
        if (to.energy_of_disc != nullptr) to.energy_of_disc[d] += 0.5 * s.energy;
        if (to.virial_of_disc != nullptr) add_virial(to.virial_of_disc[d], 0.5, s);
      }
    }
  }
}

}  // namespace ddem::lammps
