// Strains of discs, from the sums s (x) F of their bonds: eps = D : sigma, sigma = sum / V (theory section 1).
#include <lammps/atom.h>
#include <lammps/comm.h>
#include <lammps/force.h>

#include <algorithm>
#include <numbers>

#include "dem/lammps/fix_ddem.h"
#include "dem/lammps/lammps_api.h"

namespace ddem::lammps {

void FixDdem::clear_stress(int from, int to) {
  for (int i = from; i < to; ++i) std::fill_n(disc_[i] + kStress, 3, 0.0);
}

/// Ghosts' sums start anew: those of pairs and then of bonds.
void FixDdem::clear_ghosts() {
  if (strained()) clear_stress(atom->nlocal, atom->nlocal + atom->nghost);
}

void FixDdem::collect_stress() {
  const bool given_to_ghosts = force->newton_bond != 0 || (pair_ != nullptr && force->newton_pair != 0);
  if (strained() && given_to_ghosts) from_ghosts(comm, this, kAllColumns - kStress);
}

/// eps <- (1 - w) eps + w D : sigma; the sums start anew.
void FixDdem::advance_strains(double w) {
  const int discs = atom->nlocal;
  if (discs == 0) return;
  const Compliance d = compliance_;
  const double old = 1.0 - w;
  double* row = disc_[0];
  for (int i = 0; i < discs; ++i, row += kAllColumns) {
    double *eps = row + kStrain, *sum = row + kStress;
    const double over_volume = w * of_disc_[static_cast<std::size_t>(i)].over_volume;
    const double xx = sum[0] * over_volume, yy = sum[1] * over_volume, xy = sum[2] * over_volume;
    eps[0] = old * eps[0] + (d.direct * xx + d.coupling * yy);
    eps[1] = old * eps[1] + (d.coupling * xx + d.direct * yy);
    eps[2] = old * eps[2] + d.shear * xy;
    sum[0] = sum[1] = sum[2] = 0.0;
  }
}

/// Strains from the displacements of this step. Lagged: the further evaluations of a step. Implicit: from rest, by the weights
/// of the polynomial, eps <- eps + w_k (f - eps - T eps); f - T eps is what the forces of the overlaps and of eps together make.
void FixDdem::strain_passes() {
  const bool implicit = options_.deformation.scheme == Scheme::implicit;
  const int passes = implicit ? static_cast<int>(options_.weights.size()) : options_.deformation.evaluations - 1;
  if (implicit) {
    for (int i = 0; i < atom->nlocal; ++i) std::fill_n(disc_[i] + kStrain, 6, 0.0);
  }
  for (int k = 0; k < passes; ++k) {
    clear_ghosts();
    add_contact_stresses();
    add_stresses(law_, implicit && k == 0, rows_, discs());
    collect_stress();
    advance_strains(implicit ? options_.weights[static_cast<std::size_t>(k)] : options_.deformation.relaxation);
    send(Sent::strain);
  }
}

/// Sum of V/2 eps : C : eps.
double FixDdem::strain_energy() const {
  const double young = 1.0 / compliance_.direct, nu = -compliance_.coupling * young, k = young / (1.0 - nu * nu);
  double energy = 0.0;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double* eps = disc_[i] + kStrain;
    const double volume = options_.volume_over_disc * options_.thickness * std::numbers::pi * atom->radius[i] * atom->radius[i];
    const double direct = k * (eps[0] * eps[0] + eps[1] * eps[1] + 2.0 * nu * eps[0] * eps[1]);
    energy += 0.5 * volume * (direct + 2.0 * eps[2] * eps[2] / compliance_.shear);
  }
  return energy;
}

}  // namespace ddem::lammps
