#pragma once
// Wave speed from the delays between pairs of probes: mean and standard deviation, as in the paper.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "harness/measure/outcome.h"
#include "harness/measure/picker.h"

namespace ddem::harness {

/// A wave passes probe `from` and then, `distance` (m) further on, probe `to`.
struct PairDelay {
  int from = 0, to = 0;
  double distance = 0.0;
  Outcome<double> delay;  ///< s
};

/// Difference of two picks; fails with the reason of the pick that failed.
Outcome<double> delay_between(const Pick& from, const Pick& to);

struct PairSpeed {
  int from = 0, to = 0;
  double distance = 0.0;
  Outcome<double> delay;  ///< s
  Outcome<double> speed;  ///< m/s
};

struct SpeedStatistics {
  double mean = 0.0;             ///< m/s, over the pairs that succeeded
  std::optional<double> stddev;  ///< of the sample (n - 1), m/s; a single pair has none
};

struct WaveSpeed {
  std::vector<PairSpeed> pairs;
  std::size_t good_pairs = 0;
  Outcome<SpeedStatistics> speed;  ///< fails with the reasons of all failed pairs
};

/// Speed distance/delay of each pair, and their statistics where at least `min_good_pairs` succeeded
/// (default: all). A delay that is not positive is a failed pair (not_causal). Throws std::invalid_argument
/// on a distance that is not positive, on min_good_pairs = 0 and on no pairs.
WaveSpeed wave_speed(std::span<const PairDelay> pairs, std::optional<std::size_t> min_good_pairs = {});

}  // namespace ddem::harness
