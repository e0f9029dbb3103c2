#pragma once
// What a bond costs in a step, law by law, by Google Benchmark. The repetitions of all laws of a size are mixed at random
// and the median counts: a slow spell of the machine then hits them alike, and ratios between laws hold even on a busy one.
// Setting up is not timed.

#include <functional>
#include <string>
#include <vector>

#include "harness/bench/assemblies.h"

namespace ddem::harness::bench {

struct KernelTime {
  std::string law;
  Arrangement arrangement = Arrangement::lattice;
  bool per_bond_stiffness = false;
  std::size_t discs = 0, bonds = 0;
  int threads = 1;
  double nanoseconds_per_bond_step = 0.0;  ///< median
  double best = 0.0;                       ///< the fastest repetition, ns per bond and step
  /// Ratio of medians of the same discs: times DEM with uniform stiffness and shear, of a deformable law without shear times DEM
  /// without.
  double over_dem = 0.0;
  int rounds = 0;
  double bytes_per_bond = 0.0;  ///< of the solver's arrays
};

struct KernelPlan {
  Arrangement arrangement = Arrangement::lattice;
  std::size_t discs = 0;
  long steps = 0;  ///< a round
  int rounds = 0;
  bool deformable = true;   ///< lagged and implicit strains
  bool per_bond = true;     ///< those with stiffnesses of their own as well
  std::vector<int> threads;
};

/// 682, 1e4, 1e5 and 1e6 discs, in a lattice and at random; two threads where the machine has them.
std::vector<KernelPlan> kernel_plans();

/// `progress` is called after each plan.
std::vector<KernelTime> time_kernels(const std::vector<KernelPlan>& plans, const std::function<void()>& progress);

}  // namespace ddem::harness::bench
