#pragma once
// What the waves say, in sentences for the top of the report.

#include <string>
#include <vector>

#include "harness/studies/strip/strip_results.h"

namespace ddem::harness {

/// Which Poisson's ratios DDEM reaches beyond DEM and at what cost; how far speeds are from statics and closed forms. Only of what
/// was measured.
std::vector<std::string> wave_findings(const StripResults& results);

}  // namespace ddem::harness
