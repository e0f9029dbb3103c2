#include "harness/references/bessel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ddem::references {

std::vector<double> bessel_j(int max_order, double x) {
  if (max_order < 0 || max_order > 1'000'000'000)
    throw std::invalid_argument("a Bessel function's order must lie in 0..1e9");
  if (!(x >= 0.0 && x <= 1e7)) throw std::invalid_argument("a Bessel function's argument must lie in 0..1e7");
  std::vector<double> j(static_cast<std::size_t>(max_order) + 1, 0.0);
  if (x < 1e-8) {  // the first term of the series, (x/2)^n/n!, to x^2/4; the recurrence would overflow
    double term = 1.0;
    for (std::size_t n = 0; n < j.size(); term *= 0.5 * x / static_cast<double>(++n)) j[n] = term;
    return j;
  }
  // Beyond the turning point n = x, J_n falls like exp(-(4 sqrt(2)/3) ((n - x)/x^(1/3))^(3/2)); 14 x^(1/3) +
  // 40 orders further on it is far below 1e-30 of its largest value.
  const double start = std::max(x, static_cast<double>(max_order)) + 14.0 * std::cbrt(x) + 40.0;
  double above = 0.0, here = 1e-300, sum = 0.0;  // J_{n+1}, J_n, and J_0 + 2 sum J_2k, up to a common factor
  for (int n = static_cast<int>(start); n >= 0; --n) {
    if (n <= max_order) j[static_cast<std::size_t>(n)] = here;
    if (n % 2 == 0) sum += (n == 0 ? 1.0 : 2.0) * here;
    const double below = 2.0 * n / x * here - above;
    above = here;
    here = below;
    if (std::abs(here) > 1e250) {  // rescale: orders far above a small x grow without limit
      constexpr double factor = 1e-250;
      above *= factor;
      here *= factor;
      sum *= factor;
      for (int m = n; m <= max_order; ++m) j[static_cast<std::size_t>(m)] *= factor;
    }
  }
  for (double& value : j) value /= sum;
  return j;
}

}  // namespace ddem::references
