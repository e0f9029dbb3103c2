#pragma once
// Design curves: which Poisson's ratio and Young's modulus soft discs give, to be looked up before an
// assembly is chosen. (Over k_t/k_n the campaign's own static moduli tell.)

#include <vector>

#include "harness/campaign/strip_campaign.h"

namespace ddem::harness {

/// Plane constants of an assembly at unit stiffness.
struct DesignPoint {
  double young_over_stiffness = 0.0, poisson_ratio = 0.0;  ///< E/k_n, 1/m; nu
};

struct SoftnessCurve {
  double particle_poisson_ratio = 0.0;
  std::vector<DesignPoint> random, lattice;  ///< one a softness: first random packing, static; closed form
};

struct DesignStudy {
  double stiffness_ratio = 0.0;  ///< k_t/k_n, held
  std::vector<double> softness;  ///< k_n/(E_p h), ascending
  std::vector<SoftnessCurve> curves;
};

/// Correction F, converged strains. Throws where the packing has no static equilibrium.
DesignStudy study_design(const StripCampaign& campaign);

}  // namespace ddem::harness
