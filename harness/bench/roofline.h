#pragma once
// How the kernels stand to the machine's memory (Williams, Waterman & Patterson, Commun. ACM 52 (2009) 65), with a step of
// a bond as the unit of work.

#include <vector>

#include "harness/bench/kernels.h"
#include "reports/figure.h"

namespace ddem::harness::bench {

/// Of a number of threads, GB/s.
struct Bandwidth {
  int threads = 1;
  double gb_per_s = 0.0;
};

/// A panel for each number of threads whose bandwidth is given and each arrangement that kernels were timed with: bond-steps a nanosecond over
/// bond-steps a byte of the solver's arrays, a line for each law of uniform stiffness from few discs to many; and the roof, which no kernel
/// passes that takes its arrays from memory in every step.
reports::Figure roofline_figure(const std::vector<KernelTime>& kernels, const std::vector<Bandwidth>& bandwidths);

}  // namespace ddem::harness::bench
