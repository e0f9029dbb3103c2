#pragma once
// Cases that are one problem in other units. Linear elasticity of a given strip knows no unit of stress, density or
// amplitude: times scale with 1/c, signals with the amplitude. Beyond that the solution depends on Poisson's ratio
// alone, and between periodic edges, where a plane wave is one-dimensional, not even on that: a shear (or P) wave is
// one run for all materials, a bar is one run for each Poisson's ratio.

#include <cstddef>
#include <span>
#include <vector>

#include "harness/run/fem_run.h"

namespace ddem::harness {

/// How case k follows from the case that is run for it.
struct FemShare {
  std::size_t run = 0;     ///< position in FemReuse::runs
  double time = 1.0;       ///< its times are those of the run times this
  double amplitude = 1.0;  ///< and its displacements
};

struct FemReuse {
  std::vector<FemCase> runs;     ///< the first case of each problem; its end is the latest that any of them needs
  std::vector<FemShare> shares;  ///< one a case
};

/// Cases are one problem where all dimensionless numbers agree to 1e-12. Leapfrog runs (integrator verlet) depend on
/// Poisson's ratio through the time step and are shared only where it agrees; cases with snapshots never are.
FemReuse share_runs(std::span<const FemCase> cases);

/// The result of `c` from that of its run: times, signals and steps rescaled, and cut where `c` ends.
FemResult rescaled(const FemResult& run, const FemShare& share, const FemCase& c);

}  // namespace ddem::harness
