#pragma once
// What statics and Bloch limits are judged by: closed forms on the lattice; in random packings the kinematic
// bound, and parts against the whole.

#include "harness/studies/strip/strip_results.h"
#include "reports/verdict.h"

namespace ddem::harness {

reports::Verdict static_verdict(const StaticOutcome& lattice);
/// Of all seeds; that of `material` does not matter.
reports::Verdict random_static_verdict(const StripResults& results, const StripMaterial& material);

}  // namespace ddem::harness
