#include "harness/references/plane_elasticity.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "harness/references/require_positive.h"

namespace ddem::references {
namespace {

void require_poisson_ratio(double nu, double upper) {
  if (!(nu > -1.0 && nu < upper))
    throw std::invalid_argument(fmt::format("Poisson's ratio must lie between -1 and {}, not {}", upper, nu));
}

}  // namespace

PlaneConstants plane_constants(const PlaneModuli& moduli) {
  require_positive(moduli.bulk, "plane bulk modulus");
  require_positive(moduli.shear, "shear modulus");
  const double sum = moduli.bulk + moduli.shear;
  return {4.0 * moduli.bulk / sum * moduli.shear, (moduli.bulk - moduli.shear) / sum};
}

PlaneModuli plane_moduli(const PlaneConstants& constants) {
  require_positive(constants.young_modulus, "Young's modulus");
  require_poisson_ratio(constants.poisson_ratio, 1.0);
  return {0.5 * constants.young_modulus / (1.0 - constants.poisson_ratio),
          0.5 * constants.young_modulus / (1.0 + constants.poisson_ratio)};
}

PlaneConstants plane_strain_constants(double young_modulus, double poisson_ratio) {
  require_positive(young_modulus, "Young's modulus");
  require_poisson_ratio(poisson_ratio, 0.5);
  return {young_modulus / (1.0 - poisson_ratio * poisson_ratio), poisson_ratio / (1.0 - poisson_ratio)};
}

BulkWaveSpeeds bulk_wave_speeds(const PlaneModuli& moduli, double bulk_density) {
  require_positive(bulk_density, "bulk density");
  const PlaneConstants constants = plane_constants(moduli);
  return {std::sqrt(constants.young_modulus / bulk_density), std::sqrt(moduli.shear / bulk_density),
          std::sqrt((moduli.bulk + moduli.shear) / bulk_density)};
}

}  // namespace ddem::references
