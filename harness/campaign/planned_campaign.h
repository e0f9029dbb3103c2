#pragma once
// A campaign as a plan that any process can take up: from its description to units, and from their outcomes to results.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/campaign/campaign_spec.h"
#include "harness/campaign/selection.h"
#include "harness/nightly/plan.h"
#include "harness/nightly/run_units.h"
#include "reports/verdict.h"

namespace ddem::harness {

/// The studies with what they were given.
struct CampaignResults {
  nlohmann::json tables;  ///< what the campaign's file said
  std::string solver;     ///< CampaignSpec::solver
  std::vector<PlannedStudy> studies;
  std::map<std::string, std::string> failed_units;  ///< which gave no result, and why; each is an ERROR of its own,
                                                    ///< or SKIPPED where the solver cannot do what it needs
  std::map<std::string, double> unit_seconds;       ///< wall time of each unit
  double wall_seconds = 0.0;
};

class PlannedCampaign {
 public:
  /// `options`: disturbances and progress; spec says what is run. `file`: where it stands, for commands (Plan::source).
  /// InputError where there is nothing to run.
  explicit PlannedCampaign(const CampaignSpec& spec, CampaignOptions options = {}, const std::string& file = {});
  /// From a folder's plan, whichever program made it. InputError where this program does not make the same units of it.
  static PlannedCampaign of_folder(const std::filesystem::path& folder);

  const CampaignSpec& spec() const { return spec_; }
  const nightly::Plan& plan() const { return plan_; }
  std::size_t work(const nightly::Shard& shard) const;
  /// Whether a case of the whole campaign is among what is judged here.
  bool selects(const std::string& case_id) const { return selection_.has(case_id); }

  /// See nightly::run_units().
  CampaignResults run(const nightly::RunOptions& options) const;
  /// From the files of a folder; a unit without a good one is a failed unit.
  CampaignResults read(const std::filesystem::path& folder) const;

  /// Of the cases asked for, with commands and times.
  std::vector<reports::Verdict> verdicts(const CampaignResults& results) const;

 private:
  CampaignSpec spec_;
  CampaignOptions options_;
  Selection selection_;
  std::vector<std::size_t> work_;
  nightly::Plan plan_;
};

/// Without a folder, in this process.
CampaignResults run_campaign(const CampaignSpec& spec, const CampaignOptions& options);

}  // namespace ddem::harness
