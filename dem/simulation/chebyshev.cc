#include "dem/simulation/chebyshev.h"

#include <cmath>
#include <stdexcept>

namespace ddem {

std::vector<ChebyshevWeights> chebyshev_weights(double rho, double tolerance) {
  if (!(rho >= 0.0) || !std::isfinite(rho)) throw std::invalid_argument("the spectral radius of the particle strains is not finite");
  if (!(tolerance > 0.0 && tolerance < 0.5)) throw std::invalid_argument("the tolerance of the particle strains must be between 0 and 0.5");
  if (rho == 0.0) return {{1.0, 0.0, 0.0}};
  const double middle = 1.0 + 0.5 * rho, half = 0.5 * rho, sigma = middle / half;
  std::vector<ChebyshevWeights> weights = {{1.0 / middle, 0.0, 0.0}};
  // T_m(sigma) by its recurrence.
  double chebyshev_before = 1.0, chebyshev = sigma, ratio = 1.0 / sigma;
  while (rho / chebyshev > tolerance) {
    const double next_ratio = 1.0 / (2.0 * sigma - ratio);
    weights.push_back({0.0, next_ratio * ratio, 2.0 * next_ratio / half});
    ratio = next_ratio;
    const double next = 2.0 * sigma * chebyshev - chebyshev_before;
    chebyshev_before = chebyshev;
    chebyshev = next;
  }
  return weights;
}

}  // namespace ddem
