#include "harness/references/dalembert.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ddem::references {
namespace {

void require_valid(const Strip& strip, double x, double t) {
  if (!(strip.length > 0.0 && strip.speed > 0.0) || !std::isfinite(strip.length) ||
      !std::isfinite(strip.speed))
    throw std::invalid_argument("a strip needs a positive, finite length and wave speed");
  if (!(x >= 0.0 && x <= strip.length)) throw std::invalid_argument("the point lies outside the strip");
  // Beyond a million passages the reflections' round-off, and the work of summing them, would be all there
  // is.
  if (!(std::abs(t) * strip.speed / strip.length <= 1e6))
    throw std::invalid_argument("the time must be finite and at most a million passages of the strip");
}

double sign_of(End end) {
  return end == End::free ? 1.0 : -1.0;
}

/// f(-x) = l f(x) and f(L + y) = r f(L - y), hence f(x + 2L) = l r f(x).
double continued(const Strip& strip, const std::function<double(double)>& profile, double x) {
  const double period = 2.0 * strip.length;
  const double turns = std::floor(x / period);
  const double both = sign_of(strip.left) * sign_of(strip.right);
  double sign = std::fmod(turns, 2.0) == 0.0 ? 1.0 : both;
  double folded = std::clamp(x - turns * period, 0.0, period);
  if (folded > strip.length) {
    folded = period - folded;
    sign *= sign_of(strip.right);
  }
  return sign * profile(folded);
}

}  // namespace

double released_strip(const Strip& strip, const std::function<double(double)>& profile, double x, double t) {
  require_valid(strip, x, t);
  return 0.5 *
         (continued(strip, profile, x - strip.speed * t) + continued(strip, profile, x + strip.speed * t));
}

double driven_strip(const Strip& strip, const std::function<double(double)>& motion, double x, double t) {
  require_valid(strip, x, t);
  const double r = sign_of(strip.right);
  const auto g = [&](double path) {
    const double retarded = t - path / strip.speed;
    return retarded > 0.0 ? motion(retarded) : 0.0;
  };
  double sum = 0.0, sign = 1.0;
  for (double path = 0.0; path <= strip.speed * t; path += 2.0 * strip.length) {
    sum += sign * (g(path + x) + r * g(path + 2.0 * strip.length - x));
    sign *= -r;
  }
  return sum;
}

double cosine_profile(double s, double width) {
  return s >= 0.0 && s < width ? 0.5 * (1.0 + std::cos(std::numbers::pi * s / width)) : 0.0;
}

double gaussian_profile(double s, double center, double width) {
  const double z = (s - center) / width;
  return std::exp(-0.5 * z * z);
}

double sin2_motion(double t, double duration) {
  if (t < 0.0 || t > duration) return 0.0;
  const double sine = std::sin(std::numbers::pi * t / duration);
  return sine * sine;
}

}  // namespace ddem::references
