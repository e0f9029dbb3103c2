#include "dem/spectra/spectra.h"

#include <cmath>
#include <functional>
#include <stdexcept>

#include "dem/spectra/extreme_eigenvalues.h"
#include "dem/spectra/rigid_stiffness.h"
#include "dem/spectra/scheme_stiffness.h"
#include "dem/spectra/step_map.h"
#include "dem/spectra/strain_polynomial.h"
#include "dem/spectra/strain_spectrum.h"

namespace ddem {
namespace {

constexpr double kSoftnessAccuracy = 1e-3;
constexpr std::size_t kMostUnknowns = 700;  // of a step whose eigenvalues are sought ten times: 10 s

/// Root of the largest eigenvalue of M^-1 times that stiffness.
double largest_frequency_of(const Operators& op, const SchemeStiffness& stiffness, const HeldDofs& held, const char* what) {
  const Eigen::VectorXd s = mass_scaling(op, held);
  const LinearOperator scaled{s.size(), [&](LinearOperator::In x, LinearOperator::Out y) { y = s.cwiseProduct(stiffness.apply(s.cwiseProduct(x))); }};
  return std::sqrt(op.symmetric ? largest_eigenvalue(scaled, what) : largest_magnitude(scaled, what));
}

/// r = 1 - w - w b is negative for the largest b: an even number of evaluations then ends beyond the converged strain.
bool feeds(const DeformationParameters& d, double radius) {
  return d.evaluations % 2 == 0 && radius > (1.0 - d.relaxation) / d.relaxation;
}

}  // namespace

double largest_frequency(const Assembly& a, const ContactParameters& contact, const HeldDofs& held) {
  RigidStiffness stiffness(a, contact, held);
  return std::sqrt(largest_eigenvalue({stiffness.size(), [&](LinearOperator::In x, LinearOperator::Out y) { stiffness.apply(x, y); }}, "critical time step"));
}

double largest_converged_frequency(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation,
                                   const HeldDofs& held) {
  const Operators op = make_operators(a, contact, deformation);
  return largest_frequency_of(op, SchemeStiffness::converged(op), held, "critical time step with converged strains");
}

double largest_implicit_frequency(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation,
                                  const HeldDofs& held) {
  if (deformation.solver != StrainSolver::polynomial) return largest_converged_frequency(a, contact, deformation, held);
  const Operators op = make_operators(a, contact, deformation);
  const auto relaxations = strain_relaxations(a, contact, deformation);
  return largest_frequency_of(op, SchemeStiffness::polynomial(op, relaxations), held, "critical time step with implicit strains");
}

double fixed_point_radius(const Assembly& a, const ContactParameters& contact,
                          const DeformationParameters& deformation) {
  return spectral_radius(StrainIteration(make_operators(a, contact, deformation)));
}

double flip_limit_step(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation,
                       const HeldDofs& held) {
  const Operators op = make_operators(a, contact, deformation);
  return 2.0 / largest_frequency_of(op, SchemeStiffness::flip(op, deformation, spectral_radius(StrainIteration(op))), held, "flip limit");
}

CriticalStep critical_step(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation,
                           const HeldDofs& held) {
  if (!deformation.active()) return {StepBound::oscillation, 2.0 / largest_frequency(a, contact, held)};
  if (deformation.scheme != Scheme::lagged) {
    return {StepBound::oscillation, 2.0 / largest_implicit_frequency(a, contact, deformation, held)};
  }
  const double radius = fixed_point_radius(a, contact, deformation);
  if (radius >= 2.0 / deformation.relaxation - 1.0) return {StepBound::fixed_point, std::nullopt};
  if (feeds(deformation, radius)) return {StepBound::feeding, std::nullopt};
  return {StepBound::flip, flip_limit_step(a, contact, deformation, held)};
}

namespace {

/// Between a factor that is stable and one that is not, as far as that is asked.
double largest_stable(const std::function<bool(double)>& stable, double low, double high) {
  while (high - low > kSoftnessAccuracy * high) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

DeformationParameters softened(DeformationParameters d, double factor) {
  d.young_modulus /= factor;
  return d;
}

}  // namespace

std::optional<SoftnessFactor> stable_softness_factor(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation,
                                                     const HeldDofs& held, double dt) {
  if (deformation.scheme != Scheme::lagged) throw std::invalid_argument("only the lagged scheme limits the softness of the discs");
  const double w = deformation.relaxation, radius = fixed_point_radius(a, contact, deformation);
  const bool even = deformation.evaluations % 2 == 0;
  const double converges = (2.0 / w - 1.0) / radius, damps = even ? (1.0 - w) / w / radius : converges;
  const auto flips_not = [&](double factor) { return dt <= flip_limit_step(a, contact, softened(deformation, factor), held); };
  const auto below = [](double limit) { return limit * (1.0 - kSoftnessAccuracy); };
  if (!(damps > 0.0) || !flips_not(kSoftnessAccuracy * damps)) return std::nullopt;
  if (!flips_not(below(damps))) {
    const double flip = largest_stable(flips_not, kSoftnessAccuracy * damps, below(damps));
    return SoftnessFactor{flip, flip};
  }
  if (!even) return SoftnessFactor{damps, damps};
  const double flip = flips_not(below(converges)) ? converges : largest_stable(flips_not, below(damps), below(converges));
  const bool energy = make_operators(a, contact, deformation).symmetric;
  if (!energy || step_unknowns(a, contact, deformation) > kMostUnknowns) return SoftnessFactor{damps, flip};
  const auto grows_not = [&](double factor) { return step_growth(a, contact, softened(deformation, factor), held, dt) <= kGrowthRoundOff; };
  const double sharp = largest_stable(grows_not, below(damps), flip);
  return SoftnessFactor{sharp, sharp};
}

}  // namespace ddem
