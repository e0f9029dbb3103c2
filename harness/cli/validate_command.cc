// ddem validate [CAMPAIGN.toml]
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "harness/campaign/planned_campaign.h"
#include "harness/campaign/read_campaign.h"
#include "harness/campaign/reproduce.h"
#include "harness/campaign/write_results.h"
#include "harness/cli/campaign_folder.h"
#include "harness/cli/campaign_output.h"
#include "harness/cli/commands.h"
#include "harness/cli/print_json.h"
#include "harness/io/errors.h"
#include "harness/io/folder_lock.h"
#include "harness/io/message.h"
#include "harness/io/progress.h"
#include "harness/nightly/unit_file.h"
#include "harness/solvers/find_solver.h"
#include "reports/text.h"

namespace ddem::harness {
namespace {

constexpr const char* kStatics = "statics";  // the study

struct ValidateOptions {
  std::string campaign, folder = "ddem-report", shard, only, baseline, history, solver = "builtin";
  int jobs = 0;
  std::optional<int> ranks;
  bool resume = false, plan = false, list = false, json = false, statics = false, force = false, partial = false;
};

CampaignSpec spec_from(const ValidateOptions& o) {
  CampaignSpec spec = o.campaign.empty() ? default_campaign() : read_campaign(o.campaign);
  spec.only = o.only;
  if (o.solver != builtin_solver().name()) spec.solver = o.solver;
  spec.ranks = o.ranks.value_or(0);
  if (o.campaign.empty() && !spec.solver.empty()) spec.tables["solvers"] = {{"names", {spec.solver}}};  // beside the built-in one, too
  if (!o.statics) return spec;
  if (!spec.has("strip")) throw InputError(o.campaign + ": no [strip]: --static is for its moduli; for those of a scene: ddem moduli SCENE.toml");
  if (!o.only.empty() && !o.only.starts_with("static")) {
    throw InputError("--only " + o.only + ": steps in time, which --static leaves out; its cases are static/..., such as static/random/dem/kt0.30");
  }
  if (o.only.empty()) spec.only = kStatics;
  return spec;
}

/// A run that goes on, or shares a plan with others, must have the very plan; one that starts anew must not cost the report
/// of another campaign.
void settle_plan(const ValidateOptions& o, const nightly::Plan& plan) {
  if (nightly::holds_plan(o.folder, plan) && (o.resume || !o.shard.empty())) return;
  if (nightly::has_plan(o.folder) && (o.resume || !o.shard.empty()) && !o.force) {
    throw InputError(fmt::format("{}: holds another campaign: {}; give another folder by -o, or --force: results that still fit are kept",
                                 o.folder, nightly::difference(nightly::read_plan(o.folder), plan)));
  }
  check_replaceable(o.folder, plan, o.force);
  nightly::write_plan(o.folder, plan);
}

/// What goes on with this run.
std::string resume_command(const ValidateOptions& o, const CampaignSpec& spec) {
  std::string command = validate_command(spec, o.campaign, spec.only);
  const auto add = [&command](const char* option, const std::string& value) {
    if (!value.empty()) command += fmt::format(" {} {}", option, shell_word(value));
  };
  add("--shard", o.shard);
  add("--baseline", o.baseline);
  if (o.partial) command += " --partial";
  add("--history", o.history);
  add("-o", o.folder);
  return command + " --resume";
}

/// Over what is left of the bar.
void say_how_to_go_on(const ValidateOptions& o, const CampaignSpec& spec) {
  wipe_progress();
  message("interrupted; what is done is kept, go on with: {}", resume_command(o, spec));
}

/// A full disk ends a run as an interruption does.
CampaignResults run_or_say_how_to_go_on(const PlannedCampaign& campaign, const nightly::RunOptions& options, const std::function<void()>& say) {
  try {
    return campaign.run(options);
  } catch (const MachineError&) {
    say();
    throw;
  }
}

int end_of_shard(const ValidateOptions& o, const CampaignResults& results, std::size_t units) {
  std::size_t errors = 0;
  for (const auto& [id, reason] : results.failed_units) {
    const bool skipped = nightly::was_skipped(reason);
    fmt::print("{}: {}: {}\n", skipped ? "SKIPPED" : "ERROR", id, reports::clean_utf8(nightly::reason_of(reason)));
    errors += skipped ? 0 : 1;
  }
  fmt::print("shard {}: {} units, {} without a result; when all shards are there: ddem merge DIR... -o DIR\n", o.shard, units,
             results.failed_units.size());
  return static_cast<int>(errors == 0 ? ExitCode::done : ExitCode::verdict_failed);
}

Json json_of(const std::vector<StudyListing>& listed) {
  Json list = Json::array();
  for (const StudyListing& s : listed) list.push_back({{"id", s.id}, {"title", s.title}, {"needs", s.needs}, {"cases", s.cases}, {"seconds", s.seconds}});
  return {{"studies", list}};
}

/// What there is, what it needs, and how long it takes on this machine.
int list(const ValidateOptions& o) {
  std::vector<StudyListing> listed = list_studies(spec_from(o), {});
  const double cores = std::max(1u, std::thread::hardware_concurrency());
  for (StudyListing& s : listed) s.seconds /= cores;
  if (o.json) {
    print_json(json_of(listed));
    return static_cast<int>(ExitCode::done);
  }
  for (const StudyListing& s : listed) {
    fmt::print("{}  {}; about {:.1f} s{}\n", s.id, s.title, s.seconds, s.needs.empty() ? "" : fmt::format("; needs units of {}", fmt::join(s.needs, ", ")));
    for (const std::string& id : s.cases) fmt::print("    {}\n", id);
  }
  return static_cast<int>(ExitCode::done);
}

int run(const ValidateOptions& o) {
  const nightly::Shard shard = o.shard.empty() ? nightly::Shard{} : nightly::parse_shard(o.shard);
  const CampaignSpec spec = spec_from(o);
  const std::shared_ptr<const Solver> solver = find_solver(o.solver, o.ranks);
  if (!o.shard.empty() && (!o.baseline.empty() || !o.history.empty())) {
    throw InputError("--shard makes a part only: give --baseline and --history to ddem merge");
  }
  Conclusion conclusion{o.folder, {}, o.partial, o.history};
  if (!o.baseline.empty()) conclusion.baseline = nightly::read_baseline(o.baseline);
  require_apart(o.folder, o.history);
  std::optional<Progress> progress;
  CampaignOptions options;
  options.solver = solver.get();
  options.on_progress = [&](std::size_t done) { progress->advance(done); };
  const PlannedCampaign campaign(spec, options, o.campaign);
  const nightly::Plan& plan = campaign.plan();
  prepare_folder(o.folder);
  if (!o.history.empty()) prepare_folder(o.history);
  const FolderLock lock(o.folder);

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
    const CampaignResults results = run_or_say_how_to_go_on(campaign, run, [&] { say_how_to_go_on(o, spec); });
    progress.reset();
    return o.shard.empty() ? conclude_campaign(campaign, results, conclusion) : end_of_shard(o, results, shard.size(plan.units.size()));
  };
  const auto give_up = [&](std::size_t unit, const std::string& reason) {
    message("{}: {}", plan.units[unit].id, reason);
    nightly::write_unit(o.folder, {plan.units[unit].id, plan.units[unit].identity, {nullptr, reason}});
    run.given_up.push_back(unit);
  };
  return nightly::supervise(board, work, give_up, [&] { say_how_to_go_on(o, spec); });
}

}  // namespace

void add_validate_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<ValidateOptions>();
  CLI::App* command = app.add_subcommand("validate", "Run a campaign and judge it: writes report.html, results.h5, summary.json, junit.xml");
  command->footer("Without a file: the strip of the paper, k_t/k_n = 0, 0.1 .. 1, DEM and DDEM, bar, shear and P waves,\n"
                  "hexagonal and random, against static moduli, closed forms and finite elements. Exit code 1 if a verdict fails.\n"
                  "A campaign file has [strip] (see harness/campaigns/strip.toml), or [[case]] for scenes of your own\n"
                  "(see harness/campaigns/cases.toml), or both.\n"
                  "Every result is a file below DIR/cases, whole or not there: what was interrupted goes on with --resume.\n"
                  "The report of another campaign is never replaced without --force.");
  command->add_option("CAMPAIGN", o->campaign, "campaign file (TOML)");
  CLI::Option* output = command->add_option("-o,--output", o->folder, "folder for the report and results")->capture_default_str();
  CLI::Option* jobs = command->add_option("-j,--jobs", o->jobs, "simulations at a time (default: the machine's cores)")->check(CLI::Range(1, 1024));
  command->add_option("--only", o->only, "a study, a case of the report, or what the names of cases begin with (see --list): with all that it needs, and nothing else");
  command->add_flag("--static", o->statics,
                    "wave speeds without time steps: static moduli and Bloch limits of the strip's materials, in seconds; no waves, studies,\n"
                    "finite elements or [[case]]");
  CLI::Option* solver = command->add_option("--solver", o->solver, kSolverHelp)->capture_default_str();
  CLI::Option* ranks = command->add_option("--ranks", o->ranks, kRanksHelp)->check(CLI::Range(1, 100000));
  CLI::Option* baseline = command->add_option("--baseline", o->baseline, "a file of ddem baseline update: what got worse beyond its noise is REGRESSED");
  CLI::Option* history = command->add_option("--history", o->history, "folder that gets one file of this run, and whose trends the report draws; see ddem history");
  CLI::Option* shard = command->add_option("--shard", o->shard,
                      "i/n: the units k of the campaign with k mod n = i - 1, into a folder of their own; then: ddem merge");
  CLI::Option* partial = command->add_flag("--partial", o->partial, kPartialHelp);
  CLI::Option* force = command->add_flag("--force", o->force, kForceHelp);
  partial->needs(baseline);
  CLI::Option* plan = command->add_flag("--plan", o->plan, "write DIR/plan.json, the list of all units with their identities, and run nothing");
  plan->excludes(jobs)->excludes(baseline)->excludes(history)->excludes(partial);
  CLI::Option* resume = command->add_flag("--resume", o->resume,
                    "go on with an interrupted campaign: keep the results in the folder that are whole and of the same inputs and program");
  plan->excludes(resume);
  CLI::Option* list_option = command->add_flag("--list", o->list, "say which studies and cases there are, what each needs and about how long it takes; run nothing");
  for (CLI::Option* of_a_run : {output, plan, resume, jobs, solver, ranks, baseline, history, shard, force, partial}) list_option->excludes(of_a_run);
  command->add_flag("--json", o->json, "with --list: as JSON")->needs(list_option);
  command->callback([o, &action] { action = [o] { return o->list ? list(*o) : run(*o); }; });
}

}  // namespace ddem::harness
