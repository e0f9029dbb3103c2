#pragma once
// The quiet part of a recording before its wave, and the recording without the offset and the trend of that part. For signals
// of which nothing is known beforehand: neither when the wave comes, nor how long it is, nor how high.

#include <optional>
#include <span>
#include <vector>

#include "harness/measure/outcome.h"
#include "harness/measure/picker.h"
#include "harness/measure/signal.h"

namespace ddem::harness {

/// Where a signal changes: the number of samples of its first part, such that a straight line with noise through those and other
/// noise in the rest fit best (Akaike's criterion, after Maeda 1985). Both parts have at least `least` samples; so many must be
/// there twice, or 0 comes back.
std::size_t change_point(std::span<const double> values, std::size_t least);

/// The first crest that is half as high as the highest: the wave, where echoes and ringing may be as high.
struct Crest {
  double sign = 1.0;
  std::size_t index = 0;  ///< of its top in the smoothed signal
  std::size_t last = 0;   ///< where the signal has fallen to three quarters of it, or its end
  double width = 0.0;     ///< at half its height, samples
  double height = 0.0;    ///< in the smoothed signal, positive
};

/// Of either sign, or of the given one. The signal is smoothed over a fifth of the highest crest. Empty where it is constant.
std::optional<Crest> first_crest(std::span<const double> values, std::optional<Polarity> polarity);

/// The highest crest of that sign within `reach` samples of a place, in the same smoothing; empty where there is none.
std::optional<Crest> crest_near(std::span<const double> values, double sign, double place, double reach, double width);

/// A recording without the line of its quiet part.
struct Levelled {
  std::vector<double> values;
  Crest crest;
  std::size_t quiet = 0;  ///< samples [0, quiet) come before the wave and all else
  double noise = 0.0;     ///< root mean square of what is left of them
  double offset = 0.0;    ///< removed: at the first sample
  double trend = 0.0;     ///< removed: a sample; 0 where the quiet part shows none
  /// How many independent pieces of noise of a length the quiet part holds, less what the line took of them.
  double independent(double length) const { return static_cast<double>(quiet) / length - (trend != 0.0 ? 2.0 : 1.0); }
};

/// Fails where the signal is not finite, constant, or has fewer than `kLeastQuiet` samples before its highest crest.
Outcome<Levelled> level(std::span<const double> values, std::optional<Polarity> polarity);
inline constexpr std::size_t kLeastQuiet = 32;

}  // namespace ddem::harness
