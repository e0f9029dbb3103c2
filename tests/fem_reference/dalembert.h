#pragma once
// Plane waves in the strip, exactly: d'Alembert's solution with reflections at the two ends.

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "tests/fem_reference/program.h"

namespace ddem::fem::test {

/// u(x, t) of a pulse f(x) released from rest in 0 <= x <= length; the left end is free, the right end free
/// (`right_sign` = 1: the mirror image has the same sign) or fixed (-1).
struct ReleasedPulse {
  std::function<double(double)> f;
  double length = 0.0;
  int right_sign = 1;

  double mirrored(double s) const {
    int sign = 1;
    while (s < 0.0 || s > length) {
      if (s < 0.0) {
        s = -s;
      } else {
        s = 2.0 * length - s;
        sign *= right_sign;
      }
    }
    return sign * f(s);
  }

  double operator()(double x, double t, double speed) const {
    return 0.5 * (mirrored(x - speed * t) + mirrored(x + speed * t));
  }
};

struct Difference {
  double relative_l2 = 0.0;  ///< over all receivers and samples
  double speed = 0.0;        ///< relative error of the wave speed that explains the signals best
};

/// One component of the points of `signals`, at `x`, against `exact(x, t, speed)`.
template <typename Exact>
Difference compare(const Signals& signals, const std::vector<double>& x, int component, const Exact& exact,
                   double speed) {
  const double h = 1e-4;
  double residual2 = 0.0, exact2 = 0.0, slope_residual = 0.0, slope2 = 0.0;
  for (std::size_t sample = 0; sample < signals.time.size(); ++sample) {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double t = signals.time[sample], expected = exact(x[k], t, speed);
      const double residual = signals.point(sample, k, component) - expected;
      const double slope =
          (exact(x[k], t, speed * (1.0 + h)) - exact(x[k], t, speed * (1.0 - h))) / (2.0 * h);
      residual2 += residual * residual;
      exact2 += expected * expected;
      slope_residual += slope * residual;
      slope2 += slope * slope;
    }
  }
  return {std::sqrt(residual2 / exact2), slope_residual / slope2};  // least squares: a Gauss-Newton step
}

}  // namespace ddem::fem::test
