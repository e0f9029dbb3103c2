#pragma once
// The volume over which a disc's contact forces are averaged.

#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"

namespace ddem {

/// V_p of every disc, m3: see ParticleVolume.
std::vector<double> particle_volumes(const Assembly& assembly, const DeformationParameters& deformation);

/// V_p / r_p^2, m: the same for every disc under either policy.
double volume_over_square_radius(const Assembly& assembly, const DeformationParameters& deformation);

}  // namespace ddem
