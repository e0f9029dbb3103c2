#pragma once
// Maps, table and verdicts of the study of stability.

#include <vector>

#include "harness/studies/stability/stability_map.h"
#include "reports/figure.h"
#include "reports/table.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// Measured growth over k_n/E_p and the step, with the predicted limit, on the lattice; the same of random packings. Of the
/// maps those at k_t/k_n = 0.3 and nu_p = 0.3, and the published correction beyond k_t/k_n = 1/3.
std::vector<reports::Figure> stability_figures(const std::vector<StabilityMap>& maps);

/// A row a map: points, largest disagreement, sides.
reports::Table stability_table(const std::vector<StabilityMap>& maps);

/// One a map: prediction and measurement within 2 %, and nowhere on different sides.
reports::Verdict stability_map_verdict(const StabilityMap& map);

}  // namespace ddem::harness
