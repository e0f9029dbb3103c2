#include "dem/lammps/bond_ddem.h"

#include <lammps/atom.h>
#include <lammps/comm.h>
#include <lammps/error.h>
#include <lammps/force.h>
#include <lammps/memory.h>
#include <lammps/neighbor.h>
#include <lammps/utils.h>

#include <algorithm>
#include <cstring>

#include "dem/lammps/fix_ddem.h"
#include "dem/lammps/tally.h"

namespace ddem::lammps {

using std::string_literals::operator""s;

using LAMMPS_NS::utils::numeric;

BondDdem::BondDdem(LAMMPS_NS::LAMMPS* l) : Bond(l) { writedata = 0; }

BondDdem::~BondDdem() {
  if (allocated != 0) memory->destroy(setflag);
}

void BondDdem::settings(int count, char** words) {
  const std::string word = count == 1 ? words[0] : count == 0 ? "linear" : "";
  if (word != "linear" && word != "nonlinear") error->all(FLERR, "bond_style ddem: give linear or nonlinear"s);
  kinematics_ = word == "linear" ? Kinematics::linear : Kinematics::nonlinear;
}

void BondDdem::allocate() {
  allocated = 1;
  of_type_.resize(static_cast<std::size_t>(atom->nbondtypes) + 1);
  memory->create(setflag, atom->nbondtypes + 1, "bond:setflag");
  std::fill_n(setflag, atom->nbondtypes + 1, 0);
}

/// bond_coeff TYPES k_n ratio, or TYPES modulus M ratio.
void BondDdem::coeff(int count, char** words) {
  if (allocated == 0) allocate();
  const bool sized = count == 4 && std::strcmp(words[1], "modulus") == 0;
  if (count != 3 && !sized) error->all(FLERR, "bond_coeff of bond_style ddem: give TYPES k_n ratio, or TYPES modulus M ratio"s);
  const double stiffness = numeric(FLERR, words[count - 2], false, lmp), ratio = numeric(FLERR, words[count - 1], false, lmp);
  if (!(stiffness > 0.0) || !(ratio >= 0.0)) error->all(FLERR, "bond_coeff of bond_style ddem: the stiffness must be above 0, the ratio at least 0"s);
  int first = 0, last = 0;
  LAMMPS_NS::utils::bounds(FLERR, words[0], 1, atom->nbondtypes, first, last, error);
  for (int type = first; type <= last; ++type) {
    of_type_[static_cast<std::size_t>(type)] = {sized ? 0.0 : stiffness, sized ? stiffness : 0.0, ratio};
    setflag[type] = 1;
  }
}

void BondDdem::init_style() {
  fix_ = FixDdem::of(lmp);
  if (fix_ == nullptr) error->all(FLERR, "bond_style ddem needs a fix ddem, which keeps the displacements of the discs"s);
}

double BondDdem::normal_stiffness(int type, double r_i, double r_j) const {
  const Coefficient& c = of_type_[static_cast<std::size_t>(type)];
  return c.modulus > 0.0 ? c.modulus * 2.0 * r_i * r_j / (r_i + r_j) : c.normal_stiffness;
}

double BondDdem::shear_stiffness(int type, double r_i, double r_j) const {
  return of_type_[static_cast<std::size_t>(type)].ratio * normal_stiffness(type, r_i, r_j);
}

bool BondDdem::uniform() const {
  return std::all_of(of_type_.begin() + 1, of_type_.end(), [this](const Coefficient& c) {
    return c.modulus == 0.0 && c.normal_stiffness == of_type_[1].normal_stiffness && c.ratio == of_type_[1].ratio;
  });
}

void BondDdem::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  fix_->add_bond_forces(*atom->f, *atom->torque);
  if (evflag == 0) return;
  tally(fix_->law(), fix_->rows(), fix_->discs(),
        {eflag_global != 0 ? &energy : nullptr, vflag_global != 0 ? virial : nullptr, eflag_atom != 0 ? eatom : nullptr, vflag_atom != 0 ? vatom : nullptr});
}

/// The longest bond is not known before bonds are found; discs that touch are two radii apart.
double BondDdem::equilibrium_distance(int) {
  double largest = 0.0;
  for (int i = 0; i < atom->nlocal; ++i) largest = std::max(largest, atom->radius[i]);
  double of_all = largest;
  MPI_Allreduce(&largest, &of_all, 1, MPI_DOUBLE, MPI_MAX, world);
  return 2.0 * of_all;
}

double BondDdem::single(int, double, int i, int j, double& normal_force) {
  const auto same = [this](int a, int b) { return atom->tag[a] == atom->tag[b]; };
  const auto s = find_state(fix_->law(), fix_->rows(), fix_->discs(), i, j, same);
  // As LAMMPS has it: over the distance, repulsion positive.
  normal_force = s ? -s->force.normal / (s->overlap.arm_i + s->overlap.arm_j) : 0.0;
  return s ? s->energy : 0.0;
}

/// LAMMPS leaves the settings to the style.
void BondDdem::write_restart(std::FILE* file) {
  write_restart_settings(file);
  std::fwrite(of_type_.data() + 1, sizeof(Coefficient), static_cast<std::size_t>(atom->nbondtypes), file);
}

void BondDdem::read_restart(std::FILE* file) {
  read_restart_settings(file);
  allocate();
  const auto types = static_cast<std::size_t>(atom->nbondtypes);
  if (comm->me == 0) LAMMPS_NS::utils::sfread(FLERR, of_type_.data() + 1, sizeof(Coefficient), types, file, nullptr, error);
  MPI_Bcast(of_type_.data() + 1, static_cast<int>(types * sizeof(Coefficient)), MPI_BYTE, 0, world);
  std::fill_n(setflag + 1, types, 1);
}

void BondDdem::write_restart_settings(std::FILE* file) { std::fwrite(&kinematics_, sizeof kinematics_, 1, file); }

void BondDdem::read_restart_settings(std::FILE* file) {
  if (comm->me == 0) LAMMPS_NS::utils::sfread(FLERR, &kinematics_, sizeof kinematics_, 1, file, nullptr, error);
  MPI_Bcast(&kinematics_, static_cast<int>(sizeof kinematics_), MPI_BYTE, 0, world);
}

}  // namespace ddem::lammps
