// ddem validate [CAMPAIGN.toml]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <thread>

#include "harness/campaign/read_campaign.h"
#include "harness/campaign/write_results.h"
#include "harness/cli/campaign_output.h"
#include "harness/cli/commands.h"
#include "harness/io/errors.h"
#include "harness/io/folder_lock.h"
#include "harness/io/progress.h"
#include "harness/nightly/unit_file.h"

namespace ddem::harness {
namespace {

struct Options {
  std::string campaign, folder = "ddem-report", shard, only, baseline, history;
  int jobs = 0;
  bool resume = false, plan = false, statics = false;
};

/// A study's case.
bool is_study(const std::string& id) {
  const auto begins = [&id](const char* study) { return id.starts_with(study); };
  constexpr std::array studies{"discrimination", "schemes/", "stability-map/", "dispersion/", "sizes/", "calibration/"};
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

/// What steps in time cannot be asked for.
void leave_statics_alone(const Options& o, CampaignSpec& spec) {
  if (!spec.with_strip) throw InputError(o.campaign + ": no [strip]: --static is for its moduli; for those of a scene: ddem moduli SCENE.toml");
  if (!o.only.empty() && !o.only.starts_with("static/")) {
    throw InputError("--only " + o.only + ": steps in time, which --static leaves out; its cases are static/..., such as static/random/dem/kt0.30");
  }
  spec.cases.clear();
  spec.with_waves = spec.with_fem = spec.with_studies = false;
}

CampaignSpec spec_from(const Options& o) {
  CampaignSpec spec;
  if (!o.campaign.empty()) {
    CampaignFile file = read_campaign(o.campaign);
    spec.strip = file.strip;
    spec.with_strip = file.has_strip;
    spec.cases = std::move(file.cases);
  }
  spec.only = o.only;
  if (o.only.starts_with("case/")) {
    std::erase_if(spec.cases, [&](const UserCase& c) { return "case/" + c.id != o.only; });
    spec.with_strip = false;
  } else if (!o.only.empty()) {
    spec.cases.clear();
    restrict_to(spec.strip, o.only);
    spec.with_studies = is_study(o.only);
  }
  if (o.statics) leave_statics_alone(o, spec);
  return spec;
}

/// A run that goes on, or shares a plan with others, must have the very plan.
void settle_plan(const Options& o, const nightly::Plan& plan) {
  if (nightly::has_plan(o.folder) && (o.resume || !o.shard.empty())) {
    if (const std::string d = nightly::difference(nightly::read_plan(o.folder), plan); !d.empty()) {
      throw InputError(fmt::format("{}: holds another campaign: {}; give another folder by -o, or run it anew without --resume and --shard",
                                   o.folder, d));
    }
    return;
  }
  nightly::write_plan(o.folder, plan);
}

int end_of_shard(const Options& o, const CampaignResults& results, std::size_t units) {
  for (const auto& [id, reason] : results.failed_units) fmt::print("ERROR: {}: {}\n", id, reason);
  fmt::print("shard {}: {} units, {} without a result; when all shards are there: ddem merge DIR... -o DIR\n", o.shard, units,
             results.failed_units.size());
  return static_cast<int>(results.failed_units.empty() ? ExitCode::done : ExitCode::verdict_failed);
}

int run(const Options& o) {
  const nightly::Shard shard = o.shard.empty() ? nightly::Shard{} : nightly::parse_shard(o.shard);
  const CampaignSpec spec = spec_from(o);
  if (!o.shard.empty() && (!o.baseline.empty() || !o.history.empty())) {
    throw InputError("--shard makes a part only: give --baseline and --history to ddem merge");
  }
  Conclusion conclusion{o.folder, {}, o.history};
  if (!o.baseline.empty()) conclusion.baseline = nightly::read_baseline(o.baseline);
  prepare_folder(o.folder);
  const FolderLock lock(o.folder);

  std::optional<Progress> progress;
  CampaignOptions options;
  options.on_progress = [&](std::size_t done) { progress->advance(done); };
  const PlannedCampaign campaign(spec, options);
  const nightly::Plan& plan = campaign.plan();
  settle_plan(o, plan);
  if (o.plan) {
    fmt::print("{}/plan.json: {} units\n", o.folder, plan.units.size());
    return static_cast<int>(ExitCode::done);
  }
  nightly::UnitBoard board(plan.units.size());
  nightly::RunOptions run;
  run.folder = o.folder;
  run.jobs = o.jobs > 0 ? o.jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  run.shard = shard;
  run.resume = o.resume;
  run.board = &board;
  run.on_progress = options.on_progress;
  const auto work = [&](bool first_time) {
    run.resume = o.resume || !first_time;
    progress.emplace(campaign.work(shard), o.statics ? "static solves" : "simulations");
    const CampaignResults results = campaign.run(run);
    progress.reset();
    return o.shard.empty() ? conclude_campaign(campaign, results, conclusion) : end_of_shard(o, results, shard.size(plan.units.size()));
  };
  return nightly::supervise(board, work, [&](std::size_t unit, const std::string& reason) {
    fmt::print(stderr, "{}: {}\n", plan.units[unit].id, reason);
    nightly::write_unit(o.folder, {plan.units[unit].id, plan.units[unit].identity, {nullptr, reason}});
    run.given_up.push_back(unit);
  });
}

}  // namespace

void add_validate_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("validate", "Run a campaign and judge it: writes report.html, results.h5, summary.json, junit.xml");
  command->footer("Without a file: the strip of the paper, k_t/k_n = 0, 0.1 .. 1, DEM and DDEM, bar, shear and P waves,\n"
                  "hexagonal and random, against static moduli, closed forms and finite elements. Exit code 1 if a verdict fails.\n"
                  "A campaign file has [strip] (see harness/campaigns/strip.toml), or [[case]] for scenes of your own\n"
                  "(see harness/campaigns/cases.toml), or both.\n"
                  "Every result is a file below DIR/cases, whole or not there: what was interrupted goes on with --resume.");
  command->add_option("CAMPAIGN", o->campaign, "campaign file (TOML)");
  command->add_option("-o,--output", o->folder, "folder for the report and results")->capture_default_str();
  command->add_option("-j,--jobs", o->jobs, "simulations at a time (default: the machine's cores)")->check(CLI::Range(1, 1024));
  command->add_option("--only", o->only, "one case of the report by its name, with all that it needs");
  command->add_flag("--static", o->statics,
                    "wave speeds without time steps: static moduli and Bloch limits of the strip's materials, in seconds; no waves, studies,\n"
                    "finite elements or [[case]]");
  command->add_option("--baseline", o->baseline, "a file of ddem baseline update: what got worse beyond its noise is REGRESSED");
  command->add_option("--history", o->history, "folder that gets one file of this run, and whose trends the report draws; see ddem history");
  command->add_option("--shard", o->shard,
                      "i/n: the units k of the campaign with k mod n = i - 1, into a folder of their own; then: ddem merge");
  command->add_flag("--plan", o->plan, "write DIR/plan.json, the list of all units with their identities, and run nothing");
  command->add_flag("--resume", o->resume,
                    "go on with an interrupted campaign: keep the results in the folder that are whole and of the same inputs and program");
  command->callback([o, &action] { action = [o] { return run(*o); }; });
}

}  // namespace ddem::harness
