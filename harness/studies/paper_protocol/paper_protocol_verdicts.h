#pragma once
// What the paper's protocol is judged by.

#include "harness/studies/strip/strip_results.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// Of all seeds; that of `material` does not matter.
reports::Verdict paper_verdict(const StripResults& results, const StripMaterial& material);

}  // namespace ddem::harness
