#pragma once
// How an assembly's operators change with the parameters that a calibration searches.

#include "dem/statics/static_solver.h"

namespace ddem {

/// k_n stays as it is.
enum class Parameter {
  stiffness_ratio,        ///< lambda = k_t/k_n, which must be positive: at 0 the rotations drop out
  log_softness,           ///< ln(k_n/(E_p h))
  particle_poisson_ratio  ///< nu_p
};

/// Derivatives of K and V_p C_p (see operators.h). With plane constants e, n of the disc the rows of C_p are
///   e/(1-n^2) (1, n, 0),  e/(1-n^2) (n, 1, 0),  (0, 0, 2 e/(1+n)),
/// in plane strain e = E_p/(1-nu_p^2), n = nu_p/(1-nu_p). Throws std::invalid_argument where the assembly has
/// no such parameter: lambda = 0, or no deformable discs.
OperatorRates operator_rates(const Assembly& assembly, const Operators& operators,
                             const ContactParameters& contact, const DeformationParameters& deformation,
                             Parameter parameter);

}  // namespace ddem
