#pragma once
// What the continuum is judged by: plane waves, and bars, of its own moduli.

#include "harness/studies/strip/strip_results.h"
#include "reports/verdict.h"

namespace ddem::harness {

reports::Verdict fem_verdict(const StripResults& results, const FemOutcome& outcome);

}  // namespace ddem::harness
