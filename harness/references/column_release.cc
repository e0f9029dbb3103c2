#include "harness/references/column_release.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "harness/references/bessel.h"

namespace ddem::references {
namespace {

double root_of_ratio(double factor, double normal_stiffness, double mass) {
  if (!(normal_stiffness > 0.0 && mass > 0.0 && std::isfinite(normal_stiffness) && std::isfinite(mass)))
    throw std::invalid_argument("stiffness and mass must be positive and finite");
  return std::sqrt(factor * normal_stiffness / mass);
}

}  // namespace

std::vector<double> column_release(int columns, double tau) {
  if (columns < 1 || columns > 100'000'000)
    throw std::invalid_argument("a column release needs 1 to 1e8 columns");
  const std::vector<double> j = bessel_j(2 * columns, tau);
  std::vector<double> u(static_cast<std::size_t>(columns));
  for (std::size_t n = 0; n < u.size(); ++n) u[n] = j[2 * n] + j[2 * n + 2];
  return u;
}

double column_shear_rate(double normal_stiffness, double mass) {
  return root_of_ratio(2.0, normal_stiffness, mass);
}

double column_p_rate(double normal_stiffness, double mass) {
  return root_of_ratio(6.0, normal_stiffness, mass);
}

double chain_phase_speed(double wave_number_times_spacing) {
  if (!(wave_number_times_spacing >= 0.0 && wave_number_times_spacing <= std::numbers::pi))
    throw std::invalid_argument("wave number times spacing must lie in 0..pi");
  const double q = 0.5 * wave_number_times_spacing;
  return q == 0.0 ? 1.0 : std::sin(q) / q;
}

}  // namespace ddem::references
