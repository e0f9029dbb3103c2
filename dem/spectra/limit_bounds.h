#pragma once
// Bounds of the lagged scheme's limits (spectra.h) that take one look at every bond, where the limits themselves take minutes at
// 1e6 discs.

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"

namespace ddem {

/// Not below the spectral radius of T = (V C_p)^-1 G^T K G. In eps.G^T K G eps a bond has k (g_i.eps_i + g_j.eps_j)^2, which is at
/// most twice the sum of the squares, so that
///   rho <= 2 max_p of the largest eigenvalue of (V_p C_p)^-1 sum_c k g_p g_p^T,
/// equal where all discs strain alike, as in a lattice. Also for the normal correction, whose S takes shear forces that drop out of T.
double fixed_point_bound(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation);

/// A step not above flip_limit_step(), s, from the critical step of rigid discs with the same dofs held; 0: no bound. With
/// N = (V C_p)^-1/2 S_n K_n^1/2, of which the fixed point has the radius rho = |N|^2 below its reach R = 2/w - 1, a motion that flips
/// meets K^1/2 (1 + X) K^1/2 (scheme_stiffness.h): the limit is not below the critical step over the root of 1 + |X|.
/// Symmetric corrections: for an odd number of evaluations 1 + X has the eigenvalues 1/(1+b) + 2b/(1+b) r^(s-1)/(1+r^s) <= R/(R - b), as
/// |r| < 1, so 1 + |X| <= R/(R - rho). The normal one: X = N^T (R - N N^T)^-1 [N, N_t] for s = 1, and |[N, N_t]|^2 is the radius with
/// the full one, so |X| <= sqrt(rho rho_full)/(R - rho). Even numbers of evaluations, and more than one of the normal one, have none.
double flip_limit_bound(const Assembly& assembly, const ContactParameters& contact, DeformationParameters deformation, double rigid_critical_step);

}  // namespace ddem
