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
  /// `signal_to_noise` times. Left out, and without an expected amplitude: all before the window.
  std::optional<Window> quiet = std::nullopt;
  double signal_to_noise = 6.0;

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
};

using Pick = Outcome<Arrival>;

/// The largest extremum of the expected sign inside a causal window, refined by a least-squares quadratic
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

}  // namespace ddem::harness
