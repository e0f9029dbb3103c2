#pragma once
// Delay between two signals from the peak of their cross-correlation.

#include <span>
#include <vector>

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

/// The coefficient sum a b / sqrt(sum a^2 sum b^2) of `a` and every piece of `b` that is as long: [k] belongs to the piece from
/// sample k on. It is 1 where the piece is a multiple of `a`, wherever in a wave that begins and ends, and less elsewhere; a sum
/// over the whole of `b` would find another delay where `a` is cut out of a longer wave. 0 where a piece of `b` is next to nothing
/// beside the others. Empty where `b` is shorter than `a`, or one of them is zero.
std::vector<double> match(std::span<const double> a, std::span<const double> b);

}  // namespace ddem::harness
