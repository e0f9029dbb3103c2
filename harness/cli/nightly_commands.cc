// ddem baseline, compare, history: a run against what was before it.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <memory>

#include "harness/campaign/report_file.h"
#include "harness/cli/campaign_output.h"
#include "harness/cli/commands.h"
#include "harness/cli/print_json.h"
#include "harness/io/atomic_file.h"
#include "harness/io/claim_outputs.h"
#include "harness/io/errors.h"
#include "harness/io/message.h"
#include "harness/nightly/comparison.h"
#include "harness/nightly/history.h"
#include "harness/nightly/history_page.h"
#include "reports/text.h"

namespace ddem::harness {
namespace {

struct BaselineOptions {
  std::vector<std::string> folders;
  std::string file = "ddem-baseline.json";
  bool force = false;
};

int update_baseline(const BaselineOptions& o) {
  std::vector<std::filesystem::path> inputs;
  for (const std::string& folder : o.folders) inputs.push_back(std::filesystem::path(folder) / "summary.json");
  claim_outputs({{o.file, OutputKind::baseline}}, inputs, o.force);
  std::vector<std::vector<reports::Verdict>> nights;
  for (const std::string& folder : o.folders) nights.push_back(nightly::read_summary(folder).verdicts);
  std::vector<std::string> left_out;
  const nightly::Baseline baseline = nightly::baseline_of(nights, left_out);
  if (!baseline.empty()) write_file(o.file, nightly::baseline_text(baseline));
  for (const std::string& key : left_out) fmt::print("left out, it did not pass: {}\n", reports::clean_utf8(key));
  if (baseline.empty()) throw InputError("nothing that passed: no baseline is written");
  fmt::print("{}: {} metrics of {} run{}\n", o.file, baseline.size(), nights.size(),
             nights.size() == 1 ? "" : "s");
  return static_cast<int>(ExitCode::done);
}

struct CompareOptions {
  std::string folder, baseline;
  bool partial = false, json = false;
};

int compare(const CompareOptions& o) {
  std::vector<reports::Verdict> verdicts = nightly::read_summary(o.folder).verdicts;
  const nightly::Selected none = [](const std::string&) { return false; };
  const auto comparisons = nightly::compare(verdicts, nightly::read_baseline(o.baseline), o.partial ? none : nightly::Selected{});
  if (o.json)
    print_json(nightly::comparison_json(comparisons));
  else
    fmt::print("{}", reports::clean_utf8(nightly::comparison_text(comparisons)));
  const bool nothing = nightly::measured_nothing(comparisons);
  if (nothing) message("{}: not one metric was measured: nothing was compared", o.folder);
  const bool failed = std::any_of(verdicts.begin(), verdicts.end(),
                                  [](const auto& v) { return reports::is_failure(v.state); });
  return static_cast<int>(failed || nothing ? ExitCode::verdict_failed : ExitCode::done);
}

/// UTC, as nights have it.
std::string now() {
  const std::time_t seconds = std::time(nullptr);
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(seconds));
}

/// On standard error: whoever put them there may have meant them.
void tell_of_other_files(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& file : nightly::files_beside_nights(folder)) names.push_back(file.filename().string());
  if (!names.empty()) message("{}: not called as nights, left alone: {}", folder, fmt::join(names, ", "));
}

struct HistoryOptions {
  std::string folder, page;
  bool regressions = false, all = false, force = false;
};

/// No night is written over, nor becomes one by its name.
void claim_page(const HistoryOptions& o) {
  if (!o.page.ends_with(".html")) throw InputError(o.page + ": a page is HTML; give a name that ends in .html");
  std::vector<std::filesystem::path> nights;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(o.folder, error)) nights.push_back(entry.path());
  claim_outputs({{o.page, OutputKind::report}}, nights, o.force);
}

/// A report of something else stays, unless that is asked for.
void require_same_page(const HistoryOptions& o, const std::vector<nightly::Night>& nights) {
  std::error_code error;
  if (o.force || !std::filesystem::exists(o.page, error) || std::filesystem::file_size(o.page, error) == 0) return;
  if (reports::marked_campaign(read_file(o.page)) != campaign_mark(nightly::history_page(nights)))
    throw InputError(o.page + ": is the report of something else; name another file, or give --force to replace it");
}

int history(const HistoryOptions& o) {
  if (!o.page.empty()) claim_page(o);
  tell_of_other_files(o.folder);
  const std::vector<nightly::Night> nights = nightly::read_history(o.folder);
  if (!o.page.empty()) require_same_page(o, nights);
  const std::vector<nightly::Trend> trends = nightly::trends_of(nights);
  fmt::print("{}", reports::clean_utf8(nightly::trends_text(nights, trends, o.all)));
  for (const std::string& complaint : nightly::clock_complaints(nights, now())) fmt::print("{}\n", reports::clean_utf8(complaint));
  const bool worse = std::any_of(trends.begin(), trends.end(), [](const nightly::Trend& t) {
    return t.regressed || reports::is_failure(t.state);
  });
  if (!o.page.empty()) {
    write_file(o.page, draw_page(nightly::history_page(nights)));
    fmt::print("report: {}\n", o.page);
  }
  return static_cast<int>(o.regressions && worse ? ExitCode::verdict_failed : ExitCode::done);
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
  update->add_flag("--force", o->force, "replace a file, too, that ddem did not write");
  update->callback([o, &action] { action = [o] { return update_baseline(*o); }; });
}

void add_compare_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand("compare", "A run against a baseline, or against another run");
  command->footer(
      "REGRESSED: inside the accuracy band, but further from right than the baseline by more than its noise.\n"
      "MISSING: the baseline has it and the run has not, or in another unit.  NO_BASELINE: the run alone has it.\n"
      "Exit code 1 if a metric regressed or is missing, a verdict fails, or nothing at all was measured.");
  command->add_option("DIR", o->folder, "folder of a run")->required();
  command->add_option("BASELINE", o->baseline, "a baseline's file, or the folder of an earlier run")->required();
  command->add_flag("--partial", o->partial, kPartialHelp);
  command->add_flag("--json", o->json, "print metrics, states (how many of each) and all comparisons as JSON");
  command->callback([o, &action] { action = [o] { return compare(*o); }; });
}

void add_history_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<HistoryOptions>();
  CLI::App* command =
      app.add_subcommand("history", "The last night against the 4, 20 and 100 nights before it");
  command->footer(
      "Nights come from ddem validate --history DIR. Each metric is compared with the median of the nights "
      "before; what is\n"
      "within three standard deviations of their scatter, or 1 % of its accuracy band, is no change; 20 % "
      "of a wall time, or 0.3 s.");
  command->add_option("DIR", o->folder, "folder of nights")->required();
  command->add_flag("--regressions", o->regressions,
                    "exit code 1 if a metric got worse, or the last night failed");
  command->add_flag("--all", o->all, "a line for every metric");
  CLI::Option* page = command->add_option("--report", o->page, "a page of all nights: a tile a night, a line a metric, trends");
  command->add_flag("--force", o->force, "replace a file, too, that ddem did not write")->needs(page);
  command->callback([o, &action] { action = [o] { return history(*o); }; });
}

}  // namespace ddem::harness
