#pragma once
// Work-precision of the finite elements: a Gaussian pulse of 0.3 mm in the 16.5 mm x 2 mm strip, 7.5 us, ten receivers
// (none on a node by design), against d'Alembert's solution: shear between periodic edges, and the bar with nu = 0.

#include <array>
#include <functional>
#include <vector>

#include "harness/bench/precision.h"
#include "harness/run/fem_run.h"

namespace ddem::harness::bench {

struct FemMesh {
  int degree = 1;
  std::array<int, 2> elements{};
};

/// Degrees 1, 2, 4 and 8 on meshes of nearly square elements, each twice as fine as the last or less.
std::vector<FemMesh> fem_meshes();

/// The pulse as a case; its end, receivers and samples (one a critical step) are the same for all.
FemCase pulse_case(const FemMesh& mesh, Wave wave);

/// Relative L2 error in space-time of the component that carries the wave.
double pulse_error(const FemCase& fem, const FemResult& result);

/// `repetitions` runs of ddem-fem, of which the best seconds count. Throws as run_fem does.
std::vector<PrecisionPoint> measure_fem(const std::vector<FemMesh>& meshes, int repetitions, const std::function<void()>& progress);

}  // namespace ddem::harness::bench
