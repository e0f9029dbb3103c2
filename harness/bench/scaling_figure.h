#pragma once
// Time and memory of commands against the number of discs, as a figure and a table.

#include <vector>

#include "harness/bench/scaling.h"
#include "reports/figure.h"
#include "reports/table.h"

namespace ddem::harness::bench {

/// Seconds and bytes on logarithmic axes, a line for each task and arrangement (dashed: lattices).
reports::Figure scaling_figure(const std::vector<ScalingPoint>& points);

/// A row a point; growth since the size before it.
reports::Table scaling_table(const std::vector<ScalingPoint>& points);

}  // namespace ddem::harness::bench
