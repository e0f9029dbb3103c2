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

void add_styles(LAMMPS_NS::LAMMPS* lmp) {
  (*lmp->force->pair_map)["ddem"] = [](LAMMPS_NS::LAMMPS* l) -> LAMMPS_NS::Pair* { return new PairDdem(l); };
  (*lmp->force->bond_map)["ddem"] = [](LAMMPS_NS::LAMMPS* l) -> LAMMPS_NS::Bond* { return new BondDdem(l); };
  (*lmp->modify->fix_map)["ddem"] = [](LAMMPS_NS::LAMMPS* l, int count, char** words) -> LAMMPS_NS::Fix* { return new FixDdem(l, count, words); };
}

}  // namespace ddem::lammps
