#pragma once
// Campaign files.

#include <filesystem>
#include <string_view>
#include <vector>

#include "harness/campaign/strip_campaign.h"
#include "harness/campaign/user_case.h"

namespace ddem::harness {

struct CampaignFile {
  bool has_strip = true;  ///< false: the file has [[case]] only
  StripCampaign strip;
  std::vector<UserCase> cases;
};

/// [strip], whose keys are the members of StripCampaign (what is absent keeps its default), and any number of
/// [[case]]. Throws InputError listing every problem, of the scenes too, with file and line.
CampaignFile read_campaign(const std::filesystem::path& path);

/// The same of a text; `path` is for messages, and scenes are looked for beside it.
CampaignFile parse_campaign(std::string_view text, const std::filesystem::path& path);

/// The strip of read_campaign().
StripCampaign read_strip_campaign(const std::filesystem::path& path);

}  // namespace ddem::harness
