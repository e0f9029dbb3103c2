#include "harness/measure/picker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/measure/quadratic_fit.h"

namespace ddem::harness {
namespace {

// Fewer quiet samples give a noise level too uncertain for a threshold of six: with 32 (Student's t) a sample
// of pure noise passes with a probability of 5e-7.
constexpr std::size_t min_quiet_samples = 32;

// Noise must cut neither the pulse into several peaks nor its top into several runs. The highest sample
// stands about 2.5 noise levels above the pulse, the lowest as much below it, hence levels this much lower
// (in noise levels); without noise it changes nothing.
constexpr double noise_band = 6.0;

void require_valid(const PickOptions& options) {
  const auto is_fraction = [](double f) { return f > 0.0 && f < 1.0; };
  if (!is_fraction(options.top_fraction) || !is_fraction(options.detection_fraction) ||
      !is_fraction(options.rival_fraction) || !is_fraction(options.valley_fraction))
    throw std::invalid_argument("the fractions of a peak picker must lie between 0 and 1");
  if (options.valley_fraction >= options.rival_fraction)
    throw std::invalid_argument("a valley must be lower than the rival peak behind it");
  if (!(options.signal_to_noise > 0.0))
    throw std::invalid_argument("the signal-to-noise ratio of a peak picker must be positive");
  if (options.expected_amplitude && !(*options.expected_amplitude > 0.0))
    throw std::invalid_argument("the expected amplitude is a magnitude: it must be positive");
}

/// The signal with the pulse made positive.
struct Upright {
  const Signal& signal;
  double sign;

  double operator[](std::size_t n) const { return sign * signal.values[n]; }
};

Outcome<double> noise_level(const Signal& signal, const Window& window, const PickOptions& options) {
  if (!options.quiet && options.expected_amplitude) return 0.0;
  SampleRange range;
  if (options.quiet) {
    range = samples_in(signal, *options.quiet);
  } else {
    range = {0, samples_in(signal, window).first};
  }
  if (range.size() < min_quiet_samples)
    return FailedMeasurement{Failure::no_reference,
                             fmt::format("only {} samples before the arrival to measure the noise in, {} "
                                         "needed, and no expected amplitude given",
                                         range.size(), min_quiet_samples)};
  double sum = 0.0;
  for (std::size_t n = range.first; n < range.last; ++n) sum += signal.values[n] * signal.values[n];
  return std::sqrt(sum / static_cast<double>(range.size()));
}

/// Contiguous samples around `peak` that are at least `level`; one sample below it does not end the run, two
/// do.
SampleRange run_above(const Upright& s, std::size_t peak, double level) {
  const std::size_t size = s.signal.size();
  const auto above = [&](std::size_t n) { return n < size && s[n] >= level; };  // n - 1 of 0 is not < size
  SampleRange run{peak, peak + 1};
  while (above(run.first - 1) || above(run.first - 2)) run.first -= above(run.first - 1) ? 1 : 2;
  while (above(run.last) || above(run.last + 1)) run.last += above(run.last) ? 1 : 2;
  return run;
}

std::optional<FailedMeasurement> detection_failure(double peak, double noise, const PickOptions& options) {
  if (!(peak > 0.0) || peak < options.signal_to_noise * noise)
    return FailedMeasurement{
        Failure::below_noise,
        fmt::format("the largest value of the expected sign, {:.4g}, is not {} times above "
                    "the noise, {:.4g} (root mean square)",
                    peak, options.signal_to_noise, noise)};
  if (options.expected_amplitude && peak < options.detection_fraction * *options.expected_amplitude)
    return FailedMeasurement{Failure::below_noise,
                             fmt::format("the largest value of the expected sign, {:.4g}, is below {} of the "
                                         "expected amplitude {:.4g}",
                                         peak, options.detection_fraction, *options.expected_amplitude)};
  return std::nullopt;
}

/// A sample of the window outside the peak's own run that is as high.
std::optional<FailedMeasurement> rival_failure(const Upright& s, SampleRange window, std::size_t peak,
                                               double noise, const PickOptions& options) {
  const SampleRange own = run_above(s, peak, options.valley_fraction * s[peak] - noise_band * noise);
  for (std::size_t n = window.first; n < window.last; ++n) {
    if (n >= own.first && n < own.last) continue;
    if (s[n] >= options.rival_fraction * s[peak])
      return FailedMeasurement{
          Failure::ambiguous,
          fmt::format("a second peak at {:.6g} s has {:.1f} % of the height of the one at {:.6g} s",
                      s.signal.time(static_cast<double>(n)), 100.0 * s[n] / s[peak],
                      s.signal.time(static_cast<double>(peak)))};
  }
  return std::nullopt;
}

Pick refine(const Upright& s, std::size_t peak, double noise, const PickOptions& options) {
  const double depth = options.top_fraction * s[peak] + noise_band * noise;
  SampleRange run = run_above(s, peak, s[peak] - depth);
  const bool enough = run.size() >= 3;
  if (!enough) run = {peak - 1, peak + 2};  // the peak is inside its window, hence inside the signal
  const Quadratic fit = fit_quadratic(s.signal.values.subspan(run.first, run.size()));
  const double half = 0.5 * static_cast<double>(run.size() - 1);
  // On a peak the fitted parabola falls by about `depth` from its vertex to the ends of the run; on a plateau
  // it hardly falls at all.
  const double fall = -s.sign * fit.curvature * half * half;
  if (!(fall > 0.0) || (enough && fall < 0.2 * depth) || std::abs(fit.vertex()) > half)
    return FailedMeasurement{Failure::flat, "the top of the pulse is a plateau, not a peak"};
  const double middle = 0.5 * static_cast<double>(run.first + run.last - 1);
  return Arrival{s.signal.time(middle + fit.vertex()), fit.at_vertex()};
}

}  // namespace

Pick pick_peak(const Signal& signal, const Window& window, const PickOptions& options) {
  require_valid(options);
  const SampleRange range = samples_in(signal, window);
  if (!all_finite(signal.values)) return FailedMeasurement{Failure::non_finite, "the signal is not finite"};
  if (range.size() < 3)
    return FailedMeasurement{Failure::empty_window,
                             fmt::format("{} samples between {:.6g} s and {:.6g} s, at least 3 needed",
                                         range.size(), window.begin, window.end)};

  const Upright s{signal, options.polarity == Polarity::positive ? 1.0 : -1.0};
  std::size_t peak = range.first;
  double lowest = s[range.first];
  for (std::size_t n = range.first; n < range.last; ++n) {
    if (s[n] > s[peak]) peak = n;
    lowest = std::min(lowest, s[n]);
  }
  if (!(s[peak] > lowest)) return FailedMeasurement{Failure::flat, "the signal is constant in the window"};

  const Outcome<double> noise = noise_level(signal, window, options);
  if (!noise.ok()) return noise.error();
  if (auto failure = detection_failure(s[peak], noise.value(), options)) return *failure;
  if (peak == range.first || peak + 1 == range.last)
    return FailedMeasurement{Failure::at_edge,
                             fmt::format("the largest value stands at the edge of the window, {:.6g} s",
                                         signal.time(static_cast<double>(peak)))};
  if (auto failure = rival_failure(s, range, peak, noise.value(), options)) return *failure;
  return refine(s, peak, noise.value(), options);
}

Pick pick_centroid(const Signal& signal, const Window& window, double half_width,
                   const PickOptions& options) {
  if (!(half_width > 0.0) || !std::isfinite(half_width))
    throw std::invalid_argument("the half width of a centroid window must be positive");
  Pick peak = pick_peak(signal, window, options);
  if (!peak.ok()) return peak;

  const double centre = (peak.value().time - signal.t0) / signal.dt;  // in samples
  const double begin = centre - half_width / signal.dt;
  const double end = centre + half_width / signal.dt;
  if (begin < 0.0 || end > static_cast<double>(signal.size() - 1))
    return FailedMeasurement{Failure::at_edge, "the centroid's window reaches beyond the signal"};

  // Integrals of the piecewise linear signal times 1 and (t - centre), exact for fractional end intervals:
  // Simpson's rule on each piece, whose integrand is at most quadratic.
  double area = 0.0, moment = 0.0;
  for (auto n = static_cast<std::size_t>(begin); static_cast<double>(n) < end; ++n) {
    const double left = std::max(begin, static_cast<double>(n));
    const double right = std::min(end, static_cast<double>(n + 1));
    const auto value = [&](double index) {
      const double f = index - static_cast<double>(n);
      return (1.0 - f) * signal.values[n] + f * signal.values[std::min(n + 1, signal.size() - 1)];
    };
    const double middle = 0.5 * (left + right), width = right - left;
    area += width * value(middle);
    moment += width / 6.0 *
              (value(left) * (left - centre) + 4.0 * value(middle) * (middle - centre) +
               value(right) * (right - centre));
  }
  const double sign = options.polarity == Polarity::positive ? 1.0 : -1.0;
  const double shift = moment / area;
  if (!(sign * area > 0.0) || !(std::abs(shift) * signal.dt < half_width))
    return FailedMeasurement{Failure::ambiguous, "the pulse has no centroid: it is not of one sign"};
  return Arrival{signal.time(centre + shift), peak.value().amplitude};
}

}  // namespace ddem::harness
