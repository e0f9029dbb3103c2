#pragma once
// The design curves of a campaign, with the targets that were calibrated.

#include "harness/studies/calibration/calibration_data.h"
#include "harness/studies/calibration/design.h"
#include "harness/studies/strip/strip_results.h"
#include "reports/figure.h"

namespace ddem::harness {

/// nu and E/k_n over k_t/k_n (means of the random packings' static moduli, and their span) and over k_n/E_p,
/// the closed forms of the lattice beside them, and the calibrated targets as points.
reports::Figure design_figure(const std::optional<DesignStudy>& design, const std::vector<CalibrationOutcome>& calibrated,
                              const StripResults& results);

}  // namespace ddem::harness
