#pragma once
// Arrival time of a pulse, below the sampling step: by its peak or by its centroid.

#include <optional>

#include "harness/measure/outcome.h"
#include "harness/measure/signal.h"

namespace ddem::harness {

enum class Polarity { positive, negative };

struct PickOptions {
  Polarity polarity = Polarity::positive;  ///< sign of the pulse
  double top_fraction = 0.06;              ///< the fit covers samples within this fraction of the peak

  /// Where nothing has arrived yet: its root mean square is the noise that the peak must exceed
  /// `signal_to_noise` times. Left out: all before the window.
  std::optional<Window> quiet = std::nullopt;
  double signal_to_noise = 6.0;
  /// Noise that is known from elsewhere (root mean square): the level is at least that. It stands in for quiet samples
  /// where there are too few of them.
  std::optional<double> noise = std::nullopt;
  /// Whether the signal lies still before its pulse: then all that is there must be as low as noise, or the pulse is not
  /// the first. Not so for a correlation.
  bool still_before = true;

  /// Magnitude of the pulse where it is known (same unit as the signal): a peak below
  /// `detection_fraction` of it is refused.
  std::optional<double> expected_amplitude = std::nullopt;
  double detection_fraction = 0.1;

  /// A second peak of at least `rival_fraction` of the first, separated from it by a valley below
  /// `valley_fraction` of the first, makes the pick ambiguous.
  double rival_fraction = 0.95;
  double valley_fraction = 0.75;
};

struct Arrival {
  double time = 0.0;       ///< s
  double amplitude = 0.0;  ///< fitted extremum, with its sign, unit of the signal
  double width = 0.0;      ///< of the pulse at half its height, s
};

using Pick = Outcome<Arrival>;

/// The largest extremum of the expected sign inside a causal window, which must stand `signal_to_noise` times above the
/// root mean square of the quiet samples and of all that comes before the pulse, refined by a least-squares quadratic
/// over the samples of the top 6 % of the pulse (at least three samples, otherwise the parabola through the
/// neighbours). Everything that makes the result doubtful is a failed pick; wrong use (dt <= 0, window not
/// finite, fractions outside (0, 1)) throws std::invalid_argument.
/// The parabola's vertex is off by at most 0.007 of half a step on a pulse that is symmetric about its peak.
Pick pick_peak(const Signal& signal, const Window& window, const PickOptions& options = {});

/// The centroid of the pulse over [t_peak - half_width, t_peak + half_width], t_peak the measured peak: a
/// window placed by expectation instead would pull the centroid towards itself. The interval must lie inside
/// the signal. `amplitude` is that of the peak.
Pick pick_centroid(const Signal& signal, const Window& window, double half_width,
                   const PickOptions& options = {});

/// The same about a time that was found otherwise: s. Fails where the interval reaches beyond the signal, and where the signal in
/// it is not of one sign.
Outcome<double> centroid_around(const Signal& signal, double time, double half_width, Polarity polarity);

}  // namespace ddem::harness
