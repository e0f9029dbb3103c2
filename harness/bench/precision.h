#pragma once
// Work-precision: run time against error, the error always against a closed form, never against a finer run.

#include <string>
#include <vector>

namespace ddem::harness::bench {

struct PrecisionPoint {
  std::string solver;  ///< "FE", "DEM", "DDEM"
  std::string scheme;  ///< of the FE: degree and wave, "p4, shear"; of discs: "rigid", "lagged", "implicit"; "rigid, exact"
  std::string mesh;    ///< elements or discs along and across
  std::size_t discs_or_dofs = 0;
  /// Of the critical step; of the FE, which is exact in time, what its states are marched with.
  double step_fraction = 0.0;
  long steps = 0;
  double seconds = 0.0;  ///< of solving: FE with critical step and receivers, discs the time loop; best of several runs
  /// Relative L2 in space-time over ten receivers. FE: against d'Alembert. Discs: against the exact motion of the same
  /// lattice with converged strains, hence the error of time stepping (and of lagging) alone.
  double error = 0.0;
  double error_to_continuum = 0.0;  ///< discs: against d'Alembert with the closed-form velocity; FE: the same as `error`
  std::string status = "ok";        ///< or why there is no error
};

}  // namespace ddem::harness::bench
