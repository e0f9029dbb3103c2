#pragma once
// What the paper's protocol makes of Poisson's ratio, step by step: from the bulk's static value over the anisotropy of a
// single packing and the softness of the free edges to what a released column shows.

#include <vector>

#include "harness/studies/strip/strip_results.h"
#include "reports/figure.h"
#include "reports/table.h"

namespace ddem::harness {

/// Means over the seeds of the random packings at one k_t/k_n; NaN where nothing was measured.
struct PaperPoisson {
  double ratio = 0.0;
  double bulk = 0.0;      ///< static, from P and shear: 1 - 2 (c_s/c_p)^2
  double bulk_bar = 0.0;  ///< static, from the bulk's bar and shear: c_b^2/(2 c_s^2) - 1; differs where a packing is not isotropic
  double strip = 0.0;     ///< static, the same with the bar speed of the very free strip
  double waves = 0.0;     ///< measured less `strip`, over the seeds that were measured
  double measured = 0.0, lowest = 0.0, highest = 0.0;  ///< column release, bar and shear peak to peak; over seeds
  std::size_t seeds = 0;               ///< that gave both velocities
  double radius_over_width = 0.0;      ///< of discs of the mean area
};
PaperPoisson paper_poisson(const StripResults& results, Model model, double stiffness_ratio);

/// The steps over k_t/k_n, for plain DEM and the last model.
reports::Figure paper_poisson_figure(const StripResults& results);
reports::Table paper_poisson_table(const StripResults& results);

}  // namespace ddem::harness
