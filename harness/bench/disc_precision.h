#pragma once
// Work-precision of the particle method: rigid discs, lagged and implicit strains, over time step and resolution.

#include <functional>
#include <vector>

#include "harness/bench/precision.h"

namespace ddem::harness::bench {

struct DiscPlan {
  std::vector<int> columns;             ///< discs along the pulse's 16.4 mm; a fifth of them across
  std::vector<double> step_fractions;   ///< for each; and once exact in time, where the scheme allows it
  double seconds_a_point = 0.0;         ///< runs are repeated for so long; the best counts
};

/// 62, 124 and 248 columns (744 to 12400 discs), 0.05 to 1 of the critical step.
DiscPlan disc_plan();

std::vector<PrecisionPoint> measure_discs(const DiscPlan& plan, const std::function<void()>& progress);

}  // namespace ddem::harness::bench
