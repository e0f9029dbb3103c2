#pragma once
// Extreme eigenvalues of an assembly's operators: the critical time step and the limits of the lagged scheme.

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/statics/static_solver.h"

namespace ddem {

/// Largest angular frequency of the bonded assembly with rigid discs, rad/s: omega_max^2 = lambda_max(M^-1 C^T K C).
/// The critical step of leapfrog is 2 / omega_max. Relative accuracy 1e-6. Throws std::runtime_error if Lanczos fails.
double largest_frequency(const Assembly& assembly, const ContactParameters& contact, const HeldDofs& held);

/// Spectral radius of K B: the lagged strains converge only where it is below 1 (theory section 3). K B has the
/// spectrum of (V C)^-1 S K G, which is symmetric for every correction: where S takes shear forces that G does not
/// correct (N), they drop out of S K G.
double fixed_point_radius(const Assembly& assembly, const ContactParameters& contact,
                          const DeformationParameters& deformation);

/// Largest step of the lagged scheme before the flip instability: dt^2 lambda_max(M^-1 C^T (K^-1 - B)^-1 C) = 4, for a
/// scheme with symmetric B. Requires fixed_point_radius < 1, throws std::invalid_argument otherwise.
double flip_limit_step(const Assembly& assembly, const ContactParameters& contact,
                       const DeformationParameters& deformation, const HeldDofs& held);

}  // namespace ddem
