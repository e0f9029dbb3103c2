#pragma once
// Everything that `ddem bench` measures, and as JSON.

#include <functional>
#include <string>
#include <vector>

#include "harness/bench/disc_precision.h"
#include "harness/bench/fem_kernels.h"
#include "harness/bench/fem_precision.h"
#include "harness/bench/kernels.h"
#include "harness/bench/peers.h"
#include "harness/bench/scaling.h"
#include "harness/io/json.h"

namespace ddem::harness::bench {

struct BenchPlan {
  bool kernels = true, work_precision = true, peers = true, scaling = true;
  std::vector<KernelPlan> kernel_plans = bench::kernel_plans();
  FemKernelPlan fem_kernels = fem_kernel_plan();
  DiscPlan discs = disc_plan();
  std::vector<FemMesh> fem_meshes = bench::fem_meshes();
  int fem_repetitions = 3;
  std::vector<PeerPlan> peer_plans = bench::peer_plans();
  ScalingPlan sizes = scaling_plan();
};

struct BenchResults {
  std::vector<KernelTime> kernels;
  std::vector<FemKernelTime> fem_kernels;
  std::vector<PrecisionPoint> work_precision;
  std::string fem_failure;  ///< why there is nothing of the finite elements; empty: there is
  Peers peers;
  std::vector<ScalingPoint> scaling;
  double triad_one_thread = 0.0, triad = 0.0;  ///< GB/s: of one thread, of as many as the machine runs at once
  int triad_threads = 1;
  double wall_seconds = 0.0;
};

/// Calls of `progress` that run_bench makes.
std::size_t bench_work(const BenchPlan& plan);

BenchResults run_bench(const BenchPlan& plan, const std::function<void()>& progress);

/// Work-precision in a second or so: coarse meshes, one size of discs, each run once. What cannot be
/// measured, such as the finite elements where ddem-fem is missing, is one point with the reason as its status.
std::vector<PrecisionPoint> measure_briefly();

/// kernels, fem_kernels, work_precision, scaling, peers (with peers_reason where there are none), triad_gb_per_s, provenance;
/// fem_reason where ddem-fem is missing.
Json bench_json(const BenchResults& results);

}  // namespace ddem::harness::bench
