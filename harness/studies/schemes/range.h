#pragma once
// How far deformable discs widen the range of Poisson's ratio: static moduli of the first random packing over the discs'
// nu_p and k_n/E_p, between k_t/k_n = 0 and 1 (correction F, converged strains).

#include <string>
#include <vector>

#include "harness/studies/strip/strip_campaign.h"
#include "reports/figure.h"

namespace ddem::harness {

/// nu of the packing, periodic in y, at k_t = k_n (lowest) and k_t = 0 (highest).
struct PoissonRange {
  double lowest = 0.0, highest = 0.0;
};

struct RangeCurve {
  double particle_poisson_ratio = 0.0;
  std::vector<PoissonRange> ranges;  ///< one a softness
};

struct RangeStudy {
  std::string failure;           ///< empty: ok
  std::vector<double> softness;  ///< k_n/(E_p h), ascending
  PoissonRange rigid;            ///< plain DEM
  std::vector<RangeCurve> curves;
};

DDEM_MEMBERS(PoissonRange, lowest, highest)
DDEM_MEMBERS(RangeCurve, particle_poisson_ratio, ranges)
DDEM_MEMBERS(RangeStudy, failure, softness, rigid, curves)

/// Throws std::runtime_error where members that belong together do not fit: a result of another program.
void require_whole(const RangeStudy& found);

RangeStudy study_range(const StripCampaign& campaign);

reports::Figure range_figure(const RangeStudy& study);

}  // namespace ddem::harness
