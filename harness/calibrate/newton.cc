#include "harness/calibrate/newton.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace ddem::harness {

BracketedRoot bracketed_newton(const std::function<ValueAndSlope(double)>& f, BracketedRoot low,
                               BracketedRoot high, double tolerance) {
  if (std::abs(low.value) <= tolerance) return low;
  if (std::abs(high.value) <= tolerance) return high;
  if ((low.value < 0.0) == (high.value < 0.0))
    throw std::invalid_argument("a bracket needs values of different signs at its ends");
  constexpr int kMost = 200;
  double x = low.x + (high.x - low.x) * low.value / (low.value - high.value);
  double last_step = std::abs(high.x - low.x);
  BracketedRoot best = std::abs(low.value) < std::abs(high.value) ? low : high;
  for (int n = 0; n < kMost; ++n) {
    if (!(x > std::min(low.x, high.x) && x < std::max(low.x, high.x))) x = 0.5 * (low.x + high.x);
    if (x == low.x || x == high.x) return best;
    const ValueAndSlope at = f(x);
    if (std::abs(at.value) < std::abs(best.value)) best = {x, at.value};
    if (std::abs(at.value) <= tolerance) return best;
    ((at.value < 0.0) == (low.value < 0.0) ? low : high) = {x, at.value};
    const double step = at.value / at.slope;
    // Newton's step must shrink by half each time, or the bracket is cut in two.
    const bool trusted = std::isfinite(step) && std::abs(step) < 0.5 * last_step;
    const double next = trusted ? x - step : 0.5 * (low.x + high.x);
    last_step = std::abs(next - x);
    x = next;
  }
  return best;
}

}  // namespace ddem::harness
