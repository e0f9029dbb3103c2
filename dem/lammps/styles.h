#pragma once
// bond_style ddem, pair_style ddem and fix ddem, made known to a LAMMPS that runs.

namespace LAMMPS_NS {
class LAMMPS;
class Pair;
class Bond;
class Fix;
}

namespace ddem::lammps {

/// The LAMMPS whose headers this was compiled with, as year month day.
int compiled_version();
/// Of the library that runs.
int running_version(LAMMPS_NS::LAMMPS* lmp);

LAMMPS_NS::Pair* make_pair(LAMMPS_NS::LAMMPS* lmp);
LAMMPS_NS::Bond* make_bond(LAMMPS_NS::LAMMPS* lmp);
LAMMPS_NS::Fix* make_fix(LAMMPS_NS::LAMMPS* lmp, int count, char** words);

/// After `clear`, which forgets them, again. The versions must agree: the layouts of classes differ.
void add_styles(LAMMPS_NS::LAMMPS* lmp);

}  // namespace ddem::lammps
