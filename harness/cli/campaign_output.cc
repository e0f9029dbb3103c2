#include "harness/cli/campaign_output.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/campaign/report_content.h"
#include "harness/campaign/write_results.h"
#include "harness/io/errors.h"
#include "harness/io/message.h"
#include "harness/nightly/broken_since.h"
#include "harness/nightly/history_figures.h"
#include "harness/provenance/provenance.h"
#include "reports/text.h"

namespace ddem::harness {
namespace {

void print_verdicts(const std::vector<reports::Verdict>& verdicts) {
  for (const reports::Verdict* v : reports::worst_first(verdicts)) {
    if (reports::is_pass(v->state)) continue;
    fmt::print("{}", reports::clean_utf8(fmt::format("{}: {} {}\n", reports::to_string(v->state), v->case_id, v->reason)));
    for (const reports::Criterion& c : v->criteria) {
      if (!reports::is_pass(c.state)) fmt::print("    {}\n", reports::clean_utf8(reports::outcome_text(c)));
    }
    if (!v->reproduce.empty()) fmt::print("    reproduce: {}\n", reports::clean_utf8(v->reproduce));
  }
  fmt::print("{}\n", reports::headcount(verdicts));
}

std::string time_of(const nightly::Summary& summary) {
  const auto found = std::find_if(summary.provenance.begin(), summary.provenance.end(),
                                  [](const auto& p) { return p.first == "time"; });
  return found == summary.provenance.end() ? "unknown" : found->second;
}

nightly::WorkCounts work_of(const PlannedCampaign& campaign, const CampaignResults& results) {
  nightly::WorkCounts work;
  work.units = static_cast<std::int64_t>(campaign.plan().units.size());
  for (const PlannedStudy& s : results.studies) s.study->count(work);
  return work;
}

nightly::Night night_of(const PlannedCampaign& campaign, const CampaignResults& results, const std::vector<reports::Verdict>& verdicts) {
  const nightly::Summary summary{campaign_title(results.tables), results.wall_seconds, provenance(), verdicts};
  return {time_of(summary), summary, work_of(campaign, results)};
}

/// A history that cannot be read must not cost the results: the report says what is wrong with it.
reports::Section trends_until(const nightly::Night& night, const std::filesystem::path& folder, std::vector<std::string>& findings) {
  try {
    std::vector<nightly::Night> nights = nightly::nights_so_far(folder);
    nights.push_back(night);
    for (const std::string& complaint : nightly::clock_complaints(nights)) message("history: {}", complaint);
    findings = nightly::broken_since(nights);
    return nightly::history_section(nights);
  } catch (const InputError& e) {
    message("no trends in the report: {}", e.what());
    return {.heading = "History", .paragraphs = {fmt::format("Not drawn: {}", e.what())}};
  }
}

/// Of what the run was to measure: --only and --static leave cases out.
void compare_with_baseline(const PlannedCampaign& campaign, const Conclusion& conclusion, std::vector<reports::Verdict>& verdicts) {
  const auto selected = [&](const std::string& id) { return !conclusion.partial && campaign.selects(id); };
  const auto comparisons = nightly::compare(verdicts, *conclusion.baseline, selected);
  if (const std::size_t skipped = nightly::count_of(reports::State::skipped, comparisons); skipped > 0)
    fmt::print("baseline: {} of its {} metrics are not of what was run, and were not judged\n", skipped, conclusion.baseline->size());
}

}  // namespace

int conclude_campaign(const PlannedCampaign& campaign, const CampaignResults& results,
                      const Conclusion& conclusion) {
  std::vector<reports::Verdict> verdicts = campaign.verdicts(results);
  if (conclusion.baseline) compare_with_baseline(campaign, conclusion, verdicts);
  if (conclusion.history.empty()) {
    write_results(conclusion.folder, results, report_of(results, verdicts));
  } else {
    const nightly::Night night = night_of(campaign, results, verdicts);
    std::vector<std::string> since;
    const reports::Section trends = trends_until(night, conclusion.history, since);
    reports::Report report = report_of(results, verdicts, {trends});
    report.findings.insert(report.findings.begin(), since.begin(), since.end());
    write_results(conclusion.folder, results, report);
    fmt::print("history: {}\n", nightly::append_night(conclusion.history, night).string());
  }
  print_verdicts(verdicts);
  fmt::print("report: {}/report.html ({:.1f} s)\n", conclusion.folder.string(), results.wall_seconds);
  const bool failed = std::any_of(verdicts.begin(), verdicts.end(),
                                  [](const auto& v) { return reports::is_failure(v.state); });
  return static_cast<int>(failed ? ExitCode::verdict_failed : ExitCode::done);
}

}  // namespace ddem::harness
