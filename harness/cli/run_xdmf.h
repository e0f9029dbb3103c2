#pragma once
// A run's discs as points over time.

#include <string>

#include "harness/io/hdf5.h"
#include "harness/run/dem_run.h"

namespace ddem::harness {

/// /points: position (discs x 3), index, and a group 0000, 0001, ... a snapshot with displacement and
/// velocity (discs x 3), rotation, stress_xx .. strain_xy as views of /fields, which must be there: they
/// store nothing twice.
void write_points(Hdf5Group& root, const DemRun& run);

/// XDMF of the discs with those fields, and radius for their size. `hdf5`: the file's name, in
/// the same folder.
std::string xdmf_text(const DemRun& run, const std::string& hdf5);

}  // namespace ddem::harness
