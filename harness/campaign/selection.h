#pragma once
// Which units and cases of a campaign are asked for: of a study, with what it needs and nothing else.

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "harness/campaign/campaign_spec.h"
#include "harness/campaign/registry.h"

namespace ddem::harness {

/// A study of a campaign.
struct PlannedStudy {
  const StudyEntry* entry = nullptr;
  std::unique_ptr<Study> study;
  bool is_asked_for = false;  ///< else it is there for the units that others need
};

/// The studies that a campaign needs, and of those asked for the cases and units.
struct Selection {
  std::vector<PlannedStudy> studies;
  std::set<std::string> units, cases;
  /// Whether a case, of this campaign or another night's, is of the kinds that are judged here.
  bool has(const std::string& case_id) const;

  std::string only;
};

/// Throws InputError, naming what was meant, where nothing is called as spec.only says.
Selection select(const CampaignSpec& spec, const CampaignOptions& options);

/// What --list tells of a study.
struct StudyListing {
  std::string id, title;
  std::vector<std::string> needs, cases;  ///< ids of studies; of cases
  double seconds = 0.0;                   ///< of one core, about
};
std::vector<StudyListing> list_studies(const CampaignSpec& spec, const CampaignOptions& options);

/// Units of work are about that long on a core.
inline constexpr double kSecondsOfWork = 0.01;

}  // namespace ddem::harness
