#include "dem/simulation/strain_polynomial.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ddem {
namespace {

constexpr int kMostTerms = 2000;

/// The Chebyshev polynomial of degree n with its first and last zeros at 0 and rho.
struct StretchedChebyshev {
  int n;
  double rho;

  double outermost() const { return std::cos(std::numbers::pi / (2.0 * n)); }
  /// The k-th zero, k = 1 .. n.
  double zero(int k) const {
    return 0.5 * rho * (1.0 - std::cos((2.0 * k - 1.0) * std::numbers::pi / (2.0 * n)) / outermost());
  }
  /// Its largest value between them over its value at -1: how large q is. Not a number as long as -1 is no further out
  /// than the extrema.
  double bound() const { return 1.0 / std::cosh(n * std::acosh(outermost() * (1.0 + 2.0 / rho))); }
};

/// Each next zero is the one furthest from all before, in the product of the distances.
std::vector<double> leja_order(std::vector<double> zeros) {
  std::sort(zeros.begin(), zeros.end(), std::greater<>());
  std::vector<double> log_distance(zeros.size(), 0.0);
  for (std::size_t k = 1; k < zeros.size(); ++k) {
    std::size_t best = k;
    for (std::size_t j = k; j < zeros.size(); ++j) {
      log_distance[j] += std::log(std::abs(zeros[j] - zeros[k - 1]));
      if (log_distance[j] > log_distance[best]) best = j;
    }
    std::swap(zeros[k], zeros[best]);
    std::swap(log_distance[k], log_distance[best]);
  }
  return zeros;
}

}  // namespace

std::vector<double> strain_relaxations(double rho, double tolerance) {
  if (!(rho >= 0.0) || !std::isfinite(rho)) throw std::invalid_argument("the spectral radius of the particle strains is not finite");
  if (!(tolerance > 0.0 && tolerance < 0.5)) throw std::invalid_argument("the tolerance of the particle strains must be between 0 and 0.5");
  if (rho == 0.0) return {1.0};
  int terms = 1;
  while (!(StretchedChebyshev{terms + 1, rho}.bound() <= tolerance)) {
    if (++terms > kMostTerms) {
      throw std::invalid_argument("the implicit strains of discs so soft take more than 2000 iterations a step; use solver = \"conjugate_gradients\", stiffer discs, or a larger tolerance");
    }
  }
  const StretchedChebyshev q{terms + 1, rho};
  std::vector<double> zeros;
  for (int k = 2; k <= q.n; ++k) zeros.push_back(q.zero(k));
  zeros = leja_order(std::move(zeros));
  for (double& t : zeros) t = 1.0 / (1.0 + t);
  return zeros;
}

}  // namespace ddem
