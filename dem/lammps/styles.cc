#include "dem/lammps/styles.h"

#include <lammps/force.h>
#include <lammps/library.h>
#include <lammps/modify.h>

#include "dem/lammps/bond_ddem.h"
#include "dem/lammps/fix_ddem.h"
#include "dem/lammps/pair_ddem.h"

namespace ddem::lammps {

int compiled_version() { return DDEM_LAMMPS_VERSION; }
int running_version(LAMMPS_NS::LAMMPS* lmp) { return lammps_version(lmp); }

LAMMPS_NS::Pair* make_pair(LAMMPS_NS::LAMMPS* lmp) { return new PairDdem(lmp); }
LAMMPS_NS::Bond* make_bond(LAMMPS_NS::LAMMPS* lmp) { return new BondDdem(lmp); }
LAMMPS_NS::Fix* make_fix(LAMMPS_NS::LAMMPS* lmp, int count, char** words) { return new FixDdem(lmp, count, words); }

void add_styles(LAMMPS_NS::LAMMPS* lmp) {
  (*lmp->force->pair_map)["ddem"] = make_pair;
  (*lmp->force->bond_map)["ddem"] = make_bond;
  (*lmp->modify->fix_map)["ddem"] = make_fix;
}

}  // namespace ddem::lammps
