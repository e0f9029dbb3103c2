#include "harness/run/laboratory_pick.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/measure/local_line.h"

namespace ddem::harness {
namespace {

constexpr double kLeastSamples = 4.0;  // at half the height: three points of a parabola lie on its top
constexpr double kSignalToNoise = 6.0;
constexpr double kNarrowest = 0.5;       // of what was sent: what is narrower is none of it
constexpr double kTop = 0.3;             // half of the fit over the top, in widths at half height
constexpr double kLeastCurvature = 1.5;  // of a top, in heights a squared width: 4.9 for a squared sine, 5.5 for a gaussian
constexpr double kFlank = 0.25;          // half of the fit over the rise, likewise
constexpr double kTrendReach = 4.0;      // a line is carried on over so many lengths of the quiet part
constexpr double kForerunner = 0.05;     // of the height: what dispersion and coupling send ahead
constexpr double kOver = 0.15;           // a pulse is over where so much of its height is left

std::ptrdiff_t half_of(double share, double width) {
  return std::max<std::ptrdiff_t>(1, std::lround(share * width));
}

FailedMeasurement undersampled(double samples, double dt) {
  return {Failure::undersampled,
          fmt::format("the wave takes {:.3g} samples at half its height, and {} are needed; take samples every {:.3g} us or closer",
                      samples, kLeastSamples, 1e6 * dt * samples / kLeastSamples)};
}

/// The picker's own rules: noise, what comes before, rivals, edges and plateaus.
std::optional<FailedMeasurement> picker_failure(const Levelled& l) {
  PickOptions options;
  options.polarity = l.crest.sign < 0.0 ? Polarity::negative : Polarity::positive;
  options.quiet = Window{0.0, static_cast<double>(l.quiet) - 1.0};
  const Signal signal{l.values, 1.0, 0.0};
  const double room = 0.5 * l.crest.width;  // a noisy top may be past the smooth crest's end
  const Window window{static_cast<double>(l.quiet),
                      std::min(static_cast<double>(l.crest.last) + room, static_cast<double>(l.values.size()) - 1.0)};
  const Pick pick = pick_peak(signal, window, options);
  // Whether a top is flat is judged over the width of the wave: see top_of().
  if (pick.ok() || pick.error().failure == Failure::flat) return std::nullopt;
  return pick.error();
}

std::optional<FailedMeasurement> noise_failure(const Levelled& l) {
  const double independent = l.independent(l.crest.width);
  const double needed = std::max(kSignalToNoise, independent < 1.0 ? 1e3 : student_threshold(independent));
  if (l.crest.height >= needed * l.noise) return std::nullopt;
  if (l.crest.last == l.values.size()) {
    return FailedMeasurement{Failure::no_reference,
                             "the signal rises and does not come back: it is a step, or the recording ends in the wave; filter with a low "
                             "edge (band-pass), which makes a pulse of a step, or record longer"};
  }
  if (needed > kSignalToNoise && l.crest.height >= kSignalToNoise * l.noise) {
    return FailedMeasurement{
        Failure::no_reference,
        fmt::format(
            "the quiet part before the wave is only {:.2g} times as long as the wave: noise may come {:.3g} times as high as there, "
            "and the wave is {:.3g} times as high; record from earlier on, or lower the noise",
            static_cast<double>(l.quiet) / l.crest.width, needed, l.crest.height / l.noise)};
  }
  return FailedMeasurement{
      Failure::below_noise,
      fmt::format("no wave above the noise: the highest crest, {:.3g}, is {:.3g} times the noise of {:.3g} (root mean square), and {} are "
                  "needed; average over more shots, or filter (band-pass)",
                  l.crest.height, l.crest.height / l.noise, l.noise, kSignalToNoise)};
}

std::optional<FailedMeasurement> trend_failure(const Levelled& l) {
  const double reach = static_cast<double>(l.crest.index) / static_cast<double>(l.quiet);
  if (l.trend == 0.0 || reach <= kTrendReach) return std::nullopt;
  return FailedMeasurement{Failure::no_reference,
                           "the signal has a trend, and its quiet part is too short to carry that on to the wave; record from earlier on, "
                           "or filter (band-pass)"};
}

/// By how much more slow noise, of which it holds few independent pieces, differs from the quiet part's line where the wave rises than
/// within it: for m pieces (1 + a/m)/(1 - b/m) in squares, with a = b = 1 for a constant, and a = 1 + 12 (x/length)^2, b = 2 for a line
/// that is carried on to x from its middle; and as few pieces widen it (Student's t).
double beyond_the_line(const ClearWave& wave) {
  const Levelled& l = wave.levelled;
  const auto length = static_cast<double>(l.quiet);
  const double memory = correlation_length(wave.quiet()), pieces = std::max(3.0, length / memory);
  const double x = (static_cast<double>(l.crest.index) - 0.5 * length) / length;
  const double beyond = l.trend == 0.0 ? (pieces + 1.0) / (pieces - 1.0) : (pieces + 1.0 + 12.0 * x * x) / (pieces - 2.0);
  return std::sqrt(beyond) * wave.widening(memory);
}

Outcome<ClearWave> judged(ClearWave wave, double dt, double widest_gap, const LaboratoryOptions& options) {
  const Levelled& l = wave.levelled;
  if (auto failure = noise_failure(l)) return *failure;
  if (auto failure = trend_failure(l)) return *failure;
  if (auto failure = picker_failure(l)) return *failure;
  if (const double samples = wave.width * dt / widest_gap; samples < kLeastSamples) return undersampled(samples, widest_gap);
  if (options.source_duration && wave.width * dt < kNarrowest * 0.5 * *options.source_duration) {
    return FailedMeasurement{
        Failure::not_first,
        fmt::format(
            "the first crest is {:.3g} us wide at half its height, less than a quarter of the source's {:.3g} us: it is something else",
            1e6 * dt * wave.width, 1e6 * *options.source_duration)};
  }
  return wave;
}

}  // namespace

bool has_flat_top(std::span<const double> values, double sign) {
  if (values.size() < 5) return false;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  double digit = sorted.back() - sorted.front();
  const double least = 1e-9 * digit;
  for (std::size_t n = 0; n + 1 < sorted.size(); ++n) {
    if (const double step = sorted[n + 1] - sorted[n]; step > least) digit = std::min(digit, step);
  }
  const auto size = static_cast<std::ptrdiff_t>(values.size());
  const double extreme = sign < 0.0 ? sorted.front() : sorted.back();
  for (std::ptrdiff_t n = 0; n < size; ++n) {
    std::ptrdiff_t end = n;
    while (end < size && values[static_cast<std::size_t>(end)] == extreme) ++end;
    // The top of a pulse that has fallen by one digit at the ends of a run has fallen by four at twice its length; by noise some more.
    const std::ptrdiff_t length = end - n, beside = std::max<std::ptrdiff_t>(1, length / 2);
    const auto fall = [&](std::ptrdiff_t m) {
      return std::abs(values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(m, 0, size - 1))] - extreme);
    };
    if (length >= 3 && (fall(n - 1 - beside) > 8.0 * digit || fall(end + beside) > 8.0 * digit)) return true;
    n = std::max(n, end - 1);
  }
  return false;
}

Outcome<ClearWave> clear_wave(std::span<const double> values, std::span<const double> filtered, double dt, double widest_gap,
                              const LaboratoryOptions& options) {
  if (filtered.data() != values.data()) {  // of a constant and of a straight line a filter leaves round-off
    const Outcome<Levelled> raw = level(values, options.polarity);
    if (!raw.ok() && raw.error().failure == Failure::flat) return raw.error();
  }
  const Outcome<Levelled> levelled = level(filtered, options.polarity);
  if (!levelled.ok()) return levelled.error();
  const Levelled& l = levelled.value();
  ClearWave wave{l, false, l.crest.width};
  // Only where it is the wave that is cut: late echoes may be.
  const std::size_t end = std::min(values.size(), l.crest.last + static_cast<std::size_t>(l.crest.width));
  wave.clipped = has_flat_top(values.first(end), l.crest.sign);
  return judged(std::move(wave), dt, widest_gap, options);
}

Outcome<ClearWave> with_crest(ClearWave wave, const Crest& crest, double dt, double widest_gap, const LaboratoryOptions& options) {
  wave.levelled.crest = crest;
  wave.width = crest.width;
  // The quiet part was found before another crest.
  if (static_cast<double>(wave.levelled.quiet) > static_cast<double>(crest.index) - 0.5 * crest.width)
    return FailedMeasurement{Failure::ambiguous,
                             "the crest that answers to the first sensor's lies in the quiet part: the signals are not of one wave"};
  return judged(std::move(wave), dt, widest_gap, options);
}

std::vector<double> upright(const ClearWave& wave) {
  std::vector<double> out = wave.levelled.values;
  if (wave.sign() < 0.0) {
    for (double& v : out) v = -v;
  }
  return out;
}

Outcome<Uncertain> top_of(const ClearWave& wave, double width) {
  if (wave.clipped) {
    return FailedMeasurement{Failure::flat,
                             "the top of the wave is flat, three samples or more at the signal's extreme: clipped, or a plateau; lower the "
                             "gain, or take the first break"};
  }
  const std::ptrdiff_t half = half_of(kTop, width);
  const std::optional<Top> top = smooth_top(upright(wave), static_cast<double>(wave.levelled.crest.index), 0.5 * width, half);
  if (!top || -top->curvature * width * width < kLeastCurvature * wave.levelled.crest.height)
    return FailedMeasurement{Failure::flat, "the top of the wave is a plateau, not a peak; take the first break"};
  const double noise = projected_noise(wave.quiet(), slope_weights(half)) / -top->curvature;
  // A parabola through three samples of a squared sine misses its top by 0.41 dt (dt/width)^2 at most.
  return Uncertain{top->index, std::hypot(noise * wave.widening(width), 0.41 / (width * width))};
}

Outcome<Uncertain> first_break_of(const ClearWave& wave, double width) {
  const std::ptrdiff_t half = half_of(kFlank, width);
  const std::vector<double> values = upright(wave);
  const Levelled& l = wave.levelled;
  const std::optional<Foot> foot = tangent_foot(values, static_cast<double>(l.crest.index), 2.0 * width, half);
  if (!foot) return FailedMeasurement{Failure::flat, "the wave has no steep rise within two of its widths before its top"};
  // A pulse's own foot reaches half a width beyond its tangent's.
  const double end = foot->index - 0.5 * width, level = std::max(kSignalToNoise * l.noise, kForerunner * l.crest.height);
  for (std::size_t n = l.quiet; static_cast<double>(n) < end; ++n) {
    if (std::abs(values[n]) <= level) continue;
    return FailedMeasurement{Failure::not_first,
                             fmt::format("something of {:.2g} of the wave's height arrives {:.3g} of its widths before its rise: which of "
                                         "them breaks first is open; take the peak or the correlation",
                                         std::abs(values[n]) / l.crest.height, (foot->index - static_cast<double>(n)) / width)};
  }
  // t = n - s/s': dt = -ds/s' + s ds'/s'^2.
  std::vector<double> weights = value_weights(half);
  const std::vector<double> slopes = slope_weights(half);
  for (std::size_t k = 0; k < weights.size(); ++k)
    weights[k] = -weights[k] / foot->slope + slopes[k] * foot->value / (foot->slope * foot->slope);
  // Where the samples lie moves the foot of a squared sine by 1.2 dt (dt/width)^2 (1 + (4 dt/width)^2) to either side:
  // found by trying, see the test of tangents.
  const double noise = projected_noise(wave.quiet(), weights) * beyond_the_line(wave);
  return Uncertain{foot->index, std::hypot(noise, 1.2 / (width * width) * (1.0 + 16.0 / (width * width)))};
}

Outcome<Uncertain> centroid_of(const ClearWave& wave, double width, std::optional<double> half_width) {
  if (wave.clipped)
    return FailedMeasurement{Failure::flat, "the top of the wave is flat: clipped, or a plateau; lower the gain, or take the first break"};
  const Outcome<Uncertain> top = top_of(wave, width);
  if (!top.ok()) return top;
  const std::vector<double> values = upright(wave);
  const double reach = half_width.value_or(width), middle = top.value().value;
  const Levelled& l = wave.levelled;
  const std::ptrdiff_t half = half_of(kFlank, width);
  if (middle - reach < 1.0 || middle + reach > static_cast<double>(values.size()) - 2.0)
    return FailedMeasurement{Failure::at_edge, "the pulse reaches beyond the recording; record longer"};
  const double left = local_line(values, std::lround(middle - reach), half).value,
               right = local_line(values, std::lround(middle + reach), half).value;
  const double allowed = kOver * l.crest.height + 3.0 * projected_noise(wave.quiet(), value_weights(half));
  if (std::max(std::abs(left), std::abs(right)) > allowed) {
    return FailedMeasurement{Failure::ambiguous,
                             fmt::format("a width before or after its top the signal is at {:.2g} of the wave's height: it is no single "
                                         "pulse of one sign, or an echo follows at once; take the peak or the correlation",
                                         std::max(std::abs(left), std::abs(right)) / l.crest.height)};
  }
  const Outcome<double> centroid = centroid_around({values, 1.0, 0.0}, middle, reach, Polarity::positive);
  if (!centroid.ok()) return centroid.error();
  // The first moment about the centroid, over the area.
  std::vector<double> weights;
  double area = 0.0;
  for (auto k = static_cast<std::ptrdiff_t>(std::ceil(-reach)); static_cast<double>(k) <= reach; ++k) {
    weights.push_back(static_cast<double>(k));
    area += values[static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(std::lround(centroid.value()) + k, 0, static_cast<std::ptrdiff_t>(values.size()) - 1))];
  }
  for (double& w : weights) w /= area;
  return Uncertain{centroid.value(),
                   std::hypot(projected_noise(wave.quiet(), weights) * wave.widening(2.0 * reach), 0.41 / (width * width))};
}

}  // namespace ddem::harness
