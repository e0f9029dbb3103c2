#include "dem/lammps/fix_ddem.h"

#include <lammps/atom.h>
#include <lammps/comm.h>
#include <lammps/domain.h>
#include <lammps/error.h>
#include <lammps/force.h>
#include <lammps/input.h>
#include <lammps/memory.h>
#include <lammps/modify.h>
#include <lammps/update.h>
#include <lammps/variable.h>

#include <algorithm>
#include <cstring>

#include "dem/lammps/bond_ddem.h"
#include "dem/lammps/pair_ddem.h"

namespace ddem::lammps {

using std::string_literals::operator""s;

using LAMMPS_NS::Atom;
namespace when = LAMMPS_NS::FixConst;

FixDdem* FixDdem::of(LAMMPS_NS::LAMMPS* l) {
  for (int k = 0; k < l->modify->nfix; ++k) {
    if (auto* fix = dynamic_cast<FixDdem*>(l->modify->fix[k])) return fix;
  }
  return nullptr;
}

FixDdem::FixDdem(LAMMPS_NS::LAMMPS* l, int count, char** words) : Fix(l, count, words), options_(fix_options(l, count - 3, words + 3)) {
  if (of(lmp) != nullptr) error->all(FLERR, "fix ddem: there is one already"s);
  if (domain->dimension != 2) error->all(FLERR, "fix ddem: discs need dimension 2"s);
  if (atom->radius_flag == 0 || atom->rmass_flag == 0 || atom->molecular != Atom::MOLECULAR || atom->tag_enable == 0)
    error->all(FLERR, "fix ddem: discs with bonds need atom_style hybrid sphere bond"s);
  bonds_ = dynamic_cast<BondDdem*>(force->bond);
  if (bonds_ == nullptr) error->all(FLERR, "fix ddem: give bond_style ddem before it"s);
  const DeformationParameters& d = options_.deformation;
  law_ = {Pairs::bonds, bonds_->kinematics(), d.active(), d.correction};
  contact_law_ = {Pairs::contacts, law_.kinematics, law_.strained, law_.correction};
  const bool asks_to_move = options_.drive.on || options_.held != std::array<int, 3>{};
  if (!options_.integrate && asks_to_move) error->all(FLERR, "fix ddem: what somebody else integrates it can neither hold nor drive"s);
  if (nonlinear() && d.scheme == Scheme::implicit) error->all(FLERR, "fix ddem: implicit strains need linear kinematics, of which their weights are found"s);
  if (strained()) compliance_ = disc_compliance(d);

  restart_global = restart_peratom = 1;
  time_integrate = options_.integrate ? 1 : 0;
  create_attribute = 1;
  peratom_flag = 1;
  peratom_freq = global_freq = 1;
  size_peratom_cols = strained() ? kAllColumns : kMotionColumns;
  scalar_flag = vector_flag = 1;
  size_vector = 2;
  extscalar = extvector = 1;
  energy_global_flag = 1;
  maxexchange = values_of_disc();
  comm_forward = kStress + kMotionColumns;  // at most: with the motion of the step before
  comm_reverse = kAllColumns - kStress;
  grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  reset_dt();
  take_reference();
}

FixDdem::~FixDdem() {
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
  memory->destroy(disc_);
  memory->destroy(reference_);
  memory->destroy(previous_);
  memory->destroy(slip_);
}

/// Discs are at the reference when the command is given. Their initial displacement moves them at the first run: a restart
/// file, which is read in between, has moved them already.
void FixDdem::take_reference() {
  for (int i = 0; i < atom->nlocal; ++i) set_arrays(i);
  std::vector<double> value(static_cast<std::size_t>(std::max(atom->nlocal, 1)), 0.0);
  for (int c = kUx; c <= kTheta; ++c) {
    const std::string& name = options_.initial[static_cast<std::size_t>(c)];
    if (name.empty()) continue;
    const int variable = input->variable->find(const_cast<char*>(name.c_str()));
    if (variable < 0 || input->variable->atomstyle(variable) == 0) error->all(FLERR, "fix ddem: there is no atom-style variable " + name);
    input->variable->compute_atom(variable, igroup, value.data(), 1, 0);
    for (int i = 0; i < atom->nlocal; ++i) disc_[i][c] = value[static_cast<std::size_t>(i)];
  }
}

int FixDdem::setmask() {
  return when::INITIAL_INTEGRATE | when::PRE_EXCHANGE | when::POST_NEIGHBOR | when::PRE_FORCE | when::POST_FORCE | when::FINAL_INTEGRATE;
}

void FixDdem::init() {
  if (update->whichflag == 2) error->all(FLERR, "fix ddem: energy is not minimised: use a run"s);
  if (std::strstr(update->integrate_style, "respa") != nullptr) error->all(FLERR, "fix ddem: run_style respa is not possible"s);
  if (force->bond != bonds_) error->all(FLERR, "fix ddem: bond_style was given again; give it, then the fix"s);
  pair_ = PairDdem::of(lmp);
  if (pair_ != nullptr && options_.deformation.scheme == Scheme::implicit)
    error->all(FLERR, "fix ddem: implicit strains know of bonds only: pair_style ddem goes with lagged ones and with rigid discs"s);
  reset_dt();
}

void FixDdem::reset_dt() {
  step_ = update->dt;
  half_step_ = 0.5 * update->dt * force->ftm2v;
  if (of_disc_.size() == static_cast<std::size_t>(atom->nlocal)) prepare_discs();
}

Discs FixDdem::discs() { return discs_shared(force->newton_bond != 0); }

/// Newton on: what ghosts are given goes to their owner. Off: the other rank sums it itself.
Discs FixDdem::discs_shared(bool newton) {
  const int writable = newton ? atom->nlocal + atom->nghost : atom->nlocal;
  const int columns = size_peratom_cols;
  return {disc_ == nullptr ? nullptr : disc_[0], columns, previous_ == nullptr ? nullptr : previous_[0], writable};
}

void FixDdem::setup_pre_exchange() {
  if (displaced_) return;
  for (int i = 0; i < atom->nlocal; ++i) {
    for (int c = kUx; c <= kUy; ++c) atom->x[i][c] += disc_[i][c];
  }
  displaced_ = true;
}

void FixDdem::pre_exchange() { keep_slip(); }

/// Commands between runs may renumber discs and ghosts, as write_restart does.
void FixDdem::post_run() {
  keep_slip();
  rows_hold_ = false;
}

void FixDdem::setup_post_neighbor() { post_neighbor(); }

void FixDdem::post_neighbor() {
  build_rows();
  build_contacts();
  prepare_discs();
}

/// The first forces of all: with the passes of several evaluations, and slip since the reference. Later ones, at the setup of
/// a further run, are those of the step before, again.
void FixDdem::setup_pre_force(int) {
  rows_hold_ = true;
  if (!begun_ && options_.drive.on) impose_drive(update->ntimestep);
  if (nonlinear() && begun_) remember_motion();
  if (strained()) clear_stress(0, atom->nlocal);
  send(Sent::all);
  const bool again = begun_ && options_.deformation.scheme == Scheme::lagged;
  if (strained() && !again) strain_passes();
  clear_ghosts();
  begun_ = true;
}

void FixDdem::pre_force(int) {
  send(options_.deformation.scheme == Scheme::lagged ? Sent::all : Sent::motion);
  if (strained()) strain_passes();
  clear_ghosts();
}

void FixDdem::add_bond_forces(double* force_of_all, double* torque_of_all) {
  add_forces(law_, rows_, discs(), {force_of_all, torque_of_all});
}

void FixDdem::setup(int) { collect_stress(); }
void FixDdem::post_force(int) { collect_stress(); }

double FixDdem::compute_scalar() {
  double own = strained() ? strain_energy() : 0.0, all = 0.0;
  MPI_Allreduce(&own, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixDdem::compute_vector(int n) {
  double own = kinetic_energy(n == 1), all = 0.0;
  MPI_Allreduce(&own, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixDdem::memory_usage() {
  const double numbers = size_peratom_cols + 2 + (nonlinear() ? 3 + atom->bond_per_atom : 0);
  const auto of_rows = [](const BondRows& r) {
    return sizeof(BondGeometry) * r.bond.capacity() + sizeof(double) * (r.k_n.capacity() + r.k_t.capacity() + r.slip.capacity() + r.start_gap.capacity());
  };
  return 8.0 * numbers * atom->nmax + static_cast<double>(of_rows(rows_) + of_rows(contacts_) + sizeof(double) * watched_from_.capacity());
}

}  // namespace ddem::lammps
