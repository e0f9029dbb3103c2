#pragma once
// The spectrum of the discs' coupling T = (V C_p)^-1 S K G (theory section 3), as far as a polynomial that stands for
// (1 + T)^-1 needs it: how far it reaches, and where the part lies that uniform deformations, and so long waves, excite.

#include <vector>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"

namespace ddem {

/// What a uniform deformation excites: modes of T by eigenvalue, and the elastic energy that the discs' strains would take
/// from each if they answered without each other, as a share of the energy of the deformation with converged strains.
/// An error q(t) of the residual of (1 + T)^-1 at t changes the energy by the fraction sum share q(t) / (1 + t).
struct ModeShares {
  std::vector<double> eigenvalue, share;
};

struct StrainSpectrum {
  double radius = 0.0;              ///< of T
  std::vector<ModeShares> uniform;  ///< dilation, and both shears
};

/// By Lanczos' iteration: the radius to 1e-5 or better (1e-3 above 20000 unknowns), the shares by twelve-point Gauss
/// quadrature of each deformation's own spectral measure. Throws std::runtime_error if the iteration fails.
StrainSpectrum strain_spectrum(const Assembly& assembly, const ContactParameters& contact,
                               const DeformationParameters& deformation);

}  // namespace ddem
