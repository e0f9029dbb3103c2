#pragma once
// Campaign files.

#include <filesystem>
#include <string_view>

#include "harness/campaign/campaign_spec.h"

namespace ddem::harness {

/// The tables of input_tables(), and [studies], which says what is run: `run` or `skip`, lists of their names. Throws InputError
/// listing every problem, of scenes too, with file and line.
CampaignSpec read_campaign(const std::filesystem::path& path);

/// The same of a text; `path` is for messages, and files are looked for beside it.
CampaignSpec parse_campaign(std::string_view text, const std::filesystem::path& path);

}  // namespace ddem::harness
