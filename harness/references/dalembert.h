#pragma once
// The wave equation on a strip 0 <= x <= length, exactly (d'Alembert, ends by images).

#include <functional>

namespace ddem::references {

enum class End { free, fixed };

struct Strip {
  double length = 0.0;  ///< m
  double speed = 0.0;   ///< of the wave, m/s
  End left = End::free;
  End right = End::fixed;
};

/// Displacement at (x, t), t of either sign, released at rest from u(x, 0) = profile(x), which is called for
/// 0 <= x <= length only: u = (f(x - ct) + f(x + ct))/2, f the continuation of the profile: even about a free
/// end, odd about a fixed one. Throws std::invalid_argument unless 0 <= x <= length, length and speed are
/// positive and |t| is at most a million passages of the strip.
double released_strip(const Strip& strip, const std::function<double(double)>& profile, double x, double t);

/// Displacement at (x, t) of a strip at rest whose left end moves as u(0, t) = motion(t), motion(t <= 0) = 0,
/// called for t > 0 only (strip.left is not used: a prescribed end reflects like a fixed one): u = sum_m
/// (-r)^m [g(t - (2mL + x)/c) + r g(t - (2(m+1)L - x)/c)], r = 1 at a free right end, -1 at a fixed one.
double driven_strip(const Strip& strip, const std::function<double(double)>& motion, double x, double t);

// Profiles of unit amplitude.

/// (1 + cos(pi s/width))/2 for 0 <= s < width, 0 beyond.
double cosine_profile(double s, double width);
/// exp(-(s - center)^2/(2 width^2)).
double gaussian_profile(double s, double center, double width);
/// sin^2(pi t/duration) for 0 <= t <= duration, 0 otherwise.
double sin2_motion(double t, double duration);

}  // namespace ddem::references
