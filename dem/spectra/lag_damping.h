#pragma once
// How strongly the lag of the strains damps long waves, or feeds them: first order in the step, for any number of
// evaluations and any assembly.
//
// A slow motion u lacks the strains dt Q S K C u' (scheme_stiffness.h), and its force differs by D u',
// D = dt C^T K G Q S K C. A free wave of frequency omega therefore changes by a factor
//   |z| - 1 = -(omega dt)^2/2 s,  s = u^T D u / (dt u^T K_eff u),
// in a step, u its shape: locally that of the uniform strain which a long wave is, with the fluctuations of equilibrium.
// Where all strains converge alike (b is one number, as on the lattice) s = b r^(s-1)/(1 - r^s), theory section 3.

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/statics/static_solver.h"

namespace ddem {

/// Where the shape is looked at: bonds whose first disc has its centre at from <= x <= to, m.
struct InnerSection {
  double from = 0.0, to = 0.0;
};

/// s of the shape in equilibrium under a strain, `radius` the spectral radius of the fixed point (spectra.h). The solver is
/// of that assembly, with these contacts and deformation. Throws std::invalid_argument where the strains do not converge.
double lag_share(const Assembly& assembly, const StaticSolver& solver, const ContactParameters& contact, const DeformationParameters& deformation, double radius,
                 const MacroStrain& strain, const InnerSection& section);

}  // namespace ddem
