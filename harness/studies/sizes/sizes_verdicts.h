#pragma once
// What the study of sizes is judged by.

#include "harness/studies/sizes/sizes_data.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// The bias of the free strip vanishes as radius/width.
reports::Verdict size_bias_verdict(const SizeStudy& study);
/// Waves travel at their static speed whatever the size.
reports::Verdict size_wave_verdict(const SizeStudy& study);

}  // namespace ddem::harness
