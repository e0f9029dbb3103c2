// libddem-lammps-styles.so: the styles for a LAMMPS that runs already, such as the stock lmp through its PYTHON package.
#include "dem/lammps/styles.h"

/// 0, or the version of LAMMPS that the styles were compiled for, where this one is another.
extern "C" int ddem_add_styles(void* lammps) {
  auto* lmp = static_cast<LAMMPS_NS::LAMMPS*>(lammps);
  if (ddem::lammps::running_version(lmp) != ddem::lammps::compiled_version()) return ddem::lammps::compiled_version();
  ddem::lammps::add_styles(lmp);
  return 0;
}
