#pragma once
// Would the verdicts notice? Each parameter that a solver is given is made wrong by a few per cent, while the
// references keep the right one: the case that is there for it must fail.

#include <string>
#include <vector>

#include "harness/campaign/run_options.h"
#include "harness/studies/strip/strip_campaign.h"
#include "reports/table.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// A wrong parameter, and what became of the criterion that must fail.
struct Discrimination {
  std::string parameter;  ///< "k_n", "density", "E of the continuum"
  double share = 0.0;     ///< by which it is too large
  std::string case_id, metric;
  std::string failure;      ///< empty: ok
  double tolerances = 0.0;  ///< how far the metric is off, in half widths of its accuracy band: found above 1
};

struct DiscriminationStudy {
  std::vector<Discrimination> defects;
};

DDEM_MEMBERS(Discrimination, parameter, share, case_id, metric, failure, tolerances)
DDEM_MEMBERS(DiscriminationStudy, defects)

/// k_t/k_n = 0.3, the lattice, DEM and DDEM F; by 1 and 5 %. `with_fem`: the continuum, too.
DiscriminationStudy study_discrimination(const StripCampaign& campaign, bool with_fem);

reports::Table discrimination_table(const DiscriminationStudy& study);
/// A criterion a defect: it must be off by more than its tolerance.
reports::Verdict discrimination_verdict(const DiscriminationStudy& study);

}  // namespace ddem::harness
