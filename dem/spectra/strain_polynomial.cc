#include "dem/spectra/strain_polynomial.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "dem/spectra/gauss_quadrature.h"

namespace ddem {
namespace {

constexpr int kHighestDegree = 2000;
/// Fewer than the nodes of the measured shares, which then judge them.
constexpr int kMostLongWaveTerms = 10;
/// Lanczos finds the radius to 1e-3 or better; beyond the interval the iteration would grow.
constexpr double kRadiusMargin = 1.0 + 1e-3;

/// The Chebyshev polynomial of degree n with its first and last zeros at 0 and rho.
struct StretchedChebyshev {
  int n;
  double rho;

  double outermost() const { return std::cos(std::numbers::pi / (2.0 * n)); }
  /// The k-th zero, k = 1 .. n.
  double zero(int k) const {
    return 0.5 * rho * (1.0 - std::cos((2.0 * k - 1.0) * std::numbers::pi / (2.0 * n)) / outermost());
  }
  /// Its largest value between them over its value at -1: how large t r(t) is. Not a number as long as -1 is no further out
  /// than the extrema.
  double bound() const { return 1.0 / std::cosh(n * std::acosh(outermost() * (1.0 + 2.0 / rho))); }
};

/// For all motions alike.
std::vector<double> uniform_zeros(double rho, double tolerance) {
  int terms = 2;
  while (!(StretchedChebyshev{terms + 1, rho}.bound() <= tolerance)) {
    if (++terms > kHighestDegree) {
      throw std::invalid_argument("the implicit strains of discs so soft take more than 2000 iterations a step; use solver = \"conjugate_gradients\", stiffer discs, or a larger tolerance");
    }
  }
  const StretchedChebyshev q{terms + 1, rho};
  std::vector<double> zeros;
  for (int k = 2; k <= q.n; ++k) zeros.push_back(q.zero(k));
  return zeros;
}

double residual(const std::vector<double>& zeros, double t) {
  double r = 1.0;
  for (const double z : zeros) r *= (z - t) / (1.0 + z);
  return r;
}

/// Bound of the relative error of the moduli.
double error_of_moduli(const std::vector<double>& zeros, const StrainSpectrum& s) {
  double worst = 0.0;
  for (const ModeShares& load : s.uniform) {
    double error = 0.0;
    for (std::size_t k = 0; k < load.share.size(); ++k) {
      error += load.share[k] * std::abs(residual(zeros, load.eigenvalue[k])) / (1.0 + load.eigenvalue[k]);
    }
    worst = std::max(worst, error);
  }
  return worst;
}

double error_of_any_motion(const std::vector<double>& zeros, double rho) {
  constexpr int samples = 1000;
  double worst = 0.0;
  for (int k = 1; k <= samples; ++k) {
    const double t = rho * k / samples;
    worst = std::max(worst, std::abs(t * residual(zeros, t)));
  }
  return worst;
}

/// None with fewer than `most` terms.
std::optional<std::vector<double>> long_wave_zeros(const StrainSpectrum& s, double rho, double tolerance, std::size_t most) {
  std::vector<double> nodes, roots;
  for (const ModeShares& load : s.uniform) {
    for (std::size_t k = 0; k < load.share.size(); ++k) {
      nodes.push_back(load.eigenvalue[k]);
      roots.push_back(std::sqrt(load.share[k]));
    }
  }
  const Eigen::Map<const Eigen::VectorXd> at(nodes.data(), static_cast<Eigen::Index>(nodes.size())),
      start(roots.data(), static_cast<Eigen::Index>(roots.size()));
  const double any = std::min(kShortWaveAllowance * tolerance, kLargestShortWaveError);
  for (int terms = 2; terms <= kMostLongWaveTerms && static_cast<std::size_t>(terms) < most; ++terms) {
    const Eigen::VectorXd z = gauss_quadrature([&at](const Eigen::VectorXd& x) { return at.cwiseProduct(x); }, start, terms).nodes;
    std::vector<double> zeros(z.begin(), z.end());
    if (error_of_moduli(zeros, s) <= tolerance && error_of_any_motion(zeros, rho) <= any) return zeros;
  }
  return std::nullopt;
}

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

std::vector<double> strain_relaxations(const StrainSpectrum& s, double tolerance) {
  if (!(s.radius >= 0.0) || !std::isfinite(s.radius)) throw std::invalid_argument("the spectral radius of the particle strains is not finite");
  if (!(tolerance > 0.0 && tolerance < 0.5)) throw std::invalid_argument("the tolerance of the particle strains must be between 0 and 0.5");
  if (s.radius == 0.0) return {1.0, 1.0};
  const double rho = s.radius * kRadiusMargin;
  std::vector<double> zeros = uniform_zeros(rho, tolerance);
  if (auto fewer = long_wave_zeros(s, rho, tolerance, zeros.size())) zeros = std::move(*fewer);
  zeros = leja_order(std::move(zeros));
  for (double& t : zeros) t = 1.0 / (1.0 + t);
  return zeros;
}

std::vector<double> strain_relaxations(const Assembly& a, const ContactParameters& contact,
                                       const DeformationParameters& deformation) {
  return strain_relaxations(strain_spectrum(a, contact, deformation), deformation.tolerance);
}

}  // namespace ddem
