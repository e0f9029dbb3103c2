#pragma once
// A bound of fixed_point_radius() that takes one look at every bond, where Lanczos' iteration takes minutes at 1e6 discs.

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"

namespace ddem {

/// Not below the spectral radius of T = (V C_p)^-1 G^T K G. In eps.G^T K G eps a bond has k (g_i.eps_i + g_j.eps_j)^2, which is at
/// most twice the sum of the squares, so that
///   rho <= 2 max_p of the largest eigenvalue of (V_p C_p)^-1 sum_c k g_p g_p^T,
/// equal where all discs strain alike, as in a lattice. Also for the normal correction, whose S takes shear forces that drop out of T.
double fixed_point_bound(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation);

}  // namespace ddem
