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

double root_mean_square(const Signal& signal, SampleRange range) {
  double sum = 0.0;
  for (std::size_t n = range.first; n < range.last; ++n) sum += signal.values[n] * signal.values[n];
  return range.size() > 0 ? std::sqrt(sum / static_cast<double>(range.size())) : 0.0;
}

Outcome<double> noise_level(const Signal& signal, const Window& window, const PickOptions& options) {
  // What is as high as expected is told from noise by what comes before it: see precursor_failure().
  if (!options.quiet && (options.expected_amplitude || options.noise)) return options.noise.value_or(0.0);
  const SampleRange quiet = options.quiet ? samples_in(signal, *options.quiet) : SampleRange{0, samples_in(signal, window).first};
  if (quiet.size() < min_quiet_samples)
    return FailedMeasurement{Failure::no_reference,
                             fmt::format("only {} samples before the arrival to measure the noise in, {} "
                                         "needed, and no expected amplitude given",
                                         quiet.size(), min_quiet_samples)};
  return std::max(options.noise.value_or(0.0), root_mean_square(signal, quiet));
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

/// Where the pulse passes half of its height, in samples.
struct HalfHeight {
  double rise = 0.0, fall = 0.0;
};

HalfHeight half_height(const Upright& s, std::size_t peak) {
  const double half = 0.5 * s[peak];
  const SampleRange run = run_above(s, peak, half);
  const auto crossing = [&](std::size_t inside, std::size_t outside) {
    const double share = (s[inside] - half) / (s[inside] - s[outside]);
    return static_cast<double>(inside) + share * (static_cast<double>(outside) - static_cast<double>(inside));
  };
  return {run.first > 0 ? crossing(run.first, run.first - 1) : 0.0,
          run.last < s.signal.size() ? crossing(run.last - 1, run.last) : static_cast<double>(s.signal.size())};
}

// A sin^2 begins two of its rises from half height before its peak, a Gaussian is down to 0.2 % after three.
constexpr double foot_in_rises = 3.0;

SampleRange before_pulse(std::size_t peak, const HalfHeight& half) {
  const double foot = static_cast<double>(peak) - foot_in_rises * (static_cast<double>(peak) - half.rise);
  return {0, foot > 0.0 ? static_cast<std::size_t>(foot) : 0};
}

/// Coda may be as high as what it follows, and noise is as high before its highest crest as after: a pulse that nothing
/// comes before is neither.
std::optional<FailedMeasurement> precursor_failure(double peak, double before, const PickOptions& options) {
  if (peak >= options.signal_to_noise * before) return std::nullopt;
  return FailedMeasurement{Failure::not_first,
                           fmt::format("what comes before the pulse has {:.3g} of its height (root mean square), more than one in {}: "
                                       "noise, or the pulse is not the first",
                                       before / peak, options.signal_to_noise)};
}

// Less than this of the pulse's height cuts its top nowhere: six times that is a tenth of what the fit covers.
constexpr double least_roughness = 1e-3;

/// Noise from one sample to the next, as a root mean square: of the second differences, which leave out what is smooth,
/// such as the forerunners of a wave. White noise has the same by its values and by its second differences over sqrt(6).
double roughness(const Upright& s, SampleRange range, std::size_t peak) {
  double sum = 0.0;
  for (std::size_t n = range.first + 1; n + 1 < range.last; ++n) {
    const double second = s[n + 1] - 2.0 * s[n] + s[n - 1];
    sum += second * second;
  }
  const double rough = range.size() > 2 ? std::sqrt(sum / (6.0 * static_cast<double>(range.size() - 2))) : 0.0;
  return rough < least_roughness * s[peak] ? 0.0 : rough;
}

Pick refine(const Upright& s, std::size_t peak, double noise, const HalfHeight& half_height, const PickOptions& options) {
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
  return Arrival{s.signal.time(middle + fit.vertex()), fit.at_vertex(), (half_height.fall - half_height.rise) * s.signal.dt};
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
  const HalfHeight half = half_height(s, peak);
  const SampleRange before = options.still_before ? before_pulse(peak, half) : SampleRange{};
  const double rough = roughness(s, before, peak);
  if (auto failure = rival_failure(s, range, peak, rough, options)) return *failure;
  if (auto failure = precursor_failure(s[peak], root_mean_square(signal, before), options)) return *failure;
  return refine(s, peak, rough, half, options);
}

Pick pick_centroid(const Signal& signal, const Window& window, double half_width,
                   const PickOptions& options) {
  if (!(half_width > 0.0) || !std::isfinite(half_width))
    throw std::invalid_argument("the half width of a centroid window must be positive");
  Pick peak = pick_peak(signal, window, options);
  if (!peak.ok()) return peak;
  const Outcome<double> centroid = centroid_around(signal, peak.value().time, half_width, options.polarity);
  if (!centroid.ok()) return centroid.error();
  return Arrival{centroid.value(), peak.value().amplitude, peak.value().width};
}

Outcome<double> centroid_around(const Signal& signal, double time, double half_width, Polarity polarity) {
  const double centre = (time - signal.t0) / signal.dt;  // in samples
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
  const double sign = polarity == Polarity::positive ? 1.0 : -1.0;
  const double shift = moment / area;
  if (!(sign * area > 0.0) || !(std::abs(shift) * signal.dt < half_width))
    return FailedMeasurement{Failure::ambiguous, "the pulse has no centroid: it is not of one sign"};
  return signal.time(centre + shift);
}

}  // namespace ddem::harness
