#pragma once
// The figure and the table of the study of sizes.

#include "harness/studies/sizes/sizes_data.h"
#include "reports/figure.h"
#include "reports/table.h"

namespace ddem::harness {

/// Bias of the free strip's bar speed, and errors of waves, over radius/width.
reports::Figure size_figure(const SizeStudy& study);
/// One row a size: how many strips, their bias, their waves.
reports::Table size_table(const SizeStudy& study);

}  // namespace ddem::harness
