#include "harness/references/lattice_stability.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ddem::references {

double hexagonal_fixed_point_limit(ContactModel model, double poisson_ratio, double stiffness_ratio) {
  if (model == ContactModel::dem) throw std::invalid_argument("plain DEM has no fixed point to converge");
  if (!(poisson_ratio > -1.0 && poisson_ratio < 1.0))
    throw std::invalid_argument("a plane Poisson's ratio lies between -1 and 1");
  if (!(stiffness_ratio >= 0.0) || !std::isfinite(stiffness_ratio))
    throw std::invalid_argument("the stiffness ratio must be finite and not negative");
  const double c = model == ContactModel::ddem_full ? 1.0 + stiffness_ratio : 1.0;
  return std::min(std::numbers::pi / (6.0 * (1.0 - poisson_ratio)),
                  std::numbers::pi / (3.0 * (1.0 + poisson_ratio) * c));
}

double hexagonal_fixed_point_radius(ContactModel model, const Contact& contact, const Disc& disc) {
  const double softness = contact.normal_stiffness / (disc.material.young_modulus * disc.thickness);
  if (!(softness > 0.0) || !std::isfinite(softness))
    throw std::invalid_argument("stiffness, Young's modulus and thickness must be positive and finite");
  return softness / hexagonal_fixed_point_limit(model, disc.material.poisson_ratio, contact.stiffness_ratio);
}

double hexagonal_critical_step(double normal_stiffness, double mass) {
  if (!(normal_stiffness > 0.0 && mass > 0.0 && std::isfinite(normal_stiffness) && std::isfinite(mass)))
    throw std::invalid_argument("stiffness and mass must be positive and finite");
  return 2.0 / std::sqrt(6.0 * normal_stiffness / mass);
}

}  // namespace ddem::references
