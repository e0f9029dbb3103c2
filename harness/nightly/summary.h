#pragma once
// summary.json: the verdicts of a run, as files keep them.

#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/json.h"
#include "reports/verdict.h"

namespace ddem::harness::nightly {

struct Summary {
  std::string title;
  double wall_seconds = 0.0;
  std::vector<std::pair<std::string, std::string>> provenance;
  std::vector<reports::Verdict> verdicts;
};

/// schema_version, title, provenance, wall_seconds, cases[{id, title, state, reason, reproduce,
/// criteria[{metric, actual, target, lower, upper, unit, derivation, state}]}]. A number that is not finite
/// is a status or absent.
Json summary_json(const Summary& summary);

/// Throws InputError, with `place`, where it is no summary. What was not measured is NaN.
Summary parse_summary(const Json& json, const std::string& place);
/// FOLDER/summary.json.
Summary read_summary(const std::filesystem::path& folder);

}  // namespace ddem::harness::nightly
