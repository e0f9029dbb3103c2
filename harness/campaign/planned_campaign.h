#pragma once
// A campaign as a plan that any process can take up: from its description to units, and from their outcomes
// to results.

#include <filesystem>
#include <string>
#include <vector>

#include "harness/campaign/units.h"
#include "harness/nightly/plan.h"
#include "harness/nightly/run_units.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// All that a campaign's units and verdicts follow from.
struct CampaignSpec {
  StripCampaign strip;
  bool with_strip = true;
  std::vector<UserCase> cases = {};
  bool with_waves = true;  ///< false: statics alone, whatever else is asked for
  bool with_fem = true, with_studies = true;
  std::string only = {};  ///< one verdict by its name; empty: all
};

Json to_json_text(const CampaignSpec& spec);
/// InputError where it is not what to_json_text() makes.
CampaignSpec spec_of(const Json& json);

class PlannedCampaign {
 public:
  /// `options`: disturbances and progress; spec says what is run.
  explicit PlannedCampaign(const CampaignSpec& spec, CampaignOptions options = {});
  /// From a folder's plan, whichever program made it. InputError where this program does not make the same
  /// units of it.
  static PlannedCampaign of_folder(const std::filesystem::path& folder);

  const CampaignSpec& spec() const { return spec_; }
  const nightly::Plan& plan() const { return plan_; }
  std::size_t work(const nightly::Shard& shard) const;

  /// See nightly::run_units().
  CampaignResults run(const nightly::RunOptions& options) const;
  /// From the files of a folder; a unit without a good one is a failed unit.
  CampaignResults read(const std::filesystem::path& folder) const;

  /// Of those asked for; InputError where there are none.
  std::vector<reports::Verdict> verdicts(const CampaignResults& results) const;

 private:
  CampaignSpec spec_;
  CampaignResults empty_;
  std::vector<CampaignUnit> places_;
  std::vector<nightly::Unit> units_;
  nightly::Plan plan_;
};

}  // namespace ddem::harness
