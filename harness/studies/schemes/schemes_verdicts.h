#pragma once
// What the study of schemes is judged by.

#include <string>

#include "harness/studies/schemes/range.h"
#include "harness/studies/schemes/schemes_data.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// What the schemes are chosen by: energy, order in the step, reach.
reports::Verdict energy_verdict(const SchemeStudy& study);
reports::Verdict order_verdict(const SchemeStudy& study);
reports::Verdict reach_verdict(const SchemeStudy& study);
/// The highest Poisson's ratio of every scheme, in a sentence for the top of the report; empty where none was measured.
std::string reach_finding(const SchemeStudy& study);

/// Hard discs are rigid ones.
reports::Verdict range_verdict(const RangeStudy& study);

}  // namespace ddem::harness
