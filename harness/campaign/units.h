#pragma once
// A campaign as units of work that do not need each other, and back: their results are the campaign's.

#include <functional>
#include <string>
#include <vector>

#include "harness/campaign/results.h"
#include "harness/campaign/run_options.h"
#include "harness/nightly/unit.h"

namespace ddem::harness {

struct CampaignUnit {
  nightly::Unit unit;
  /// Puts its result where the campaign keeps it. Throws on a result of another shape.
  std::function<void(const nlohmann::json&, CampaignResults&)> take;
  /// Why there is no result, where the verdicts look for it.
  std::function<void(const std::string& reason, CampaignResults&)> miss;
};

/// The longest first. What several units need (assemblies, statics) is made once, when it is first asked for.
std::vector<CampaignUnit> units_of(const StripCampaign& campaign, const CampaignOptions& options);
/// Of the user's cases: places in CampaignResults::cases.
std::vector<CampaignUnit> units_of(const std::vector<UserCase>& cases);

/// A place for every result of the strip, all of them missing.
CampaignResults empty_results(const StripCampaign& campaign, const CampaignOptions& options);

/// Puts a unit's outcome into the results, whichever it is.
void take_outcome(const CampaignUnit& unit, const nightly::Outcome& outcome, CampaignResults& results);

}  // namespace ddem::harness
