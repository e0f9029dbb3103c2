#pragma once
// What driven long pulses are judged by: closed forms on the lattice; in random packings static speeds, means over the seeds.

#include "harness/studies/strip/strip_results.h"
#include "reports/verdict.h"

namespace ddem::harness {

reports::Verdict lattice_verdict(const StripResults& results, const StaticOutcome& lattice);
/// Of all seeds; that of `material` does not matter.
reports::Verdict random_verdict(const StripResults& results, const StripMaterial& material);

}  // namespace ddem::harness
