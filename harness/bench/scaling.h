#pragma once
// How time and memory of whole commands grow with the number of discs: each command is a program of its own, as users run it,
// from its start to its end.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/bench/assemblies.h"

namespace ddem::harness::bench {

struct ScalingPoint {
  std::string task;  ///< "pack", "moduli", "stability", "run DEM", "run lagged", "run implicit"
  Arrangement arrangement = Arrangement::lattice;
  std::size_t discs = 0;
  double seconds = 0.0;      ///< wall time
  double bytes = 0.0;        ///< most memory at once
  std::string status = "ok"; ///< or why there is no measurement
};

struct ScalingPlan {
  std::vector<std::size_t> discs;  ///< ascending
  double longest = 0.0;            ///< s: a command that would take longer, by what fewer discs took, is left out
};

/// 1e3 discs, and ten times as many each time up to `largest`; two minutes at most for one of them.
ScalingPlan scaling_plan(std::size_t largest = 100000);

/// Calls of `progress` that measure_scaling() makes.
std::size_t scaling_work(const ScalingPlan& plan);

/// Packing (from nothing), static moduli of a periodic cell, stability of a strip of deformable discs, and 300 steps of three laws; of
/// lattices and of random packings, which the commands behind the first one take from where it has left them. Bond by bond as in
/// assemblies.h. Throws MachineError where the program does not stand beside this one.
std::vector<ScalingPoint> measure_scaling(const ScalingPlan& plan, const std::function<void()>& progress);

/// The exponent by which a value grows from one number of discs to the next: log(b/a) / log(discs_b/discs_a). Empty where either
/// was not measured.
std::optional<double> growth(const ScalingPoint& a, const ScalingPoint& b, double ScalingPoint::* value);

}  // namespace ddem::harness::bench
