#pragma once
// One time step as a linear map of the very assembly's state, and its eigenvectors: how fast which motion grows. Dense,
// for small assemblies: what critical_step() and the plane waves of bloch.h are checked with, and where runs are started.
//
// Leapfrog, q the displacements of statics/operators.h, w_n = q_n - q_{n-1}:
//   converged strains  w_{n+1} = w_n - dt^2 M^-1 K_eff q_n, whose factors are the roots of z - 2 + 1/z = -(omega dt)^2
//   lagged             R = 1 - w - w T, T = (V C)^-1 S K G, H = (V C)^-1 S K C (scheme_stiffness.h): the s evaluations
//                      of a step take eps_n to eps_{n+1} = R^s eps_n + w (1 + .. + R^(s-1)) H q_n, and the force takes
//                      the strains of the last evaluation but one

#include <Eigen/Core>
#include <complex>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/statics/held_dofs.h"

namespace ddem {

/// A motion q_n = Re(z^n motion) of a scheme: `factor` z a step. Velocities follow: v_{n-1/2} dt = (1 - 1/z) q_n.
struct StepMode {
  std::complex<double> factor;
  Eigen::VectorXcd motion;  ///< q as in Operators, the largest component 1
};

/// A factor so near to 1 belongs to a rigid translation, a defective double eigenvalue 1 that round-off splits by 1e-8;
/// the slowest waves of a small assembly are 1e-3 and more away.
inline constexpr double kTranslationFactor = 1e-5;

/// Of all free motions but rigid translations, the one that grows fastest or decays slowest; of those that do neither,
/// that of the largest frequency. Takes O((9 discs)^3) with lagged strains and shear stiffness, 1 s for 50 discs.
/// Throws std::runtime_error if the eigenvalues do not converge.
StepMode leading_mode(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation, double time_step);

/// Largest |z| - 1 of all free motions but rigid ones, of the very step: what is held stays, and implicit strains are as the
/// polynomial finds them. Above 0 the step is unstable. Right to kGrowthRoundOff; takes O(step_unknowns^3), 3 s for 1000.
/// Throws std::runtime_error if the eigenvalues do not converge.
double step_growth(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation, const HeldDofs& held,
                   double time_step);

/// Eigenvalues on the unit circle are off it by round-off, more where several coincide, as a lattice's do.
inline constexpr double kGrowthRoundOff = 1e-9;

/// Of that matrix.
std::size_t step_unknowns(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation);

}  // namespace ddem
