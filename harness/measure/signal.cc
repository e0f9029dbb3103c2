#include "harness/measure/signal.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ddem::harness {

void require_valid(const Signal& signal, const Window& window) {
  if (!(signal.dt > 0.0) || !std::isfinite(signal.dt) || !std::isfinite(signal.t0))
    throw std::invalid_argument("a signal needs a positive, finite sampling step and a finite start");
  if (!std::isfinite(window.begin) || !std::isfinite(window.end) || window.begin > window.end)
    throw std::invalid_argument("a time window needs a finite begin that is not after its end");
}

SampleRange samples_in(const Signal& signal, const Window& window) {
  require_valid(signal, window);
  constexpr double round_off = 1e-9;  // in samples
  const auto clamp = [&](double index) {
    return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(signal.size())));
  };
  const double first = std::ceil((window.begin - signal.t0) / signal.dt - round_off);
  const double last = std::floor((window.end - signal.t0) / signal.dt + round_off) + 1.0;
  const SampleRange range{clamp(first), clamp(last)};
  return {range.first, std::max(range.first, range.last)};
}

Signal slice(const Signal& signal, const Window& window) {
  const SampleRange range = samples_in(signal, window);
  return {signal.values.subspan(range.first, range.size()), signal.dt,
          signal.time(static_cast<double>(range.first))};
}

double largest_magnitude(std::span<const double> values) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace ddem::harness
