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

/// Of the bonds' stiffness and the discs' compliance. Throws std::invalid_argument where the assembly has no such parameter:
/// lambda = 0, or no deformable discs.
OperatorRates operator_rates(const OperatorFrame& operators, const ContactParameters& contact, const DeformationParameters& deformation,
                             Parameter parameter);

}  // namespace ddem
