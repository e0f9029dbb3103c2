#include "dem/statics/operator_rates.h"

#include <stdexcept>

#include "dem/statics/strain_modes.h"

namespace ddem {

OperatorRates operator_rates(const OperatorFrame& op, const ContactParameters& contact, const DeformationParameters& deformation,
                             Parameter parameter) {
  OperatorRates rates;
  rates.stiffness = Eigen::VectorXd::Zero(op.stiffness.size());
  if (parameter == Parameter::stiffness_ratio) {
    if (op.rows_per_bond != 2)
      throw std::invalid_argument(
          "moduli have no derivative with respect to k_t/k_n at 0, where rotations drop out");
    for (Eigen::Index r = 1; r < op.stiffness.size(); r += 2)
      rates.stiffness[r] = op.stiffness[r] / contact.stiffness_ratio;
    return rates;
  }
  if (!op.deformable) throw std::invalid_argument("rigid discs have no softness and no Poisson's ratio");
  if (parameter == Parameter::log_softness) {
    rates.compliance.fill(1.0);
  } else {
    const std::array<double, 3> compliance = mode_compliances(deformation), change = mode_compliance_rates(deformation);
    for (std::size_t k = 0; k < 3; ++k) rates.compliance[k] = change[k] / compliance[k];
  }
  return rates;
}

}  // namespace ddem
