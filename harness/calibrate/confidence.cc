#include "harness/calibrate/confidence.h"

#include <cmath>
#include <numbers>

namespace ddem::harness {
namespace {

/// P(|T| <= t), Abramowitz & Stegun 26.7.3 and 26.7.4: with theta = atan(t/sqrt(n)) a finite sum over cos^2
/// theta.
double central_probability(double t, int n) {
  const double theta = std::atan(t / std::sqrt(static_cast<double>(n)));
  const double c = std::cos(theta), s = std::sin(theta);
  double term = n % 2 == 1 ? c : 1.0, sum = n == 1 ? 0.0 : term;
  for (int k = n % 2 == 1 ? 3 : 2; k < n - 1; k += 2) {
    term *= c * c * static_cast<double>(k - 1) / static_cast<double>(k);
    sum += term;
  }
  return n % 2 == 1 ? 2.0 / std::numbers::pi * (theta + s * sum) : s * sum;
}

}  // namespace

double student_t(double confidence, int freedom) {
  double low = 0.0, high = 1.0;
  while (central_probability(high, freedom) < confidence) high *= 2.0;
  for (int n = 0; n < 200 && high - low > 1e-12 * high; ++n) {
    const double middle = 0.5 * (low + high);
    (central_probability(middle, freedom) < confidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

MeanWithConfidence mean_with_confidence(const std::vector<double>& values) {
  MeanWithConfidence m;
  m.count = static_cast<int>(values.size());
  for (const double v : values) m.mean += v / static_cast<double>(values.size());
  if (m.count < 2) return m;
  double squares = 0.0;
  for (const double v : values) squares += (v - m.mean) * (v - m.mean);
  m.stddev = std::sqrt(squares / static_cast<double>(m.count - 1));
  m.half_width = student_t(0.95, m.count - 1) * m.stddev / std::sqrt(static_cast<double>(m.count));
  return m;
}

}  // namespace ddem::harness
