#pragma once
// Where tick marks go: multiples of 1, 2 or 5 times a power of ten.

#include <vector>

#include "reports/figure.h"

namespace ddem::reports {

struct Ticks {
  std::vector<double> values = {};  ///< ascending, all within the limits
  int exponent = 0;                 ///< of the step's power of ten: 0.05 has -2
};

/// At most max_count + 1 ticks on a linear axis; needs lower < upper, max_count >= 1.
Ticks linear_ticks(Limits limits, int max_count);

/// On a logarithmic axis: every n-th decade; with fewer than two decades 1, 2, 5 times a decade; within less
/// than that, linear ticks. Needs 0 < lower < upper.
Ticks log_ticks(Limits limits, int max_count);

}  // namespace ddem::reports
