#pragma once
// A run against a baseline, metric by metric.

#include <functional>
#include <string>
#include <vector>

#include "harness/io/json.h"
#include "harness/nightly/baseline.h"

namespace ddem::harness::nightly {

/// One metric of a comparison.
struct Comparison {
  std::string case_id, metric, unit;
  reports::State state = reports::State::error;
  double before = 0.0, now = 0.0, noise = 0.0;  ///< NaN: not there
  std::string note = {};                        ///< why it cannot be compared
};

/// Whether a run was to measure that case; empty: all of the baseline's.
using Selected = std::function<bool(const std::string& case_id)>;

/// Sets the states of what passed, of criteria and of their cases:
/// REGRESSED    further from right than the baseline by more than its noise;
/// MISSING      in another unit than the baseline's; and, as a criterion that is added to its case (which is added where the
///              run has it not), what the baseline has and the run has not;
/// NO_BASELINE  the baseline has it not;
/// PASS         the rest.
/// What the run was not to measure is SKIPPED among the comparisons, and no case's.
std::vector<Comparison> compare(std::vector<reports::Verdict>& verdicts, const Baseline& baseline, const Selected& selected = {});

/// Whether not one number of the run was there to be compared.
bool measured_nothing(const std::vector<Comparison>& comparisons);
std::size_t count_of(reports::State state, const std::vector<Comparison>& comparisons);

/// Lines for people: what changed beyond noise, is not in one of both, or did not pass; and how many there
/// are of each.
std::string comparison_text(const std::vector<Comparison>& comparisons);

/// metrics (how many), states {"PASS": 12, ..., all of them}, comparisons[{case, metric, unit, state, before, now, noise, note}].
Json comparison_json(const std::vector<Comparison>& comparisons);

}  // namespace ddem::harness::nightly
