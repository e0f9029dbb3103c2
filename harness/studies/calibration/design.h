#pragma once
// Design curves: which Poisson's ratio and Young's modulus soft discs give, to be looked up before an
// assembly is chosen. (Over k_t/k_n the campaign's own static moduli tell.)

#include <vector>

#include "harness/studies/strip/strip_campaign.h"

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

DDEM_MEMBERS(DesignPoint, young_over_stiffness, poisson_ratio)
DDEM_MEMBERS(SoftnessCurve, particle_poisson_ratio, random, lattice)
DDEM_MEMBERS(DesignStudy, stiffness_ratio, softness, curves)

/// Throws std::runtime_error where members that belong together do not fit: a result of another program.
void require_whole(const DesignStudy& found);

/// Correction F, converged strains. Throws where the packing has no static equilibrium.
DesignStudy study_design(const StripCampaign& campaign);

}  // namespace ddem::harness
