#pragma once
// A campaign as data: what its file says and what was asked for. Its units and verdicts follow from it.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "harness/io/json.h"

namespace ddem::harness {

struct CampaignSpec {
  nlohmann::json tables = nlohmann::json::object();  ///< by name: what InputTable::read made of each
  std::vector<std::string> studies = {};             ///< those that are run; empty: all
  std::string only = {};                             ///< a study, a case, or what the names of cases begin with; empty: all
  bool with_continuum = true;                        ///< studies may run ddem-fem
  std::string solver = {};                           ///< as it was asked for; empty: the built-in one
  int ranks = 0;                                     ///< of the solver; 0: its own number

  bool has(std::string_view table) const { return tables.contains(table); }
};

/// Of a campaign without a file.
CampaignSpec default_campaign();

Json to_json_text(const CampaignSpec& spec);
/// InputError where it is not what to_json_text() makes of a campaign that a file could describe.
CampaignSpec spec_of(const Json& json);

/// What a campaign with the plan's description `there` tells, and one with `here` would not, in words; empty: nothing is lost.
std::string lost_of_campaign(const Json& there, const Json& here);

}  // namespace ddem::harness
