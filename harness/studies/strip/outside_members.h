#pragma once
// The members of types that know nothing of files.

#include "dem/core/material.h"
#include "dem/core/packing.h"
#include "dem/simulation/simulation.h"
#include "dem/statics/moduli.h"
#include "harness/io/members.h"
#include "harness/references/effective_moduli.h"
#include "reports/figure.h"

namespace ddem {

DDEM_LAST_ENUMERATOR(Scheme, implicit)
DDEM_LAST_ENUMERATOR(Correction, normal_only_stress)
DDEM_MEMBERS(Period, x, y)
DDEM_MEMBERS(Packing, x, y, radius, period, length, width)
DDEM_MEMBERS(IsotropicModuli, bulk, shear)
DDEM_MEMBERS(Energies, kinetic, contact, particle, invariant)
DDEM_MEMBERS(EnergySample, time, energies)
DDEM_MEMBERS(InitialState, ux, uy, theta, vx, vy, omega)
DDEM_MEMBERS(TensorField, xx, yy, xy)
DDEM_MEMBERS(Snapshot, time, state, stress, strain)
DDEM_MEMBERS(StripTension, axial_stiffness, mass_per_length, lateral_contraction)

}  // namespace ddem

namespace ddem::references {

DDEM_MEMBERS(PlaneModuli, bulk, shear)

}  // namespace ddem::references

namespace ddem::reports {

DDEM_MEMBERS(Probe, x, y, label)

}  // namespace ddem::reports
