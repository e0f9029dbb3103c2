#include "harness/campaign/campaign_spec.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/campaign/registry.h"
#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

const Json& member(const Json& j, std::string_view name) {
  static const Json none;
  const auto found = j.find(name);
  return j.is_object() && found != j.end() ? *found : none;
}

void require_known(const CampaignSpec& spec) {
  for (const auto& [name, data] : spec.tables.items()) {
    const auto known = std::ranges::find(input_tables(), name, &InputTable::name);
    if (known == input_tables().end()) throw InputError("unknown table " + name);
    known->check(data);
  }
  for (const std::string& id : spec.studies) {
    if (std::ranges::find(studies(), id, &StudyEntry::id) == studies().end()) throw InputError("unknown study " + id);
  }
}

std::string lost_of_selection(const Json& there, const Json& here) {
  const Json &before = member(there, "only"), &now = member(here, "only");
  if (now.is_string() && now != "" && now != before) {
    return before == "" ? fmt::format("all of its cases, and this run has {} alone", now.get<std::string>())
                        : fmt::format("the case {}", before.dump());
  }
  return "";
}

bool runs(const Json& campaign, const StudyEntry& study) {
  const Json& chosen = member(campaign, "studies");
  const bool is_chosen = chosen.empty() || std::find(chosen.begin(), chosen.end(), study.id) != chosen.end();
  return is_chosen && member(campaign, "tables").contains(study.table);
}

/// Which other solver's results stand there.
std::string lost_of_solver(const Json& there, const Json& here) {
  const Json &before = member(there, "solver"), &now = member(here, "solver");
  if (before == now) return "";
  return fmt::format("the results of the solver {}", before.is_null() ? "builtin" : before.dump());
}

std::string lost_of_studies(const Json& there, const Json& here) {
  for (const StudyEntry& s : studies()) {
    if (runs(there, s) && !runs(here, s)) return fmt::format("the study {}, which this run has not", s.id);
  }
  const Json& continuum = member(there, "with_continuum");
  return continuum == true && continuum != member(here, "with_continuum") ? "finite elements, which this run has not" : "";
}

}  // namespace

CampaignSpec default_campaign() {
  CampaignSpec spec;
  for (const InputTable& t : input_tables()) {
    if (t.by_default != nullptr) spec.tables[std::string(t.name)] = t.by_default();
  }
  return spec;
}

Json to_json_text(const CampaignSpec& spec) {
  Json j{{"tables", spec.tables}, {"studies", spec.studies}, {"only", spec.only}, {"with_continuum", spec.with_continuum}};
  if (!spec.solver.empty()) j["solver"] = spec.solver;
  if (spec.ranks > 0) j["ranks"] = spec.ranks;
  return j;
}

CampaignSpec spec_of(const Json& j) {
  try {
    CampaignSpec spec{nlohmann::json(j.at("tables")), j.at("studies"), j.at("only"), j.at("with_continuum"), j.value("solver", ""), j.value("ranks", 0)};
    require_known(spec);
    return spec;
  } catch (const Json::exception& e) {
    throw InputError("the plan's campaign: " + in_words(e));
  } catch (const std::invalid_argument& e) {
    throw InputError(std::string("the plan's campaign: ") + e.what());
  }
}

std::string lost_of_campaign(const Json& there, const Json& here) {
  std::string lost;
  for (const InputTable& t : input_tables()) {
    const Json &before = member(member(there, "tables"), t.name), &now = member(member(here, "tables"), t.name);
    if (lost.empty() && !before.is_null()) lost = t.lost(nlohmann::json(before), nlohmann::json(now));
  }
  if (lost.empty()) lost = lost_of_selection(there, here);
  if (lost.empty()) lost = lost_of_solver(there, here);
  if (lost.empty()) lost = lost_of_studies(there, here);
  return lost;
}

}  // namespace ddem::harness
