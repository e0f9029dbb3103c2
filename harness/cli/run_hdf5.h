#pragma once
// What a simulation leaves behind besides its signals: energies over time, and fields of all discs.

#include "harness/io/hdf5.h"
#include "harness/run/dem_run.h"

namespace ddem::harness {

/// /energy: time, kinetic, contact, particle, invariant (J), one value a sample; or an attribute `status` saying why not.
/// /fields: x, y, radius (m) of every disc; time of every snapshot; displacement_x, displacement_y, rotation, velocity_x,
/// velocity_y, angular_velocity, stress_xx .. stress_xy (Pa), strain_xx .. strain_xy: snapshots x discs.
void write_energy_and_fields(Hdf5Group& root, const DemRun& run);

}  // namespace ddem::harness
