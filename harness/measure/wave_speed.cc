#include "harness/measure/wave_speed.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace ddem::harness {
namespace {

Outcome<double> pair_speed(const PairDelay& pair) {
  if (!pair.delay.ok()) return pair.delay.error();
  const double delay = pair.delay.value();
  if (!std::isfinite(delay)) return FailedMeasurement{Failure::non_finite, "the delay is not finite"};
  const double speed = pair.distance / delay;
  // A denormal delay would give an infinite speed.
  if (!(delay > 0.0) || !std::isfinite(speed))
    return FailedMeasurement{Failure::not_causal, fmt::format("the delay, {:.6g} s, is not positive", delay)};
  return speed;
}

SpeedStatistics statistics(std::span<const double> speeds) {
  const auto count = static_cast<double>(speeds.size());
  double mean = 0.0;
  for (double v : speeds) mean += v / count;
  if (speeds.size() < 2) return {mean, std::nullopt};
  double squares = 0.0;
  for (double v : speeds) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / (count - 1.0))};
}

}  // namespace

Outcome<double> delay_between(const Pick& from, const Pick& to) {
  if (!from.ok()) return FailedMeasurement{from.error().failure, "first probe: " + from.error().reason};
  if (!to.ok()) return FailedMeasurement{to.error().failure, "second probe: " + to.error().reason};
  return to.value().time - from.value().time;
}

WaveSpeed wave_speed(std::span<const PairDelay> pairs, std::optional<std::size_t> min_good_pairs) {
  if (pairs.empty()) throw std::invalid_argument("a wave speed needs at least one pair of probes");
  const std::size_t needed = min_good_pairs.value_or(pairs.size());
  if (needed == 0) throw std::invalid_argument("a mean speed needs at least one good pair");

  std::vector<PairSpeed> results;
  std::vector<double> speeds;
  std::string reasons, last;
  for (const PairDelay& pair : pairs) {
    if (!(pair.distance > 0.0) || !std::isfinite(pair.distance))
      throw std::invalid_argument(
          fmt::format("the distance of probes {} and {} must be positive and finite", pair.from, pair.to));
    PairSpeed result{pair.from, pair.to, pair.distance, pair.delay, pair_speed(pair)};
    if (result.speed.ok()) {
      speeds.push_back(result.speed.value());
    } else {
      // What all of them share is said once.
      const std::string reason = fmt::format("{} ({})", name(result.speed.error().failure), result.speed.error().reason);
      reasons += fmt::format("; pair {}-{}: {}", pair.from, pair.to, reason == last ? "the same" : reason);
      last = reason;
    }
    results.push_back(std::move(result));
  }

  const std::size_t good = speeds.size();
  if (good < needed)
    return {std::move(results), good,
            FailedMeasurement{Failure::too_few_picks, fmt::format("{} of {} pairs succeeded, {} needed{}",
                                                                  good, pairs.size(), needed, reasons)}};
  return {std::move(results), good, statistics(speeds)};
}

}  // namespace ddem::harness
