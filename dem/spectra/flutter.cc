#include "dem/spectra/flutter.h"

#include <cmath>

#include "dem/spectra/extreme_eigenvalues.h"
#include "dem/spectra/scheme_stiffness.h"
#include "dem/spectra/spectra.h"

namespace ddem {
namespace {

constexpr int kSteps = 3000;
constexpr double kStepFraction = 0.8;  // of 2/omega_max
// Of the propagation's eigenvalues cos(3000 phi): within [-1, 1] for real phi.
constexpr double kOutside = 1.05;

/// 3000 steps of leapfrog from rest, for the eigenvector's displacements scaled by the root of the masses.
Eigen::VectorXd propagate(const LinearOperator& a, double dt, const Eigen::VectorXd& start) {
  Eigen::VectorXd before = start, now = start - 0.5 * dt * dt * (a * start);
  for (int k = 1; k < kSteps; ++k) {
    Eigen::VectorXd next = 2.0 * now - before - dt * dt * (a * now);
    before = std::move(now);
    now = std::move(next);
  }
  return now;
}

/// The root of the Rayleigh quotient v^H A v / v^H v, with a positive imaginary part.
std::complex<double> frequency_of(const LinearOperator& a, const Eigen::VectorXcd& v) {
  Eigen::VectorXcd av(v.size());
  av.real() = a * v.real();
  av.imag() = a * v.imag();
  const std::complex<double> omega = std::sqrt(v.dot(av) / v.squaredNorm());
  return {omega.real(), std::abs(omega.imag())};
}

}  // namespace

FlutterSearch find_flutter(const Assembly& assembly, const ContactParameters& contact,
                           const DeformationParameters& deformation, const HeldDofs& held) {
  const Operators op = make_operators(assembly, contact, deformation);
  FlutterSearch search;
  search.largest_frequency = largest_converged_frequency(assembly, contact, deformation, held);
  if (op.symmetric) return search;
  const double dt = kStepFraction * 2.0 / search.largest_frequency;
  // Near the middle of the spectrum phi = omega dt, and cosh(3000 Im(phi)) = 1.05 where a crest of the cosine is real.
  search.detectable = std::acosh(kOutside) / (kSteps * dt * search.largest_frequency);

  const Eigen::VectorXd s = mass_scaling(op, held);
  const SchemeStiffness stiffness = SchemeStiffness::converged(op);
  const LinearOperator a{s.size(), [&](LinearOperator::In x, LinearOperator::Out y) { y = s.cwiseProduct(stiffness.apply(s.cwiseProduct(x))); }};
  const LinearOperator steps{s.size(), [&](LinearOperator::In x, LinearOperator::Out y) { y = propagate(a, dt, x); }};
  if (const auto pair = outstanding_eigenvector(steps, kOutside)) search.frequency = frequency_of(a, pair->vector);
  return search;
}

}  // namespace ddem
