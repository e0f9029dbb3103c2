#pragma once
// Least-squares quadratic through equidistant samples.

#include <span>

namespace ddem::harness {

/// constant + slope x + curvature x^2, x in samples from the middle of the fitted ones.
struct Quadratic {
  double constant = 0.0, slope = 0.0, curvature = 0.0;

  double vertex() const { return -0.5 * slope / curvature; }
  double at_vertex() const { return constant + 0.5 * slope * vertex(); }
};

/// At least three values (std::invalid_argument otherwise); through three of them it is exact.
Quadratic fit_quadratic(std::span<const double> values);

}  // namespace ddem::harness
