#include "fem_reference/kernel/gauss_lobatto.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ddem::fem {
namespace {

struct Legendre {
  double value, slope, curvature;  ///< P_n, P_n', P_n'' at a point inside (-1, 1)
};

// Three-term recurrence (n P_n = (2n-1) z P_{n-1} - (n-1) P_{n-2}), then P' and P'' from the definition
// of P and from Legendre's differential equation.
Legendre legendre(int n, double z) {
  double before = 1.0, value = z;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * z * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  if (n == 0) return {1.0, 0.0, 0.0};
  const double slope = n * (before - z * value) / (1.0 - z * z);
  return {value, slope, (2.0 * z * slope - n * (n + 1) * value) / (1.0 - z * z)};
}

// Interior points: roots of P_n', Newton from the Chebyshev-Lobatto points, which lie close enough.
double lobatto_point(int n, int k) {
  if (k == 0) return -1.0;
  if (k == n) return 1.0;
  if (2 * k == n) return 0.0;
  double z = -std::cos(std::numbers::pi * k / n);
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Legendre p = legendre(n, z);
    const double step = p.slope / p.curvature;
    z -= step;
    if (std::abs(step) < 1e-16) break;
  }
  return z;
}

double legendre_value(int n, double z) {
  if (z == 1.0) return 1.0;
  if (z == -1.0) return n % 2 == 0 ? 1.0 : -1.0;
  return legendre(n, z).value;
}

}  // namespace

GaussLobatto gauss_lobatto(int degree) {
  if (degree < 1 || degree > max_degree) {
    throw std::invalid_argument("degree " + std::to_string(degree) + " is not between 1 and " +
                                std::to_string(max_degree));
  }
  const int n = degree, count = degree + 1;
  std::vector<double> z(count);
  for (int k = 0; k <= n / 2; ++k) {  // mirrored, so that the rule is symmetric to the last bit
    z[k] = lobatto_point(n, k);
    z[n - k] = -z[k];
  }
  GaussLobatto rule;
  for (int k = 0; k < count; ++k) {
    const double p = legendre_value(n, z[k]);
    rule.points.push_back(0.5 * (1.0 + z[k]));
    rule.weights.push_back(1.0 / (n * (n + 1) * p * p));
  }
  rule.derivative.assign(count * count, 0.0);
  for (int q = 0; q < count; ++q) {
    double row_sum = 0.0;
    for (int k = 0; k < count; ++k) {
      if (k == q) continue;
      const double slope =
          2.0 * legendre_value(n, z[q]) / (legendre_value(n, z[k]) * (z[q] - z[k]));  // d/dx = 2 d/dz
      rule.derivative[q * count + k] = slope;
      row_sum += slope;
    }
    rule.derivative[q * count + q] = -row_sum;  // a constant has slope 0, to round-off
  }
  return rule;
}

std::vector<double> lagrange_values(const std::vector<double>& points, double x) {
  std::vector<double> values(points.size(), 1.0);
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t m = 0; m < points.size(); ++m) {
      if (m != k) values[k] *= (x - points[m]) / (points[k] - points[m]);
    }
  }
  return values;
}

}  // namespace ddem::fem
