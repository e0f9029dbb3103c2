#pragma once
// Phase velocity against frequency, from the phase by which one signal of a pulse lags behind another.

#include <vector>

#include "harness/measure/outcome.h"
#include "harness/measure/signal.h"

namespace ddem::harness {

/// A signal and the part of it that counts: from before the pulse to before the first reflection. The part is faded in
/// and out over `kTaper` of its length at either end, so that what is cut off leaves no step.
struct WindowedSignal {
  Signal signal;
  Window window;
};
inline constexpr double kTaper = 0.05;

struct PhaseVelocityOptions {
  /// The band: frequencies around the strongest at which both spectra carry at least this share of their maxima.
  double least_share = 0.1;
  /// Root mean square of the noise in the samples (unit of the signals), 0 where there is none; both spectra must
  /// exceed that of the noise `signal_to_noise` times.
  double noise = 0.0;
  double signal_to_noise = 6.0;
};

struct PhaseVelocity {
  std::vector<double> frequency;  ///< Hz, ascending, equidistant
  std::vector<double> speed;      ///< m/s
};

/// c(f) = 2 pi f distance / phi(f), phi the phase of the cross spectrum, unwrapped from the strongest frequency on.
/// There it is counted from the delay of the cross-correlation, so dispersion between the two places may shift it by
/// less than half a cycle. Frequencies below one period in the shorter window are left out: what lies outside would
/// decide them. Fails where the signals do not correlate (see correlation_delay), where the band is narrower than what
/// the shorter window resolves (narrow_band), and where a phase is not that of a delay (not_causal). Throws
/// std::invalid_argument on a distance that is not positive, signals of different sampling, and windows or options
/// without sense.
Outcome<PhaseVelocity> phase_velocity(const WindowedSignal& from, const WindowedSignal& to, double distance,
                                      const PhaseVelocityOptions& options = {});

}  // namespace ddem::harness
