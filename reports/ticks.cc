#include "reports/ticks.h"

#include <algorithm>
#include <cmath>

namespace ddem::reports {
namespace {

// i * base * 10^e by one rounding where possible: 3 * 10^-1 is the double nearest to 0.3.
double decimal(double mantissa, int e) {
  return e < 0 ? mantissa / std::pow(10.0, -e) : mantissa * std::pow(10.0, e);
}

}  // namespace

Ticks linear_ticks(Limits limits, int max_count) {
  const double rough = (limits.upper - limits.lower) / max_count;
  int exponent = static_cast<int>(std::floor(std::log10(rough)));
  const double fraction = rough / std::pow(10.0, exponent);
  constexpr double slack = 1e-9;  // a span of exactly n steps has n + 1 ticks in spite of round-off
  double base = 1.0;
  if (fraction > 5.0 * (1 + slack))
    ++exponent;
  else if (fraction > 2.0 * (1 + slack))
    base = 5.0;
  else if (fraction > 1.0 + slack)
    base = 2.0;

  const double step = decimal(base, exponent);
  const double first = std::ceil(limits.lower / step - slack), last = std::floor(limits.upper / step + slack);
  Ticks ticks{.exponent = exponent};
  for (double i = first; i <= last; i += 1.0)
    ticks.values.push_back(std::clamp(decimal(i * base, exponent) + 0.0, limits.lower, limits.upper));
  return ticks;
}

Ticks log_ticks(Limits limits, int max_count) {
  constexpr double slack = 1e-9;
  const int first = static_cast<int>(std::ceil(std::log10(limits.lower) - slack));
  const int last = static_cast<int>(std::floor(std::log10(limits.upper) + slack));
  const int decades = last - first + 1;
  Ticks ticks{.exponent = first};
  if (decades >= 3) {
    const int stride = (decades + max_count - 1) / max_count;
    for (int e = first; e <= last; e += stride)
      ticks.values.push_back(std::clamp(std::pow(10.0, e), limits.lower, limits.upper));
    return ticks;
  }
  for (int e = first - 1; e <= last; ++e)
    for (const double base : {1.0, 2.0, 5.0}) {
      const double value = decimal(base, e);
      if (value >= limits.lower * (1 - slack) && value <= limits.upper * (1 + slack))
        ticks.values.push_back(std::clamp(value, limits.lower, limits.upper));
    }
  return ticks.values.size() >= 3 ? ticks : linear_ticks(limits, max_count);
}

}  // namespace ddem::reports
