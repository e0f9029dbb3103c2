#include "dem/lammps/pair_ddem.h"

#include <lammps/atom.h>
#include <lammps/comm.h>
#include <lammps/error.h>
#include <lammps/force.h>
#include <lammps/memory.h>
#include <lammps/utils.h>

#include <algorithm>
#include <cstring>

#include "dem/lammps/fix_ddem.h"
#include "dem/lammps/tally.h"

namespace ddem::lammps {

using std::string_literals::operator""s;

using LAMMPS_NS::utils::numeric;

PairDdem::PairDdem(LAMMPS_NS::LAMMPS* l) : Pair(l) {
  writedata = 0;
  // x.F of the whole, LAMMPS' short cut, has positions for the arms of the reference.
  no_virial_fdotr_compute = 1;
}

PairDdem::~PairDdem() {
  if (allocated == 0) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

PairDdem* PairDdem::of(LAMMPS_NS::LAMMPS* l) { return dynamic_cast<PairDdem*>(l->force->pair_match("ddem", 1)); }

/// pair_style ddem REACH
void PairDdem::settings(int count, char** words) {
  if (count != 1) error->all(FLERR, "pair_style ddem: give by how much strains may move two boundaries towards each other"s);
  reach_ = numeric(FLERR, words[0], false, lmp);
  if (!(reach_ >= 0.0)) error->all(FLERR, "pair_style ddem: the reach must be at least 0"s);
}

void PairDdem::allocate() {
  allocated = 1;
  const int n = atom->ntypes + 1;
  types_ = static_cast<std::size_t>(n);
  of_types_.assign(types_ * types_, {});
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  std::fill_n(setflag[0], types_ * types_, 0);
}

/// pair_coeff I J k_n, or pair_coeff I J modulus M.
void PairDdem::coeff(int count, char** words) {
  if (allocated == 0) allocate();
  const bool sized = count == 4 && std::strcmp(words[2], "modulus") == 0;
  if (count != 3 && !sized) error->all(FLERR, "pair_coeff of pair_style ddem: give TYPES TYPES k_n, or TYPES TYPES modulus M"s);
  const double stiffness = numeric(FLERR, words[count - 1], false, lmp);
  if (!(stiffness > 0.0)) error->all(FLERR, "pair_coeff of pair_style ddem: the stiffness must be above 0"s);
  int first_i = 0, last_i = 0, first_j = 0, last_j = 0;
  LAMMPS_NS::utils::bounds(FLERR, words[0], 1, atom->ntypes, first_i, last_i, error);
  LAMMPS_NS::utils::bounds(FLERR, words[1], 1, atom->ntypes, first_j, last_j, error);
  for (int i = first_i; i <= last_i; ++i) {
    for (int j = std::max(first_j, i); j <= last_j; ++j) {
      between(i, j) = between(j, i) = {sized ? 0.0 : stiffness, sized ? stiffness : 0.0};
      setflag[i][j] = 1;
    }
  }
}

void PairDdem::init_style() {
  fix_ = FixDdem::of(lmp);
  if (fix_ == nullptr) error->all(FLERR, "pair_style ddem needs a fix ddem, which keeps the displacements of the discs"s);
  std::vector<double> own(static_cast<std::size_t>(atom->ntypes) + 1, 0.0);
  for (int i = 0; i < atom->nlocal; ++i) {
    double& largest = own[static_cast<std::size_t>(atom->type[i])];
    largest = std::max(largest, atom->radius[i]);
  }
  largest_radius_.resize(own.size());
  MPI_Allreduce(own.data(), largest_radius_.data(), static_cast<int>(own.size()), MPI_DOUBLE, MPI_MAX, world);
  Pair::init_style();  // a list of neighbours, each pair once
}

double PairDdem::init_one(int i, int j) {
  if (setflag[i][j] == 0) error->all(FLERR, "pair_style ddem: a pair of types has no pair_coeff (all of them: pair_coeff * * k_n)"s);
  return largest_radius_[static_cast<std::size_t>(i)] + largest_radius_[static_cast<std::size_t>(j)] + reach_;
}

double PairDdem::normal_stiffness(int type_i, int type_j, double r_i, double r_j) const {
  const Coefficient& c = of_types_[static_cast<std::size_t>(type_i) * types_ + static_cast<std::size_t>(type_j)];
  return c.modulus > 0.0 ? c.modulus * 2.0 * r_i * r_j / (r_i + r_j) : c.normal_stiffness;
}

void PairDdem::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  fix_->add_contact_forces(*atom->f, *atom->torque);
  if (evflag == 0) return;
  tally(fix_->contact_law(), fix_->contacts(), fix_->discs_of_contacts(),
        {eflag_global != 0 ? &eng_vdwl : nullptr, vflag_global != 0 ? virial : nullptr, eflag_atom != 0 ? eatom : nullptr, vflag_atom != 0 ? vatom : nullptr});
}

double PairDdem::single(int i, int j, int, int, double, double, double, double& normal_force) {
  const auto same = [this](int a, int b) { return atom->tag[a] == atom->tag[b]; };
  const auto s = find_state(fix_->contact_law(), fix_->contacts(), fix_->discs_of_contacts(), i, j, same);
  // As LAMMPS has it: over the distance, repulsion positive.
  normal_force = s ? -s->force.normal / (s->overlap.arm_i + s->overlap.arm_j) : 0.0;
  return s ? s->energy : 0.0;
}

/// LAMMPS leaves the settings to the style.
void PairDdem::write_restart(std::FILE* file) {
  write_restart_settings(file);
  std::fwrite(setflag[0], sizeof(int), types_ * types_, file);
  std::fwrite(of_types_.data(), sizeof(Coefficient), of_types_.size(), file);
}

void PairDdem::read_restart(std::FILE* file) {
  read_restart_settings(file);
  allocate();
  if (comm->me == 0) {
    LAMMPS_NS::utils::sfread(FLERR, setflag[0], sizeof(int), types_ * types_, file, nullptr, error);
    LAMMPS_NS::utils::sfread(FLERR, of_types_.data(), sizeof(Coefficient), of_types_.size(), file, nullptr, error);
  }
  MPI_Bcast(setflag[0], static_cast<int>(types_ * types_), MPI_INT, 0, world);
  MPI_Bcast(of_types_.data(), static_cast<int>(of_types_.size() * sizeof(Coefficient)), MPI_BYTE, 0, world);
}

void PairDdem::write_restart_settings(std::FILE* file) { std::fwrite(&reach_, sizeof reach_, 1, file); }

void PairDdem::read_restart_settings(std::FILE* file) {
  if (comm->me == 0) LAMMPS_NS::utils::sfread(FLERR, &reach_, sizeof reach_, 1, file, nullptr, error);
  MPI_Bcast(&reach_, 1, MPI_DOUBLE, 0, world);
}

}  // namespace ddem::lammps
