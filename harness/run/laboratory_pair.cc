#include "harness/run/laboratory_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/measure/correlation.h"
#include "harness/measure/local_line.h"

namespace ddem::harness {
namespace {

constexpr double kTemplate = 1.5;    // on either side of a crest, in widths: what is compared
constexpr double kContext = 4.0;     // likewise: what tells one cycle of a wave from the next
constexpr double kLeastAlike = 0.5;  // coefficient of correlation
// What is left of one signal's energy, after as much of the other as fits: another place fits as well as the best where it leaves
// less than twice as much, and less than this more. At the best place noise is left, or what dispersion does.
constexpr double kRival = 0.1;
constexpr double kSmooth = 0.1;          // half of the template's smoothing
constexpr double kSlope = 0.25;          // half of the lines that give its slope
constexpr double kTopFraction = 0.01;    // of the coefficient, which is skew around its top: fitted over this alone
constexpr double kMostWidths = 2.5;      // between the widths of one wave at two sensors
constexpr double kMostUncertain = 0.25;  // of a delay
constexpr double kWaveOver = 0.15;           // a wave is over where so much of its height is left

SampleRange around(const ClearWave& wave, double reach) {
  const double middle = static_cast<double>(wave.levelled.crest.index), size = static_cast<double>(wave.levelled.values.size());
  return {static_cast<std::size_t>(std::max(0.0, middle - reach)), static_cast<std::size_t>(std::min(size, middle + reach + 1.0))};
}

double inner_product(const std::vector<double>& a, const std::vector<double>& b, std::ptrdiff_t shift) {
  double sum = 0.0;
  for (std::ptrdiff_t n = 0; n < static_cast<std::ptrdiff_t>(a.size()); ++n) {
    if (n + shift >= 0 && n + shift < static_cast<std::ptrdiff_t>(b.size()))
      sum += a[static_cast<std::size_t>(n)] * b[static_cast<std::size_t>(n + shift)];
  }
  return sum;
}

/// By sample from the crest: the wave's slopes, less what is a multiple of the wave itself.
std::vector<double> slopes_around(const ClearWave& wave, double width) {
  const auto reach = static_cast<std::ptrdiff_t>(kTemplate * width), half = std::max<std::ptrdiff_t>(1, std::lround(kSlope * width));
  const auto middle = static_cast<std::ptrdiff_t>(wave.levelled.crest.index);
  std::vector<double> values, slopes;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    const LocalLine line = local_line(wave.levelled.values, middle + k, half);
    values.push_back(wave.sign() * line.value);
    slopes.push_back(wave.sign() * line.slope);
  }
  const double share = inner_product(values, slopes, 0) / inner_product(values, values, 0);
  for (std::size_t k = 0; k < slopes.size(); ++k) slopes[k] -= share * values[k];
  return slopes;
}

/// The coefficient of a and b = a + n is largest after -sum n a'/sum a'^2, a' the slopes less their part along a (first order in n):
/// by how much the noise of either sensor moves it.
Uncertain with_spread(const ClearWave& from, const ClearWave& to, double width, double delay) {
  const std::vector<double> a = slopes_around(from, width), b = slopes_around(to, width);
  const auto crests = static_cast<double>(to.levelled.crest.index) - static_cast<double>(from.levelled.crest.index);
  const double curvature = inner_product(a, b, std::lround(delay - crests));
  const double of_from = projected_noise(from.quiet(), b) * from.widening(width);
  const double of_to = projected_noise(to.quiet(), a) * to.widening(width);
  // Of the coefficient, skew around its top, a parabola finds that to 2 dt (dt/width)^2, as trials with ringing waves show.
  return {delay, std::hypot(of_from / curvature, of_to / curvature, 2.0 / (width * width))};
}

/// A part on either side of the crest at whose ends nothing is left of the wave.
std::optional<Window> alone(const ClearWave& wave, double width) {
  const auto half = std::max<std::ptrdiff_t>(1, std::lround(kSlope * width));
  const double allowed = kWaveOver * wave.levelled.crest.height + 3.0 * projected_noise(wave.quiet(), value_weights(half));
  for (const double reach : {3.0, 2.5, 2.0, 1.5}) {
    const SampleRange range = around(wave, reach * width);
    const auto left = static_cast<std::ptrdiff_t>(range.first), right = static_cast<std::ptrdiff_t>(range.last) - 1;
    if (std::abs(local_line(wave.levelled.values, left, half).value) > allowed ||
        std::abs(local_line(wave.levelled.values, right, half).value) > allowed)
      continue;
    return Window{static_cast<double>(left), static_cast<double>(right)};
  }
  return std::nullopt;
}

}  // namespace

Outcome<Crest> answering_crest(const ClearWave& from, const ClearWave& to, bool may_be_turned) {
  const double width = from.width;
  const auto smoothing = static_cast<std::size_t>(std::lround(kSmooth * width));
  const std::vector<double> a = smoothed(from.levelled.values, smoothing), b = smoothed(to.levelled.values, smoothing);
  const SampleRange part = around(from, kContext * width), searched = around(to, 2.0 * kContext * width);
  const std::vector<double> alike =
      match(std::span(a).subspan(part.first, part.size()), std::span(b).subspan(searched.first, searched.size()));
  const auto strength = [&](std::size_t k) { return may_be_turned ? std::abs(alike[k]) : alike[k]; };
  const auto unlike = [&](std::size_t k) { return 1.0 - std::pow(std::max(0.0, strength(k)), 2); };
  std::size_t best = 0;
  for (std::size_t k = 0; k < alike.size(); ++k) {
    if (strength(k) > strength(best)) best = k;
  }
  if (alike.empty() || strength(best) < kLeastAlike) {
    return FailedMeasurement{Failure::inconsistent,
                             "its signal is not like that of the first sensor anywhere near its wave; look at the "
                             "signals, or filter (band-pass)"};
  }
  for (std::size_t k = 0; k < alike.size(); ++k) {
    const double apart = std::abs(static_cast<double>(k) - static_cast<double>(best));
    if (apart <= 0.75 * width || unlike(k) >= unlike(best) + std::min(unlike(best), kRival)) continue;
    return FailedMeasurement{Failure::ambiguous,
                             fmt::format("its signal is like that of the first sensor at two delays, {:.2g} widths of a crest "
                                         "apart: the cycles of the wave cannot be told apart; lower the noise, send a "
                                         "shorter burst, or say the polarity",
                                         apart / width)};
  }
  const double place = static_cast<double>(searched.first + best) + static_cast<double>(from.levelled.crest.index - part.first);
  const double sign = alike[best] < 0.0 ? -from.sign() : from.sign();
  const std::optional<Crest> crest = crest_near(to.levelled.values, sign, place, 0.5 * width, width);
  if (crest) return *crest;
  return FailedMeasurement{Failure::inconsistent,
                           "it has no crest where its signal is most like that of the first sensor; look at the "
                           "signals, or filter (band-pass)"};
}

std::optional<FailedMeasurement> different_waves(const ClearWave& from, const ClearWave& to) {
  const auto [narrow, wide] = std::minmax(from.width, to.width);
  if (wide <= kMostWidths * narrow) return std::nullopt;
  return FailedMeasurement{Failure::inconsistent, fmt::format("the crests of the two sensors are {:.2g} times as wide as each other: they "
                                                              "are not of one wave; look at the signals, or filter (band-pass)",
                                                              wide / narrow)};
}

Outcome<Uncertain> correlated_delay(const ClearWave& from, const ClearWave& to, double width) {
  const auto smoothing = static_cast<std::size_t>(std::lround(kSmooth * width));
  const std::vector<double> a = smoothed(upright(from), smoothing), b = smoothed(upright(to), smoothing);
  SampleRange part = around(from, kTemplate * width), searched = around(to, (kTemplate + 1.0) * width);
  // Where the recording ends too soon after the farther sensor's crest, less is compared.
  const auto room = static_cast<double>(b.size() - to.levelled.crest.index) - 2.0;
  if (room < (kTemplate + 0.25) * width)
    part.last = std::min(part.last, from.levelled.crest.index + static_cast<std::size_t>(std::max(0.0, room - 0.25 * width)));
  const std::vector<double> alike =
      match(std::span(a).subspan(part.first, part.size()), std::span(b).subspan(searched.first, searched.size()));
  const Signal coefficient{alike, 1.0, static_cast<double>(searched.first) - static_cast<double>(part.first)};
  PickOptions options;
  options.expected_amplitude = 1.0;
  options.detection_fraction = kLeastAlike;
  options.still_before = false;
  options.top_fraction = kTopFraction;
  const Window all{coefficient.t0, coefficient.time(static_cast<double>(alike.size()) - 1.0)};
  const Pick pick = pick_peak(coefficient, all, options);
  if (pick.ok()) return with_spread(from, to, width, pick.value().time);
  return FailedMeasurement{pick.error().failure,
                           fmt::format("the two sensors' waves are not of one shape at the delay of their crests ({}); "
                                       "look at the signals, or filter (band-pass)",
                                       pick.error().reason)};
}

Outcome<Uncertain> causal_delay(const Outcome<Uncertain>& delay) {
  if (!delay.ok()) return delay;
  const auto [value, stddev] = delay.value();
  if (value < 0.0 && -value > 2.0 * stddev) {
    return FailedMeasurement{Failure::not_causal, fmt::format("the wave passes the farther sensor {:.4g} us before the nearer one: swap "
                                                              "the columns, or check the positions and where the source is",
                                                              -1e6 * value)};
  }
  if (value > 0.0 && stddev <= kMostUncertain * value) return delay;
  return FailedMeasurement{Failure::not_causal, fmt::format("the delay, {:.3g} us, is not four times its standard deviation, {:.3g} us: "
                                                            "put the sensors further apart, take samples closer, or lower the noise",
                                                            1e6 * value, 1e6 * stddev)};
}

Outcome<PhaseVelocity> phase_velocity_of(const ClearWave& from, const ClearWave& to, double width, double dt, double distance) {
  if (from.clipped || to.clipped) return FailedMeasurement{Failure::flat, "the wave is clipped: its spectrum is another; lower the gain"};
  const std::optional<Window> a = alone(from, width), b = alone(to, width);
  if (!a || !b)
    return FailedMeasurement{Failure::ambiguous,
                             "the wave is not over within three of its widths, or an echo follows at once: no spectrum of it alone"};
  std::array<std::vector<double>, 2> values = {upright(from), upright(to)};
  PhaseVelocityOptions options;
  for (std::size_t k = 0; k < 2; ++k) {
    const Levelled& l = k == 0 ? from.levelled : to.levelled;
    for (double& v : values[k]) v /= l.crest.height;
    options.noise = std::max(options.noise, l.noise / l.crest.height);
  }
  const auto windowed = [&](std::size_t k, const Window& w) { return WindowedSignal{{values[k], dt, 0.0}, {w.begin * dt, w.end * dt}}; };
  return phase_velocity(windowed(0, *a), windowed(1, *b), distance, options);
}

}  // namespace ddem::harness
