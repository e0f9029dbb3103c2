#include "harness/measure/noise_spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace ddem::harness {

double projected_noise(std::span<const double> noise, std::span<const double> weights) {
  if (noise.empty() || weights.empty()) return 0.0;
  // Places nearer to each other than this say the same.
  const std::size_t stride = std::max<std::size_t>(1, weights.size() / 16);
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < noise.size(); n += stride, ++count) {
    double sum = 0.0;
    for (std::size_t k = 0, m = n; k < weights.size(); ++k) {
      sum += weights[k] * noise[m];
      if (++m == noise.size()) m = 0;
    }
    squares += sum * sum;
  }
  return std::sqrt(squares / static_cast<double>(count));
}

double correlation_length(std::span<const double> noise) {
  double squares = 0.0, length = 1.0;
  for (const double v : noise) squares += v * v;
  for (std::size_t lag = 1; lag < noise.size() && squares > 0.0; ++lag) {
    double sum = 0.0;
    for (std::size_t n = lag; n < noise.size(); ++n) sum += noise[n] * noise[n - lag];
    if (!(sum > 0.0)) break;
    length += 2.0 * sum / squares;
  }
  return length;
}

double student_widening(double independent) {
  // 97.5 % quantiles for 1 to 10 degrees of freedom; beyond, t = z + (z^3 + z)/(4 dof), z = 1.96.
  constexpr std::array quantiles = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
  constexpr double normal = 1.96;
  const double dof = std::max(1.0, std::floor(independent));
  if (dof <= static_cast<double>(quantiles.size())) return quantiles[static_cast<std::size_t>(dof) - 1] / normal;
  return 1.0 + (normal * normal + 1.0) / (4.0 * dof);
}

double student_threshold(double independent) {
  // 99.9 % quantiles for 1 to 10 degrees of freedom.
  constexpr std::array quantiles = {318.31, 22.327, 10.215, 7.173, 5.893, 5.208, 4.785, 4.501, 4.297, 4.144};
  if (independent < 1.0) return std::numeric_limits<double>::infinity();
  const auto dof = static_cast<std::size_t>(std::min(independent, static_cast<double>(quantiles.size())));
  return quantiles[dof - 1];
}

}  // namespace ddem::harness
