#pragma once
// bond_style ddem, pair_style ddem and fix ddem, made known to a LAMMPS that runs.

namespace LAMMPS_NS {
class LAMMPS;
}

namespace ddem::lammps {

/// The LAMMPS whose headers this was compiled with, as year month day.
int compiled_version();
/// Of the library that runs.
int running_version(LAMMPS_NS::LAMMPS* lmp);

/// After `clear`, which forgets them, again. The versions must agree: the layouts of classes differ.
void add_styles(LAMMPS_NS::LAMMPS* lmp);

}  // namespace ddem::lammps
