#pragma once
// The polynomial that stands for (1 + T)^-1 in implicit strains, the eigenvalues of T in [0, rho].
//
// eps = p(T) f makes the stiffness of a mode with eigenvalue t wrong by the fraction t r(t), r the residual polynomial
// 1 - (1 + t) p(t), r(-1) = 1. Its m zeros t_k make a product of m relaxations, eps <- eps + w_k (f - (1 + T) eps) with
// w_k = 1 / (1 + t_k), from eps = 0. Each costs a pass over the bonds, so of two choices of zeros the shorter is taken:
//  - for long waves: uniform deformations excite few modes (two on a lattice). The zeros are the nodes of the Gauss
//    quadrature of what they excite, as conjugate gradients would choose them for these loads.
//  - for all motions alike: t r(t) is the Chebyshev polynomial whose first and last zeros are 0 and rho.

#include <vector>

#include "dem/spectra/strain_spectrum.h"

namespace ddem {

/// How much further than the tolerance the stiffness of motions may be off that are no long waves; one per cent at most.
inline constexpr double kShortWaveAllowance = 100.0;
inline constexpr double kLargestShortWaveError = 0.01;

/// The weights w_k, two at least (the first two are one sweep), as many as make the moduli right within `tolerance` of
/// themselves (a bound: errors of modes do not cancel) and the stiffness of any other motion within 100 times that, or 0.01;
/// ordered (Leja) so that round-off does not grow on the way.
/// Throws std::invalid_argument unless the radius is finite and not negative and tolerance in (0, 0.5) (below that the
/// effective stiffness stays positive), and where it would take more than 2000 terms.
std::vector<double> strain_relaxations(const StrainSpectrum& spectrum, double tolerance);
/// The same for the spectrum of an assembly, at the tolerance of `deformation`.
std::vector<double> strain_relaxations(const Assembly& assembly, const ContactParameters& contact,
                                       const DeformationParameters& deformation);

}  // namespace ddem
