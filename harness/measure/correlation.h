#pragma once
// Delay between two signals from the peak of their cross-correlation.

#include "harness/measure/outcome.h"
#include "harness/measure/signal.h"

namespace ddem::harness {

/// The delay (s) by which `to` follows `from`, searched for inside [delays.begin, delays.end]: the peak of
/// the correlation coefficient sum_n from(n) to(n+k) / sqrt(sum from^2 sum to^2), refined below the sampling
/// step like a pulse's peak. Fails where the coefficient stays below `min_coefficient` (signals of another
/// shape, or noise), where two delays fit as well as each other, or at the edge of the interval. Both signals
/// need the same dt (std::invalid_argument otherwise). Reflections belong cut off: see slice().
Outcome<double> correlation_delay(const Signal& from, const Signal& to, const Window& delays,
                                  double min_coefficient = 0.5);

}  // namespace ddem::harness
