// The bonds of this rank, from the lists of LAMMPS, and what they remember.
#include <lammps/atom.h>
#include <lammps/domain.h>
#include <lammps/error.h>
#include <lammps/force.h>
#include <lammps/neighbor.h>

#include <algorithm>
#include <cmath>

#include "dem/lammps/bond_ddem.h"
#include "dem/lammps/fix_ddem.h"

namespace ddem::lammps {

using std::string_literals::operator""s;

void FixDdem::build_rows() {
  const int bonds = neighbor->nbondlist;
  // Ghosts have the reference of their discs, in another image: the nearest is the bonded one.
  send(Sent::reference);
  const bool uniform = bonds_->uniform();
  rows_.stride = uniform ? 0 : 1;
  rows_.bond.resize(static_cast<std::size_t>(bonds));
  rows_.k_n.resize(static_cast<std::size_t>(uniform ? 1 : bonds));
  rows_.k_t.resize(rows_.k_n.size());
  rows_.slip.resize(static_cast<std::size_t>(nonlinear() ? bonds : 0));
  rows_.first.assign(static_cast<std::size_t>(atom->nlocal) + 1, 0);
  for (int n = 0; n < bonds; ++n) ++rows_.first[static_cast<std::size_t>(neighbor->bondlist[n][0]) + 1];
  for (std::size_t i = 1; i < rows_.first.size(); ++i) rows_.first[i] += rows_.first[i - 1];
  std::vector<int> next(rows_.first.begin(), rows_.first.end());
  for (int n = 0; n < bonds; ++n) {
    const int* entry = neighbor->bondlist[n];  // i, j, type
    set_row(next[static_cast<std::size_t>(entry[0])]++, entry[0], entry[1], entry[2]);
  }
}

/// n and arms of the reference: a_i = r_i L / (r_i + r_j).
void FixDdem::set_row(int b, int i, int j, int type) {
  const auto nearest = [this](double d, int axis) {
    return domain->periodicity[axis] != 0 ? d - domain->prd[axis] * std::round(d / domain->prd[axis]) : d;
  };
  const double dx = nearest(reference_[j][0] - reference_[i][0], 0), dy = nearest(reference_[j][1] - reference_[i][1], 1);
  const double length = std::sqrt(dx * dx + dy * dy), r_i = atom->radius[i], r_j = atom->radius[j], stretch = length / (r_i + r_j);
  for (int axis = 0; axis < 2; ++axis) {
    if (domain->periodicity[axis] != 0 && !(domain->prd[axis] > 2.0 * length))
      error->one(FLERR, "fix ddem: a period of the box must exceed twice the longest bond"s);
  }
  const auto at = static_cast<std::size_t>(b), stiffness = at * static_cast<std::size_t>(rows_.stride);
  rows_.bond[at] = {dx / length, dy / length, r_i * stretch, r_j * stretch, j};
  rows_.k_n[stiffness] = bonds_->normal_stiffness(type, r_i, r_j);
  rows_.k_t[stiffness] = bonds_->shear_stiffness(type, r_i, r_j);
  if (nonlinear()) rows_.slip[at] = slip_[i][slot_of(i, atom->tag[j])];
}

/// Which of the bonds of disc i is that with `other`; -1: it is kept by that one alone (newton on).
int FixDdem::slot_of(int i, LAMMPS_NS::tagint other) const {
  const LAMMPS_NS::tagint* partners = atom->bond_atom[i];
  const auto* end = partners + atom->num_bond[i];
  const auto* found = std::find(partners, end, other);
  return found == end ? -1 : static_cast<int>(found - partners);
}

/// Slip, which reads the same from either end, goes to the discs before they move to other ranks. With newton off both ends
/// keep a bond, and either may be its first disc afterwards.
void FixDdem::keep_slip() {
  if (!nonlinear() || !rows_hold_) return;
  for (int i = 0; i < rows_.discs(); ++i) {
    for (int b = rows_.first[static_cast<std::size_t>(i)]; b < rows_.first[static_cast<std::size_t>(i) + 1]; ++b) {
      const int j = rows_.bond[static_cast<std::size_t>(b)].j;
      for (const auto& [own, other] : {std::pair{i, j}, std::pair{j, i}}) {
        const int slot = own < atom->nlocal ? slot_of(own, atom->tag[other]) : -1;
        if (slot >= 0) slip_[own][slot] = rows_.slip[static_cast<std::size_t>(b)];
      }
    }
  }
}

}  // namespace ddem::lammps
