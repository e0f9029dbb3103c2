#include "harness/measure/quadratic_fit.h"

#include <stdexcept>

namespace ddem::harness {

Quadratic fit_quadratic(std::span<const double> values) {
  if (values.size() < 3) throw std::invalid_argument("a quadratic fit needs at least three samples");
  // About the middle, 1, x and x^2 - <x^2> are orthogonal on equidistant samples, so the normal equations are
  // diagonal; x is scaled to [-1, 1] against overflow of x^4.
  const double half = 0.5 * static_cast<double>(values.size() - 1);
  const auto count = static_cast<double>(values.size());
  const auto x = [&](std::size_t n) { return (static_cast<double>(n) - half) / half; };
  double sum_x2 = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n) sum_x2 += x(n) * x(n);
  const double mean_x2 = sum_x2 / count;

  double mean = 0.0, sum_xy = 0.0, sum_qy = 0.0, sum_q2 = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double q = x(n) * x(n) - mean_x2;
    mean += values[n] / count;
    sum_xy += x(n) * values[n];
    sum_qy += q * values[n];
    sum_q2 += q * q;
  }
  const double curvature = sum_qy / sum_q2;
  return {mean - curvature * mean_x2, sum_xy / sum_x2 / half, curvature / (half * half)};
}

}  // namespace ddem::harness
