#pragma once
// What the continuum is judged by: plane waves, and bars, of its own moduli.

#include <string>

#include "harness/studies/strip/strip_results.h"
#include "reports/verdict.h"

namespace ddem::harness {

reports::Verdict fem_verdict(const StripResults& results, const FemOutcome& outcome);

/// How far plane waves are from the continuum's speeds at most, in a sentence for the top of the report; empty without one.
std::string continuum_finding(const StripResults& results);

}  // namespace ddem::harness
