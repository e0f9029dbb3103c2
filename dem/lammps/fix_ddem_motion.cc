// Motion of discs: half a kick, a drift, half a kick.
#include <lammps/atom.h>
#include <lammps/update.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/lammps/fix_ddem.h"

namespace ddem::lammps {
namespace {

double driven_displacement(const Drive& drive, double time) {
  if (time >= drive.duration) return 0.0;
  const double sine = std::sin(std::numbers::pi * (time / drive.duration));
  return drive.amplitude * sine * sine;
}

}  // namespace

bool FixDdem::holds(int i, int which) const { return (atom->mask[i] & options_.held[static_cast<std::size_t>(which)]) != 0; }

/// Half a step over mass and inertia, I = m r^2/2. What is held, or not of the group, is at rest and stays so.
void FixDdem::prepare_discs() {
  const double pi = std::numbers::pi, of_disc = options_.volume_over_disc * options_.thickness;
  of_disc_.resize(static_cast<std::size_t>(atom->nlocal));
  for (int i = 0; i < atom->nlocal; ++i) {
    const double m = atom->rmass[i], r = atom->radius[i];
    const bool moves = options_.integrate && (atom->mask[i] & groupbit) != 0;
    const auto kick = [&](int which, double inertia) { return moves && !holds(i, which) ? half_step_ / inertia : 0.0; };
    of_disc_[static_cast<std::size_t>(i)] = {kick(0, m), kick(1, m), kick(2, 0.5 * m * r * r), 1.0 / (of_disc * pi * r * r)};
    if (!options_.integrate) continue;
    if (!moves || holds(i, 0)) atom->v[i][0] = 0.0;
    if (!moves || holds(i, 1)) atom->v[i][1] = 0.0;
    if (!moves || holds(i, 2)) atom->omega[i][2] = 0.0;
  }
}

/// Half a step of v += dt F/m, omega += dt M/I; with it the drift of a whole one.
template <bool kDrift>
void FixDdem::kick() {
  const int discs = atom->nlocal, columns = size_peratom_cols;
  if (discs == 0) return;
  const double *f = atom->f[0], *torque = atom->torque[0], dt = step_;
  double *v = atom->v[0], *omega = atom->omega[0], *x = atom->x[0], *disc = disc_[0];
  const OfDisc* of = of_disc_.data();
  for (int i = 0; i < discs; ++i, ++of, f += 3, torque += 3, v += 3, omega += 3, x += 3, disc += columns) {
    const double vx = v[0] + of->kick_x * f[0], vy = v[1] + of->kick_y * f[1], turning = omega[2] + of->kick_theta * torque[2];
    v[0] = vx, v[1] = vy, omega[2] = turning;
    if constexpr (kDrift) {
      const double dx = dt * vx, dy = dt * vy;
      disc[kUx] += dx, disc[kUy] += dy, disc[kTheta] += dt * turning;
      x[0] += dx, x[1] += dy;
    }
  }
}

void FixDdem::initial_integrate(int) {
  // The strains of the coming forces are those of the forces that there are; implicit ones begin anew.
  if (options_.deformation.scheme == Scheme::lagged) advance_strains(options_.deformation.relaxation);
  else if (strained()) clear_stress(0, atom->nlocal);
  if (nonlinear()) remember_motion();
  if (options_.integrate) kick<true>();
  else follow();
  if (options_.drive.on) impose_drive(update->ntimestep);
}

void FixDdem::final_integrate() {
  if (options_.integrate) kick<false>();
}

/// Somebody else integrates, and has done so before this fix in the same stage of the step.
void FixDdem::follow() {
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    disc_[i][kUx] += step_ * atom->v[i][0];
    disc_[i][kUy] += step_ * atom->v[i][1];
    disc_[i][kTheta] += step_ * atom->omega[i][2];
  }
}

/// A sin^2(pi t/T) up to T, then 0; t is counted from step 0.
void FixDdem::impose_drive(LAMMPS_NS::bigint step) {
  const Drive& drive = options_.drive;
  const int c = drive.along_x ? kUx : kUy;
  const double now = driven_displacement(drive, static_cast<double>(step) * step_);
  const double velocity = begun_ ? (now - driven_displacement(drive, static_cast<double>(step - 1) * step_)) / step_ : 0.0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & drive.group_bit) == 0) continue;
    atom->x[i][c] += now - disc_[i][c];
    disc_[i][c] = now;
    atom->v[i][c] = velocity;
  }
}

void FixDdem::remember_motion() {
  for (int i = 0; i < atom->nlocal; ++i) std::copy_n(disc_[i], 3, previous_[i]);
}

double FixDdem::kinetic_energy(bool turning) const {
  double energy = 0.0;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double *v = atom->v[i], turn = atom->omega[i][2] * atom->radius[i];
    energy += 0.5 * atom->rmass[i] * (turning ? 0.5 * turn * turn : v[0] * v[0] + v[1] * v[1]);
  }
  return energy;
}

}  // namespace ddem::lammps
