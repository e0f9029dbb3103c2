#include "harness/campaign/planned_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "harness/campaign/reproduce.h"
#include "harness/io/errors.h"
#include "harness/provenance/provenance.h"

namespace ddem::harness {
namespace {

/// The units that are run, the longest first: those that last would let the others wait at the end.
std::vector<const Piece*> pieces_of(const Selection& s) {
  std::vector<const Piece*> pieces;
  for (const PlannedStudy& study : s.studies) {
    for (const Piece& p : study.study->pieces()) {
      if (s.units.contains(p.unit.id)) pieces.push_back(&p);
    }
  }
  std::ranges::stable_sort(pieces, std::ranges::greater{}, [](const Piece* p) { return p->unit.work; });
  return pieces;
}

bool has_zero_byte(const nlohmann::json& value) {
  if (value.is_string()) return value.get_ref<const std::string&>().find('\0') != std::string::npos;
  return value.is_structured() && std::ranges::any_of(value, has_zero_byte);
}

void take_outcome(const Piece& piece, const nightly::Outcome& outcome, CampaignResults& results) {
  results.unit_seconds[piece.unit.id] = outcome.seconds;
  std::string failure = outcome.failure;
  std::ranges::replace(failure, '\0', ' ');
  if (failure.empty()) {
    try {
      if (has_zero_byte(outcome.result)) throw std::runtime_error("a text with a zero byte, which no file of results can hold");
      piece.take(outcome.result);
    } catch (const std::exception& e) {
      failure = std::string("its result cannot be read: ") + e.what();
    }
  }
  if (failure.empty()) return;
  piece.miss(failure);
  results.failed_units[piece.unit.id] = failure;
}

/// What its solver cannot do is no error of a case.
void mark_skipped(const std::map<std::string, std::string>& failed_units, std::vector<Judged>& judged) {
  for (Judged& j : judged) {
    for (const std::string& unit : j.units) {
      const auto failed = failed_units.find(unit);
      if (j.verdict.state != reports::State::error || failed == failed_units.end() || !nightly::was_skipped(failed->second)) continue;
      j.verdict.state = reports::State::skipped;
      j.verdict.reason = nightly::reason_of(failed->second);
      for (reports::Criterion& c : j.verdict.criteria) c.state = reports::State::skipped;
    }
  }
}

/// A unit counts in equal parts for the cases that need it: their sum is the time that was spent.
void share_seconds(const std::map<std::string, double>& unit_seconds, std::vector<Judged>& judged) {
  for (const auto& [unit, seconds] : unit_seconds) {
    const auto needs = [&u = unit](const Judged& j) { return std::ranges::find(j.units, u) != j.units.end(); };
    const auto users = std::ranges::count_if(judged, needs);
    for (Judged& j : judged) {
      if (needs(j)) j.verdict.seconds += seconds / static_cast<double>(users);
    }
  }
}

}  // namespace

PlannedCampaign::PlannedCampaign(const CampaignSpec& spec, CampaignOptions options, const std::string& file)
    : spec_(spec), options_(std::move(options)) {
  options_.with_continuum = spec.with_continuum;
  selection_ = select(spec_, options_);
  std::vector<nightly::Unit> units;
  for (const Piece* p : pieces_of(selection_)) units.push_back(p->unit), work_.push_back(p->unit.work);
  const std::string solver = options_.solver->identity();
  plan_ = nightly::make_plan(units, to_json_text(spec), program_identity() + (solver.empty() ? "" : ", solver " + solver));
  plan_.source = file;
}

PlannedCampaign PlannedCampaign::of_folder(const std::filesystem::path& folder) {
  const nightly::Plan plan = nightly::read_plan(folder);
  PlannedCampaign campaign(spec_of(plan.campaign));
  if (!std::ranges::equal(plan.units, campaign.plan_.units, {}, &nightly::Plan::Entry::id, &nightly::Plan::Entry::id)) {
    throw InputError(folder.string() + ": made by " + plan.program + ", whose campaigns have other units; use that program");
  }
  campaign.plan_ = plan;
  return campaign;
}

std::size_t PlannedCampaign::work(const nightly::Shard& shard) const {
  std::size_t work = 0;
  for (std::size_t k = 0; k < work_.size(); ++k) work += shard.has(k) ? work_[k] : 0;
  return work;
}

CampaignResults PlannedCampaign::run(const nightly::RunOptions& options) const {
  const auto start = std::chrono::steady_clock::now();
  Selection fresh = select(spec_, options_);
  const std::vector<const Piece*> pieces = pieces_of(fresh);
  std::vector<nightly::Unit> units;
  for (const Piece* p : pieces) units.push_back(p->unit);
  CampaignResults results;
  results.tables = spec_.tables;
  results.solver = spec_.solver;
  nightly::run_units(units, plan_, options, [&](std::size_t k, const nightly::Outcome& o) { take_outcome(*pieces[k], o, results); });
  results.studies = std::move(fresh.studies);
  results.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return results;
}

CampaignResults PlannedCampaign::read(const std::filesystem::path& folder) const {
  Selection fresh = select(spec_, options_);
  const std::vector<const Piece*> pieces = pieces_of(fresh);
  CampaignResults results;
  results.tables = spec_.tables;
  results.solver = spec_.solver;
  nightly::read_outcomes(folder, plan_, [&](std::size_t k, const nightly::Outcome& o) {
    take_outcome(*pieces[k], o, results);
    results.wall_seconds += o.seconds;
  });
  results.studies = std::move(fresh.studies);
  return results;
}

std::vector<reports::Verdict> PlannedCampaign::verdicts(const CampaignResults& results) const {
  std::vector<Judged> judged;
  for (const PlannedStudy& s : results.studies) {
    if (!s.is_asked_for) continue;
    for (Judged& j : s.study->judge()) {
      if (selection_.cases.contains(j.verdict.case_id)) judged.push_back(std::move(j));
    }
  }
  const std::size_t cases = judged.size();
  for (const auto& [id, reason] : results.failed_units) {
    const auto needs = [&unit = id](const Judged& j) { return std::ranges::find(j.units, unit) != j.units.end(); };
    if (nightly::was_skipped(reason) && std::ranges::any_of(judged, needs)) continue;  // its cases say so
    judged.push_back({{.case_id = "unit/" + id, .title = "A part of the campaign that gave no result", .state = reports::State::error, .reason = reason}, {id}});
  }
  mark_skipped(results.failed_units, judged);
  share_seconds(results.unit_seconds, judged);
  std::vector<reports::Verdict> verdicts;
  for (std::size_t k = 0; k < judged.size(); ++k) {
    reports::Verdict& v = judged[k].verdict;
    std::string only = v.case_id;
    if (k >= cases) {  // a unit is no case: that of the only case that needs it, or of the whole campaign
      std::vector<std::string> users;
      for (std::size_t c = 0; c < cases; ++c) {
        if (std::ranges::find(judged[c].units, judged[k].units.front()) != judged[c].units.end()) users.push_back(judged[c].verdict.case_id);
      }
      only = users.size() == 1 ? users.front() : "";
    }
    v.reproduce = reproduce_command(spec_, plan_.source, only, v.case_id);
    verdicts.push_back(std::move(v));
  }
  return verdicts;
}

CampaignResults run_campaign(const CampaignSpec& spec, const CampaignOptions& options) {
  nightly::RunOptions run;
  run.jobs = options.jobs;
  run.on_progress = options.on_progress;
  return PlannedCampaign(spec, options).run(run);
}

}  // namespace ddem::harness
