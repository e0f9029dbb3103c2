#pragma once
// Flutter: free vibrations with complex frequencies, which grow by themselves. Only a correction without an energy (N
// with shear stiffness) has them, whatever the time step; the hexagonal lattice never shows them (theory section 3).

#include <complex>
#include <optional>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/statics/static_solver.h"

namespace ddem {

struct FlutterSearch {
  double largest_frequency = 0.0;  ///< omega_max with converged strains, rad/s
  /// Of the fastest growing vibration: it grows as exp(Im(omega) t). Right to 2 % in the imaginary part.
  std::optional<std::complex<double>> frequency;
  double detectable = 0.0;  ///< growth below this share of omega_max is not seen
};

/// Looks for flutter with converged strains. A dense eigenproblem of 682 discs would take half a minute, and 27 times
/// that for three times the discs; instead Arnoldi's iteration is applied to 3000 steps of leapfrog from rest,
/// u -> T_3000(1 - dt^2 A/2) u with A = M^-1 K_eff: real frequencies stay within [-1, 1] there, and what grows stands out.
/// Proportional to the number of discs, some 10 s for 682. Corrections with an energy are answered at once.
FlutterSearch find_flutter(const Assembly& assembly, const ContactParameters& contact,
                           const DeformationParameters& deformation, const HeldDofs& held);

}  // namespace ddem
