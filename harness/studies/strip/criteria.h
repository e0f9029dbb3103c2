#pragma once
// Criteria of a verdict: a measured value against its bounds.

#include <optional>
#include <string>

#include "harness/studies/strip/strip_results.h"
#include "reports/verdict.h"

namespace ddem::harness {

struct Bounds {
  double target = 0.0, lower = 0.0, upper = 0.0;
};

inline Bounds relative(double target, double below, double above) {
  return {target, target * (1.0 - below), target * (1.0 + above)};
}
inline Bounds absolute(double target, double tolerance) {
  return {target, target - tolerance, target + tolerance};
}

/// "WHAT, DDEM F, k_t/k_n = 0.3" and "KIND/lagged-full/kt0.30".
std::string title_of(const StripMaterial& material, const std::string& what);
std::string case_id(const std::string& kind, const StripMaterial& material);

/// Tolerances are for means of six packings; of fewer, the mean scatters more.
double widened(double tolerance, std::size_t seeds);

/// Pass within the bounds, fail outside, error where nothing finite was measured.
reports::Criterion judge(const std::string& metric, std::optional<double> actual, const Bounds& bounds,
                         const std::string& unit, const std::string& derivation);

/// The case fails if a criterion does; an error (nothing measured) is worse than a failure.
void conclude(reports::Verdict& verdict);

/// The same of what has a reason: it has measured nothing.
void conclude_study(reports::Verdict& verdict);

}  // namespace ddem::harness
