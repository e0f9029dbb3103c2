#pragma once
// Speed of the finite elements: degrees of freedom times steps a second, in a run long enough that setting up does not
// count much; and what a second thread brings.

#include <functional>
#include <vector>

#include "harness/bench/fem_precision.h"

namespace ddem::harness::bench {

struct FemKernelTime {
  FemMesh mesh;
  std::size_t dofs = 0;
  long steps = 0;
  int threads = 1;
  /// With critical step and receivers; the best of the rounds, as other processes only slow it down.
  double dof_steps_per_second = 0.0;
  double over_one_thread = 1.0;
  bool same_bits = true;  ///< as with one thread
};

struct FemKernelPlan {
  std::vector<FemMesh> meshes;
  std::vector<int> threads;  ///< the first is 1
  double end = 0.0;          ///< s; the shear pulse of fem_precision.h
  int rounds = 0;
  int repetitions = 0;  ///< in a round: short runs, one of which other processes may leave alone
};

/// Degrees 4 and 8 with 17k degrees of freedom.
FemKernelPlan fem_kernel_plan();

/// `progress` is called after each round. Throws as run_fem does.
std::vector<FemKernelTime> time_fem(const FemKernelPlan& plan, const std::function<void()>& progress);

}  // namespace ddem::harness::bench
