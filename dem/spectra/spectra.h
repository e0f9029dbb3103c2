#pragma once
// Extreme eigenvalues of an assembly's operators: critical time steps and the limits of each scheme.

#include <optional>

#include "dem/assembly/assembly.h"
#include "dem/core/material.h"
#include "dem/statics/static_solver.h"

namespace ddem {

/// Largest angular frequency of the bonded assembly with rigid discs, rad/s: omega_max^2 = lambda_max(M^-1 C^T K C).
/// The critical step of leapfrog is 2 / omega_max. Relative accuracy 1e-6 (above 20000 unknowns 5e-4). Throws std::runtime_error if Lanczos fails.
double largest_frequency(const Assembly& assembly, const ContactParameters& contact, const HeldDofs& held);

/// The same with converged strains, below that of rigid discs. For N with shear stiffness, which has no energy, the
/// root of the eigenvalue of largest magnitude, which is real wherever the fastest mode does not flutter.
double largest_converged_frequency(const Assembly& assembly, const ContactParameters& contact,
                                   const DeformationParameters& deformation, const HeldDofs& held);

/// The same with strains as the implicit scheme finds them: fast motions meet a stiffness up to 1 % off that of converged
/// ones (deformation.tolerance; strain_polynomial.h).
double largest_implicit_frequency(const Assembly& assembly, const ContactParameters& contact,
                                  const DeformationParameters& deformation, const HeldDofs& held);

/// Spectral radius of K B: the lagged strains converge only where it is below 2/w - 1, w the relaxation (theory section
/// 3). It is proportional to k_n/E_p. K B has the spectrum of (V C)^-1 S K G, symmetric for every correction.
double fixed_point_radius(const Assembly& assembly, const ContactParameters& contact,
                          const DeformationParameters& deformation);

/// Step at which the lagged scheme flips, i.e. the strains of successive steps alternate and grow: dt^2 times the
/// largest eigenvalue of M^-1 times the stiffness that an alternating motion meets (scheme_stiffness.h) is 4. For one
/// evaluation without relaxation that stiffness is C^T (K^-1 - B)^-1 C. Throws std::invalid_argument where the strains
/// do not converge.
double flip_limit_step(const Assembly& assembly, const ContactParameters& contact,
                       const DeformationParameters& deformation, const HeldDofs& held);

/// What bounds the time step of a scheme.
enum class StepBound {
  oscillation,  ///< 2/omega_max of rigid discs or of implicit strains
  flip,         ///< flip_limit_step
  fixed_point,  ///< no step: the lagged strains do not converge
  feeding       ///< none that is safe for sure: an even number of evaluations overshoots in some strains, and feeds the motions
                ///< that consist of these (step_growth in step_map.h tells)
};

struct CriticalStep {
  StepBound bound = StepBound::oscillation;
  std::optional<double> step;  ///< s
};

/// The sharp critical step of the very assembly and scheme. For N with shear stiffness it is the step at which the fast
/// modes blow up: slow growth of others (flutter.h) is not in it.
CriticalStep critical_step(const Assembly& assembly, const ContactParameters& contact,
                           const DeformationParameters& deformation, const HeldDofs& held);

/// The factor by which k_n/E_p may be multiplied before a step becomes unstable lies between these.
struct SoftnessFactor {
  double at_least = 0.0, at_most = 0.0;
};

/// For a step `dt`; lagged only. Right to 1e-3, but where an even number of evaluations overshoots: which motions consist of
/// the strains that do is known of small assemblies only, from the eigenvalues of the step (ten times step_growth in
/// step_map.h); else the bounds lie apart. For N with shear stiffness as critical_step(): without what grows slowly. None where
/// the step is beyond the critical one however stiff the discs, or every strain overshoots.
std::optional<SoftnessFactor> stable_softness_factor(const Assembly& assembly, const ContactParameters& contact,
                                                     const DeformationParameters& deformation, const HeldDofs& held, double dt);

}  // namespace ddem
