#pragma once
// The continuum model's fields over time.

#include <string>

#include "harness/io/hdf5.h"
#include "harness/run/fem_run.h"

namespace ddem::harness {

/// /fields: time of every snapshot (s); displacement_x, displacement_y (m), velocity_x, velocity_y (m/s), strain_xx, strain_yy,
/// strain_xy (of the tensor), stress_xx, stress_yy, stress_xy (Pa): snapshots x points. /points: position (points x 3, m),
/// quadrilaterals (count x 4), and a group 0000, 0001, ... a snapshot with displacement and velocity (points x 3), and the
/// components of stress and strain, as views of /fields: they store nothing twice.
void write_fem_fields(Hdf5Group& root, const FemFields& fields);

/// XDMF of that mesh with those fields. `hdf5`: the file's name, in the same folder.
std::string fem_xdmf_text(const FemFields& fields, const std::string& hdf5);

}  // namespace ddem::harness
