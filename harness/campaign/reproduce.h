#pragma once
// Commands that a reader of a report can paste.

#include <string>
#include <string_view>

#include "harness/campaign/campaign_spec.h"

namespace ddem::harness {

/// As one word of a shell's command line.
std::string shell_word(std::string_view text);

/// "ddem validate --only CASE CAMPAIGN.toml": what a campaign is started with, but for folders. `only` empty: all of it;
/// `file`: as Plan::source; of `spec` who simulates.
std::string validate_command(const CampaignSpec& spec, const std::string& file, const std::string& only);

/// The command that runs `only` again (empty: what the campaign was asked for), with all that it needs, into a folder that is
/// called after `name`.
std::string reproduce_command(const CampaignSpec& spec, const std::string& file, const std::string& only, const std::string& name);

}  // namespace ddem::harness
