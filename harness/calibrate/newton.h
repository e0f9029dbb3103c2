#pragma once
// A root of a monotonic function between two places, by Newton's method where it can be trusted and bisection
// where not.

#include <functional>

namespace ddem::harness {

struct ValueAndSlope {
  double value = 0.0, slope = 0.0;
};

struct BracketedRoot {
  double x = 0.0;
  double value = 0.0;  ///< of the function there: the verdict
};

/// f(low) and f(high), which have different signs (or are 0), are known and not evaluated again; f is
/// evaluated strictly between. Ends once |f| <= tolerance, or nothing lies between the bracket's ends.
/// Numerical Recipes' rtsafe, with an inverse linear first guess: quadratic near the root, and never slower
/// than bisection.
BracketedRoot bracketed_newton(const std::function<ValueAndSlope(double)>& f, BracketedRoot low,
                               BracketedRoot high, double tolerance);

}  // namespace ddem::harness
