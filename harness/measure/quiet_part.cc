#include "harness/measure/quiet_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/measure/local_line.h"

namespace ddem::harness {
namespace {

// What a signal may hold of round-off, as a part of its largest value: noise is never taken for less.
constexpr double kRoundOff = 1e-6;
// What is less beside the largest value is round-off, and the signal a straight line.
constexpr double kStraight = 1e-12;
// A trend is one where its line explains the quiet samples four standard deviations better than a constant.
constexpr double kTrend = 16.0;
// An earlier arrival ends the quiet part: so many times the noise of its first half.
constexpr double kEarlier = 6.0;
constexpr double kFirstCrest = 0.5, kValley = 0.75;
constexpr double kSmooth = 0.1;  // half of the smoothing, of a crest's width

/// Sums of a growing stretch, without cancellation (Welford).
class Stretch {
 public:
  void add(double n, double x) {
    ++count_;
    const double dn = n - mean_n_, dx = x - mean_x_;
    mean_n_ += dn / count_;
    mean_x_ += dx / count_;
    nn_ += dn * (n - mean_n_);
    nx_ += dn * (x - mean_x_);
    xx_ += dx * (x - mean_x_);
  }
  double slope() const { return nn_ > 0.0 ? nx_ / nn_ : 0.0; }
  double at(double n) const { return mean_x_ + slope() * (n - mean_n_); }
  double mean() const { return mean_x_; }
  double squares() const { return xx_; }
  double squares_about_line() const { return std::max(0.0, xx_ - nx_ * slope()); }
  double count() const { return count_; }

 private:
  double count_ = 0.0, mean_n_ = 0.0, mean_x_ = 0.0, nn_ = 0.0, nx_ = 0.0, xx_ = 0.0;
};

double middle_of(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

struct Line {
  double offset = 0.0, trend = 0.0;
};

std::vector<double> without(std::span<const double> values, const Line& line) {
  std::vector<double> out(values.begin(), values.end());
  for (std::size_t n = 0; n < out.size(); ++n) out[n] -= line.offset + line.trend * static_cast<double>(n);
  return out;
}

/// Through the medians of the first and the last third (Tukey's resistant line): a wave of less than half of them moves it little.
Line resistant_line(std::span<const double> values) {
  const std::size_t third = values.size() / 3;
  const double first = middle_of(values.first(third)), last = middle_of(values.last(third));
  const double trend = (last - first) / static_cast<double>(values.size() - third);
  return {first - trend * static_cast<double>(third / 2), trend};
}

/// The contiguous samples of at least `level` around one of them; two that are lower do not end them, three do.
SampleRange run_around(std::span<const double> values, double sign, std::size_t peak, double level) {
  SampleRange run{peak, peak + 1};
  std::size_t below = 0;
  for (std::size_t n = peak; n-- > 0 && below < 3;) {
    below = sign * values[n] >= level ? 0 : below + 1;
    if (below == 0) run.first = n;
  }
  below = 0;
  for (std::size_t n = peak + 1; n < values.size() && below < 3; ++n) {
    below = sign * values[n] >= level ? 0 : below + 1;
    if (below == 0) run.last = n + 1;
  }
  return run;
}

std::size_t highest(std::span<const double> values, std::optional<Polarity> polarity) {
  const auto height = [&](double v) { return !polarity ? std::abs(v) : *polarity == Polarity::positive ? v : -v; };
  std::size_t peak = 0;
  for (std::size_t n = 1; n < values.size(); ++n) {
    if (height(values[n]) > height(values[peak])) peak = n;
  }
  return peak;
}

/// With its height, and its width between the places where it passes half of that, between the samples.
Crest measured(std::span<const double> values, Crest crest) {
  const double sign = crest.sign;
  crest.height = sign * values[crest.index];
  const double half = 0.5 * crest.height;
  std::size_t left = crest.index, right = crest.index;
  while (left > 0 && sign * values[left] >= half) --left;
  while (right + 1 < values.size() && sign * values[right] >= half) ++right;
  const auto share = [&](std::size_t inside, std::size_t outside) {
    const double in = sign * values[inside], out = sign * values[outside];
    return in > half && out < half ? (in - half) / (in - out) : 0.0;
  };
  const double rise = static_cast<double>(left + 1) - (left < crest.index ? share(left + 1, left) : 1.0);
  const double fall = static_cast<double>(right) - 1.0 + (right > crest.index ? share(right - 1, right) : 1.0);
  crest.width = std::max(1.0, fall - rise);
  return crest;
}

std::optional<Crest> crest_of_sign(std::span<const double> values, double sign, double least) {
  Crest crest{sign, 0, values.size(), 0.0, 0.0};
  double highest = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double v = sign * values[n];
    if (v > highest) highest = v, crest.index = n;
    if (highest >= least && v < kValley * highest) {
      crest.last = n;
      break;
    }
    if (v <= 0.0) highest = 0.0;  // a lower crest is over
  }
  if (highest < least) return std::nullopt;
  return measured(values, crest);
}

/// The line through the quiet samples, a constant where they show no trend; and their noise.
void fit_quiet(std::span<const double> values, Levelled& out) {
  Stretch stretch;
  for (std::size_t n = 0; n < out.quiet; ++n) stretch.add(static_cast<double>(n), values[n]);
  const double about_line = stretch.squares_about_line(), explained = stretch.squares() - about_line;
  const bool trend = explained > kTrend * about_line / (stretch.count() - 2.0);
  out.trend = trend ? stretch.slope() : 0.0;
  out.offset = trend ? stretch.at(0.0) : stretch.mean();
  out.noise = std::sqrt((trend ? about_line : stretch.squares()) / (stretch.count() - (trend ? 2.0 : 1.0)));
}

/// The quiet part ends where something earlier than the crest stands above the noise of its first half.
std::size_t before_anything(std::span<const double> values, std::size_t quiet) {
  if (quiet < 2 * kLeastQuiet) return quiet;
  Stretch half;
  for (std::size_t n = 0; n < quiet / 2; ++n) half.add(static_cast<double>(n), values[n]);
  const double noise = std::sqrt(half.squares() / half.count());
  std::size_t n = quiet / 2;
  while (n < quiet && std::abs(values[n]) <= kEarlier * noise) ++n;
  return n == quiet ? quiet : std::max(quiet / 2, n - std::min(n, quiet / 16));
}

}  // namespace

std::size_t change_point(std::span<const double> values, std::size_t least) {
  const std::size_t size = values.size();
  if (least < 3 || size < 2 * least) return 0;
  const double scale = std::max(largest_magnitude(values), 1e-300);
  const auto cost = [&](double squares, double count) { return count * std::log(squares / count + kRoundOff * kRoundOff); };
  std::vector<double> before(size + 1, 0.0);
  Stretch head, tail;
  for (std::size_t n = 0; n < size; ++n) {
    head.add(static_cast<double>(n), values[n] / scale);
    before[n + 1] = cost(head.squares_about_line(), head.count());
  }
  std::size_t best = 0;
  double lowest = 0.0;
  for (std::size_t k = size; k-- > least;) {
    tail.add(static_cast<double>(k), values[k] / scale);
    if (size - k < least) continue;
    const double total = before[k] + cost(tail.squares(), tail.count());
    if (best == 0 || total < lowest) best = k, lowest = total;
  }
  return best;
}

std::optional<Crest> first_crest(std::span<const double> values, std::optional<Polarity> polarity) {
  const std::size_t peak = highest(values, polarity);
  const double sign = polarity ? (*polarity == Polarity::positive ? 1.0 : -1.0) : values[peak] < 0.0 ? -1.0 : 1.0;
  const double height = sign * values[peak];
  if (!(height > 0.0)) return std::nullopt;
  const SampleRange run = run_around(values, sign, peak, 0.5 * height);
  const std::vector<double> smooth = smoothed(values, static_cast<std::size_t>(kSmooth * static_cast<double>(run.size())));
  const double least = kFirstCrest * std::abs(smooth[highest(smooth, polarity)]);
  if (polarity) return crest_of_sign(smooth, sign, least);
  const std::optional<Crest> up = crest_of_sign(smooth, 1.0, least), down = crest_of_sign(smooth, -1.0, least);
  if (!up || !down) return up ? up : down;
  return up->index < down->index ? up : down;
}

std::optional<Crest> crest_near(std::span<const double> values, double sign, double place, double reach, double width) {
  const std::vector<double> smooth = smoothed(values, static_cast<std::size_t>(kSmooth * width));
  const auto last = static_cast<double>(values.size()) - 1.0;
  const auto first = static_cast<std::size_t>(std::clamp(place - reach, 0.0, last)),
             end = static_cast<std::size_t>(std::clamp(place + reach, 0.0, last)) + 1;
  Crest crest{sign, first, end, 0.0, 0.0};
  for (std::size_t n = first; n < end; ++n) {
    if (sign * smooth[n] > sign * smooth[crest.index]) crest.index = n;
  }
  if (!(sign * smooth[crest.index] > 0.0) || crest.index == first || crest.index + 1 == end) return std::nullopt;
  while (crest.last < values.size() && sign * smooth[crest.last] >= kValley * sign * smooth[crest.index]) ++crest.last;
  return measured(smooth, crest);
}

Outcome<Levelled> level(std::span<const double> values, std::optional<Polarity> polarity) {
  if (!all_finite(values)) return FailedMeasurement{Failure::non_finite, "the signal is not finite"};
  const auto too_short = [](std::size_t samples) {
    return FailedMeasurement{Failure::no_reference,
                             fmt::format("only {} samples before the wave to measure the noise in, and {} are needed; record "
                                         "from earlier on",
                                         samples, kLeastQuiet)};
  };
  if (values.size() < 3 * kLeastQuiet) return too_short(0);
  if (std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); }))
    return FailedMeasurement{Failure::flat, "the signal is constant; is the sensor connected?"};
  // A first guess at the line finds the crest, what is quiet before that gives the line, and so on.
  Levelled out;
  out.values = without(values, resistant_line(values));
  if (largest_magnitude(out.values) < kStraight * largest_magnitude(values))
    return FailedMeasurement{Failure::flat, "the signal is a straight line, but for round-off; is the sensor connected?"};
  std::size_t last_quiet = 0;
  constexpr int most_rounds = 5;
  for (int round = 0; round < most_rounds; ++round) {
    const std::optional<Crest> crest = first_crest(out.values, polarity);
    if (!crest) return FailedMeasurement{Failure::flat, "the signal has no crest of the expected sign"};
    out.crest = *crest;
    const std::size_t change =
        change_point(std::span(values).first(crest->index + 1), std::max<std::size_t>(3, static_cast<std::size_t>(0.25 * crest->width)));
    // The criterion finds the foot of a wave within a few samples, and noise-free ones early: some are left out.
    const auto margin = static_cast<std::size_t>(0.1 * crest->width);
    out.quiet = change > margin ? change - margin : 0;
    if (out.quiet < kLeastQuiet) return too_short(out.quiet);
    fit_quiet(values, out);
    out.values = without(values, {out.offset, out.trend});
    if (out.quiet == last_quiet) break;
    last_quiet = out.quiet;
  }
  if (const std::size_t earlier = before_anything(out.values, out.quiet); earlier < out.quiet && earlier >= kLeastQuiet) {
    out.quiet = earlier;
    fit_quiet(values, out);
    out.values = without(values, {out.offset, out.trend});
  }
  return out;
}

}  // namespace ddem::harness
