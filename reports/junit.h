#pragma once
// Verdicts for continuous-integration servers.

#include <string>
#include <string_view>
#include <vector>

#include "reports/verdict.h"

namespace ddem::reports {

/// JUnit XML: one test case a verdict. ERROR becomes `<error>`; FAIL, UNSTABLE and REGRESSED `<failure>`; SKIPPED
/// and NO_BASELINE `<skipped>`. Messages name metric, actual value, bounds and derivation, and the command to
/// reproduce; times are wall seconds, to a microsecond.
std::string render_junit(std::string_view suite, const std::vector<Verdict>& verdicts);

}  // namespace ddem::reports
