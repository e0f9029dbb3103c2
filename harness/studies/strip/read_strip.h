#pragma once
// [strip] of a campaign file: its keys are the members of StripCampaign, and what is absent keeps its default.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "harness/campaign/campaign_spec.h"
#include "harness/scene/document.h"
#include "harness/studies/strip/strip_campaign.h"
#include "reports/report.h"

namespace ddem::harness {

/// See InputTable.
nlohmann::json read_strip(const Document& file, const std::filesystem::path& path, std::vector<std::string>& problems);
void check_strip(const nlohmann::json& data);
std::string lost_of_strip(const nlohmann::json& there, const nlohmann::json& here);
nlohmann::json default_strip();
void introduce_strip(const nlohmann::json& data, reports::Report& report);

/// A campaign of this strip alone.
CampaignSpec campaign_of(const StripCampaign& strip);
/// What [strip] said.
StripCampaign strip_in(const CampaignSpec& spec);

}  // namespace ddem::harness
