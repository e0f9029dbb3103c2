#include "harness/measure/elastic_constants.h"

#include <cmath>
#include <stdexcept>

namespace ddem::harness {
namespace {

double relative_error(Uncertain speed) {
  if (!(speed.value > 0.0) || !std::isfinite(speed.value))
    throw std::invalid_argument("a wave speed must be positive and finite");
  if (!(speed.stddev >= 0.0) || !std::isfinite(speed.stddev))
    throw std::invalid_argument("a standard deviation must be finite and not negative");
  return speed.stddev / speed.value;
}

Uncertain density_times_square(double bulk_density, Uncertain speed) {
  if (!(bulk_density > 0.0) || !std::isfinite(bulk_density))
    throw std::invalid_argument("a bulk density must be positive and finite");
  const double modulus = bulk_density * speed.value * speed.value;
  return {modulus, 2.0 * modulus * relative_error(speed)};
}

}  // namespace

Uncertain young_modulus_from_bar(double bulk_density, Uncertain bar_speed) {
  return density_times_square(bulk_density, bar_speed);
}

Uncertain shear_modulus_from_shear(double bulk_density, Uncertain shear_speed) {
  return density_times_square(bulk_density, shear_speed);
}

Uncertain p_modulus_from_p(double bulk_density, Uncertain p_speed) { return density_times_square(bulk_density, p_speed); }

Uncertain poisson_ratio_from_bar_and_shear(Uncertain bar_speed, Uncertain shear_speed) {
  const double relative = std::hypot(relative_error(bar_speed), relative_error(shear_speed));
  const double ratio = bar_speed.value / shear_speed.value;
  const double nu = 0.5 * ratio * ratio - 1.0;
  return {nu, 2.0 * (1.0 + nu) * relative};
}

Uncertain poisson_ratio_from_p_and_shear(Uncertain p_speed, Uncertain shear_speed) {
  const double relative = std::hypot(relative_error(p_speed), relative_error(shear_speed));
  const double ratio = shear_speed.value / p_speed.value;
  const double nu = 1.0 - 2.0 * ratio * ratio;
  return {nu, 2.0 * (1.0 - nu) * relative};
}

}  // namespace ddem::harness
