#include "fem_reference/kernel/material.h"

#include <cmath>
#include <stdexcept>

namespace ddem::fem {

PlaneMaterial plane_material(double young_modulus, double poisson_ratio, double density, Plane plane) {
  if (!(young_modulus > 0.0) || !std::isfinite(young_modulus)) {
    throw std::invalid_argument("Young's modulus must be positive");
  }
  if (!(density > 0.0) || !std::isfinite(density)) throw std::invalid_argument("density must be positive");
  const double largest = plane == Plane::stress ? 1.0 : 0.5;
  if (!(poisson_ratio > -1.0 && poisson_ratio < largest)) {
    throw std::invalid_argument(plane == Plane::stress
                                    ? "Poisson's ratio must lie between -1 and 1 in plane stress"
                                    : "Poisson's ratio must lie between -1 and 0.5 in plane strain");
  }
  const double nu = plane == Plane::stress ? poisson_ratio : poisson_ratio / (1.0 - poisson_ratio);
  const double shear_modulus = young_modulus / (2.0 * (1.0 + poisson_ratio));
  return {2.0 * shear_modulus * nu / (1.0 - nu), shear_modulus, density};
}

}  // namespace ddem::fem
