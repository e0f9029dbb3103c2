#pragma once
// What theory says of a run's scheme before it marches: growth that a run need not show, since it may be slower than the run is long.

#include <string>
#include <vector>

#include "dem/statics/static_solver.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// A march with velocity Verlet.
struct MarchedScheme {
  double time_step = 0.0;               ///< s
  double dem_critical_time_step = 0.0;  ///< 2/omega_max of rigid discs, s
  long steps = 0;
};

/// The scheme beyond its limits (theory section 3): a step above the critical one, strains that do not converge, evaluations that
/// add energy, waves of the lattice that grow. What only ddem stability finds out, in minutes, is left to it.
std::vector<std::string> instability_warnings(const Scene& scene, const ddem::Assembly& assembly, const HeldDofs& held, const MarchedScheme& march);

}  // namespace ddem::harness
