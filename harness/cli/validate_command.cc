// ddem validate [CAMPAIGN.toml]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <thread>

#include "harness/campaign/run_campaign.h"
#include "harness/campaign/verdicts.h"
#include "harness/campaign/write_results.h"
#include "harness/cli/commands.h"
#include "harness/io/errors.h"
#include "harness/io/progress.h"

namespace ddem::harness {
namespace {

struct Options {
  std::string campaign, folder = "ddem-report", shard, only;
  int jobs = 0;
  bool resume = false;
};

void print_verdicts(const std::vector<reports::Verdict>& verdicts) {
  for (const reports::Verdict* v : reports::worst_first(verdicts)) {
    if (reports::is_pass(v->state)) continue;
    fmt::print("{}: {} {}\n", reports::to_string(v->state), v->case_id, v->reason);
    for (const reports::Criterion& c : v->criteria) {
      if (!reports::is_pass(c.state)) fmt::print("    {}\n", reports::outcome_text(c));
    }
  }
  fmt::print("{}\n", reports::headcount(verdicts));
}

/// A study's case.
bool is_study(const std::string& id) {
  const auto begins = [&id](const char* study) { return id.starts_with(study); };
  constexpr std::array studies{"schemes/", "stability-map/", "dispersion/", "sizes/"};
  return std::any_of(studies.begin(), studies.end(), begins);
}

/// Keeps the model and ratio of one case, so that the whole of what it compares is run.
void restrict_to(StripCampaign& campaign, const std::string& id) {
  StripCampaign narrowed = campaign;
  narrowed.models.clear();
  narrowed.stiffness_ratios.clear();
  for (const Model m : campaign.models) {
    for (const double ratio : campaign.stiffness_ratios) {
      const std::string tail = fmt::format("/{}", material_slug(m, ratio));
      if (!id.ends_with(tail)) continue;
      narrowed.models = {m};
      narrowed.stiffness_ratios = {ratio};
    }
  }
  if (is_study(id)) {  // models and ratios of its own
    narrowed.models = {Model::dem};
    narrowed.stiffness_ratios = {campaign.stiffness_ratios.front()};
  }
  if (narrowed.models.empty()) {
    throw InputError("--only " + id + ": no such case; the report and summary.json name them, such as long-wave/random/dem/kt0.30");
  }
  campaign = narrowed;
}

int run(const Options& o) {
  if (!o.shard.empty() || o.resume) throw InputError("--shard and --resume: not built yet; run the whole campaign");
  StripCampaign campaign = o.campaign.empty() ? StripCampaign{} : read_strip_campaign(o.campaign);
  if (!o.only.empty()) restrict_to(campaign, o.only);
  prepare_folder(o.folder);

  CampaignOptions options;
  options.jobs = o.jobs > 0 ? o.jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  CampaignResults results;
  {
    options.with_studies = o.only.empty() || is_study(o.only);
    Progress progress(campaign_work(campaign, options), "simulations");
    options.on_progress = [&](std::size_t done) { progress.advance(done); };
    results = run_campaign(campaign, options);
  }
  std::vector<reports::Verdict> verdicts = verdicts_of(results);
  if (!o.only.empty()) {
    std::erase_if(verdicts, [&](const reports::Verdict& v) { return v.case_id != o.only; });
    if (verdicts.empty()) throw InputError("--only " + o.only + ": no such case");
  }
  write_results(o.folder, results, verdicts);
  print_verdicts(verdicts);
  fmt::print("report: {}/report.html ({:.1f} s)\n", o.folder, results.wall_seconds);
  const bool failed = std::any_of(verdicts.begin(), verdicts.end(), [](const auto& v) { return reports::is_failure(v.state); });
  return static_cast<int>(failed ? ExitCode::verdict_failed : ExitCode::done);
}

}  // namespace

void add_validate_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("validate", "Run a campaign and judge it: writes report.html, results.h5, summary.json, junit.xml");
  command->footer("Without a file: the strip of the paper, k_t/k_n = 0, 0.1 .. 1, DEM and DDEM, bar, shear and P waves,\n"
                  "hexagonal and random, against static moduli, closed forms and finite elements. Exit code 1 if a verdict fails.\n"
                  "A campaign file has one table, [strip]; see harness/campaigns/strip.toml.");
  command->add_option("CAMPAIGN", o->campaign, "campaign file (TOML)");
  command->add_option("-o,--output", o->folder, "folder for the report and results")->capture_default_str();
  command->add_option("-j,--jobs", o->jobs, "simulations at a time (default: the machine's cores)")->check(CLI::Range(1, 1024));
  command->add_option("--only", o->only, "one case of the report by its name, with all that it needs");
  command->add_option("--shard", o->shard, "i/n: part of a campaign (not built yet)");
  command->add_flag("--resume", o->resume, "go on with an interrupted campaign (not built yet)");
  command->callback([o, &action] { action = [o] { return run(*o); }; });
}

}  // namespace ddem::harness
