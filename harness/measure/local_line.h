#pragma once
// Least-squares lines through a few samples: values, slopes and tops of noisy signals, without delay.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ddem::harness {

struct LocalLine {
  double value = 0.0;  ///< in the middle
  double slope = 0.0;  ///< a sample
};

/// The least-squares line through the 2 half + 1 samples around `middle`; beyond its ends a signal keeps its last value.
/// `half` is at least 1.
LocalLine local_line(std::span<const double> values, std::ptrdiff_t middle, std::ptrdiff_t half);

/// The weights of its value and of its slope: [k] belongs to sample middle - half + k.
std::vector<double> value_weights(std::ptrdiff_t half);
std::vector<double> slope_weights(std::ptrdiff_t half);

/// Averaged twice over 2 half + 1 samples: symmetric, hence without delay; the same signal for half = 0.
std::vector<double> smoothed(std::span<const double> values, std::size_t half);

/// Where the slope of the local lines passes from rise to fall, nearest to `start` and at most `reach` samples from it: in
/// samples, between them by a straight line. It is a linear function of small noise, with the spread that projected_noise()
/// gives for slope_weights() over the curvature. Empty where there is no such place.
struct Top {
  double index = 0.0;
  double curvature = 0.0;  ///< of the slope, a sample squared; negative
};
std::optional<Top> smooth_top(std::span<const double> values, double start, double reach, std::ptrdiff_t half);

/// Where the tangent at the steepest place of the rise before `top`, at most `reach` samples before it, meets zero. There the
/// tangent's foot t - s/s' is the latest of all (its derivative is s s''/s'^2), so that the choice of the place hardly matters.
struct Foot {
  double index = 0.0;               ///< of the foot, in samples
  double value = 0.0, slope = 0.0;  ///< of the tangent at the steepest place
};
std::optional<Foot> tangent_foot(std::span<const double> values, double top, double reach, std::ptrdiff_t half);

}  // namespace ddem::harness
