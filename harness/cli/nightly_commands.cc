// ddem baseline, compare, history: a run against what was before it.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/cli/commands.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/nightly/baseline.h"
#include "harness/nightly/history.h"

namespace ddem::harness {
namespace {

struct BaselineOptions {
  std::vector<std::string> folders;
  std::string file = "ddem-baseline.json";
};

int update_baseline(const BaselineOptions& o) {
  std::vector<std::vector<reports::Verdict>> nights;
  for (const std::string& folder : o.folders) nights.push_back(nightly::read_summary(folder).verdicts);
  std::vector<std::string> left_out;
  const nightly::Baseline baseline = nightly::baseline_of(nights, left_out);
  for (const std::string& key : left_out) fmt::print("left out, it did not pass: {}\n", key);
  if (baseline.empty()) throw InputError("nothing that passed: no baseline is written");
  write_file(o.file, nightly::baseline_text(baseline));
  fmt::print("{}: {} metrics of {} run{}\n", o.file, baseline.size(), nights.size(),
             nights.size() == 1 ? "" : "s");
  return static_cast<int>(ExitCode::done);
}

int compare(const std::string& folder, const std::string& baseline) {
  std::vector<reports::Verdict> verdicts = nightly::read_summary(folder).verdicts;
  fmt::print("{}", nightly::comparison_text(nightly::compare(verdicts, nightly::read_baseline(baseline))));
  const bool failed = std::any_of(verdicts.begin(), verdicts.end(),
                                  [](const auto& v) { return reports::is_failure(v.state); });
  return static_cast<int>(failed ? ExitCode::verdict_failed : ExitCode::done);
}

int history(const std::string& folder, bool regressions, bool all) {
  const std::vector<nightly::Night> nights = nightly::read_history(folder);
  const std::vector<nightly::Trend> trends = nightly::trends_of(nights);
  fmt::print("{}", nightly::trends_text(nights, trends, all));
  const bool worse = std::any_of(trends.begin(), trends.end(), [](const nightly::Trend& t) {
    return t.regressed || reports::is_failure(t.state);
  });
  return static_cast<int>(regressions && worse ? ExitCode::verdict_failed : ExitCode::done);
}

}  // namespace

void add_baseline_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<BaselineOptions>();
  CLI::App* command = app.add_subcommand("baseline", "What each metric was on runs that somebody looked at");
  command->require_subcommand(1);
  CLI::App* update =
      command->add_subcommand("update", "Write a baseline from the folders of one or more runs");
  update->footer(
      "A sorted text file with a line a metric: its median over the runs, and as noise the largest distance "
      "from it, at least\n"
      "round-off and 1 % of the accuracy band. Nothing else writes a baseline: keep it under version "
      "control, and read the change.");
  update->add_option("DIR", o->folders, "folders of runs, as ddem validate -o makes them")
      ->required()
      ->expected(1, -1);
  update->add_option("-o,--output", o->file, "the baseline")->capture_default_str();
  update->callback([o, &action] { action = [o] { return update_baseline(*o); }; });
}

void add_compare_command(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>(), baseline = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("compare", "A run against a baseline, or against another run");
  command->footer(
      "REGRESSED: inside the accuracy band, but further from right than the baseline by more than its "
      "noise.\n"
      "Exit code 1 if a metric regressed or a verdict fails.");
  command->add_option("DIR", *folder, "folder of a run")->required();
  command->add_option("BASELINE", *baseline, "a baseline's file, or the folder of an earlier run")
      ->required();
  command->callback(
      [folder, baseline, &action] { action = [folder, baseline] { return compare(*folder, *baseline); }; });
}

void add_history_command(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>();
  auto regressions = std::make_shared<bool>(false), all = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("history", "The last night against the 4, 20 and 100 nights before it");
  command->footer(
      "Nights come from ddem validate --history DIR. Each metric is compared with the median of the nights "
      "before; what is\n"
      "within three standard deviations of their scatter, or 1 % of its accuracy band, is no change; 20 % of "
      "a wall time.");
  command->add_option("DIR", *folder, "folder of nights")->required();
  command->add_flag("--regressions", *regressions,
                    "exit code 1 if a metric got worse, or the last night failed");
  command->add_flag("--all", *all, "a line for every metric");
  command->callback([folder, regressions, all, &action] {
    action = [folder, regressions, all] { return history(*folder, *regressions, *all); };
  });
}

}  // namespace ddem::harness
