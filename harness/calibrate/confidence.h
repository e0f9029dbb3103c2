#pragma once
// Means over seeds with their confidence.

#include <vector>

namespace ddem::harness {

/// Two-sided quantile of Student's t distribution: P(|T| <= t) = `confidence`, `freedom` >= 1 degrees of
/// freedom. Right to 1e-10.
double student_t(double confidence, int freedom);

/// Mean and half-width of its 95 % confidence interval, t s/sqrt(n); no half-width for a single value
/// (negative there).
struct MeanWithConfidence {
  double mean = 0.0;
  double half_width = -1.0;
  double stddev = 0.0;  ///< of one value
  int count = 0;
};
MeanWithConfidence mean_with_confidence(const std::vector<double>& values);

}  // namespace ddem::harness
