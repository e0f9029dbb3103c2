#pragma once
// A baseline: what each metric was on nights that people looked at, and how much it varied. A text file with
// one line a metric, sorted, so that a change of it can be reviewed. Only `ddem baseline update` writes one.
//
// The accuracy band of a criterion says what is right; a baseline says what was. A metric that is still
// inside the band, but further from its target than the baseline by more than the noise, has regressed.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/verdict.h"

namespace ddem::harness::nightly {

struct BaselineEntry {
  double value = 0.0;
  double noise = 0.0;  ///< not negative; a change up to this is none
  std::string unit;
};

/// By "CASE | METRIC".
using Baseline = std::map<std::string, BaselineEntry>;

std::string metric_key(const std::string& case_id, const std::string& metric);

/// How far from right a criterion's value is: from the target; without one from the middle of both bounds,
/// else beyond the one there is, so that less is better. Without any of these the distance from `usual`.
double badness(const reports::Criterion& criterion, double value, double usual);

/// What no machine can tell apart: round-off in the last bits, which other compilers and instruction sets
/// change (1e-9 of the value), and a hundredth of the accuracy band's half width.
double least_noise(const reports::Criterion& criterion);

/// Of several nights: each metric's median, and as noise the largest distance of a night from it, at least
/// least_noise(). Criteria that did not pass on every night that has them are left out, and listed.
Baseline baseline_of(const std::vector<std::vector<reports::Verdict>>& nights,
                     std::vector<std::string>& left_out);

std::string baseline_text(const Baseline& baseline);
/// InputError with `place`: not a baseline, numbers that are not finite, noise below 0.
Baseline parse_baseline(const std::string& text, const std::string& place);
/// A baseline's file, or the folder of a run, whose own numbers then are the baseline. InputError, also where
/// it has not one metric.
Baseline read_baseline(const std::filesystem::path& path);

}  // namespace ddem::harness::nightly
