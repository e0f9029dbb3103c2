#include "harness/campaign/planned_campaign.h"

#include <algorithm>
#include <chrono>

#include "harness/campaign/results_json.h"
#include "harness/campaign/verdicts.h"
#include "harness/io/errors.h"
#include "harness/provenance/provenance.h"

namespace ddem::harness {

Json to_json_text(const CampaignSpec& spec) {
  const nlohmann::json strip = spec.strip, cases = spec.cases;
  return {{"strip", strip},
          {"with_strip", spec.with_strip},
          {"cases", cases},
          {"with_waves", spec.with_waves},
          {"with_fem", spec.with_fem},
          {"with_studies", spec.with_studies},
          {"only", spec.only}};
}

CampaignSpec spec_of(const Json& j) {
  try {
    return {nlohmann::json(j.at("strip")).get<StripCampaign>(),
            j.at("with_strip"),
            nlohmann::json(j.at("cases")).get<std::vector<UserCase>>(),
            j.at("with_waves"),
            j.at("with_fem"),
            j.at("with_studies"),
            j.at("only")};
  } catch (const Json::exception& e) {
    throw InputError(std::string("the plan's campaign: ") + e.what());
  }
}

PlannedCampaign::PlannedCampaign(const CampaignSpec& spec, CampaignOptions options) : spec_(spec) {
  options.with_waves = spec.with_waves;
  options.with_fem = spec.with_fem;
  options.with_studies = spec.with_studies;
  if (spec.with_strip) {
    empty_ = empty_results(spec.strip, options);
    places_ = units_of(spec.strip, options);
  }
  empty_.has_strip = spec.with_strip;
  for (const UserCase& c : spec.cases) empty_.cases.push_back({c, {}});
  for (CampaignUnit& u : units_of(spec.cases)) places_.push_back(std::move(u));
  for (const CampaignUnit& u : places_) units_.push_back(u.unit);
  plan_ = nightly::make_plan(units_, to_json_text(spec), program_identity());
}

PlannedCampaign PlannedCampaign::of_folder(const std::filesystem::path& folder) {
  const nightly::Plan plan = nightly::read_plan(folder);
  PlannedCampaign campaign(spec_of(plan.campaign));
  const auto same_id = [](const nightly::Plan::Entry& a, const nightly::Plan::Entry& b) {
    return a.id == b.id;
  };
  if (!std::equal(plan.units.begin(), plan.units.end(), campaign.plan_.units.begin(),
                  campaign.plan_.units.end(), same_id)) {
    throw InputError(folder.string() + ": made by " + plan.program +
                     ", whose campaigns have other units; use that program");
  }
  campaign.plan_ = plan;
  return campaign;
}

std::size_t PlannedCampaign::work(const nightly::Shard& shard) const {
  std::size_t work = 0;
  for (std::size_t k = 0; k < units_.size(); ++k) work += shard.has(k) ? units_[k].work : 0;
  return work;
}

CampaignResults PlannedCampaign::run(const nightly::RunOptions& options) const {
  const auto start = std::chrono::steady_clock::now();
  CampaignResults results = empty_;
  nightly::run_units(units_, plan_, options,
                     [&](std::size_t k, const nightly::Outcome& o) { take_outcome(places_[k], o, results); });
  results.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return results;
}

CampaignResults PlannedCampaign::read(const std::filesystem::path& folder) const {
  CampaignResults results = empty_;
  nightly::read_outcomes(folder, plan_, [&](std::size_t k, const nightly::Outcome& o) {
    take_outcome(places_[k], o, results);
    results.wall_seconds += o.seconds;
  });
  return results;
}

std::vector<reports::Verdict> PlannedCampaign::verdicts(const CampaignResults& results) const {
  std::vector<reports::Verdict> verdicts = verdicts_of(results);
  if (spec_.only.empty()) return verdicts;
  std::erase_if(verdicts, [&](const reports::Verdict& v) { return v.case_id != spec_.only; });
  if (verdicts.empty()) throw InputError("--only " + spec_.only + ": no such case");
  return verdicts;
}

}  // namespace ddem::harness
