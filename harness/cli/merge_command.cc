// ddem merge DIR ... -o DIR
#include <fmt/format.h>

#include <memory>

#include "harness/campaign/write_results.h"
#include "harness/cli/campaign_folder.h"
#include "harness/cli/campaign_output.h"
#include "harness/cli/commands.h"
#include "harness/io/folder_lock.h"
#include "harness/io/message.h"
#include "harness/nightly/merge.h"

namespace ddem::harness {
namespace {

struct MergeOptions {
  std::vector<std::string> folders;
  std::string target, baseline, history;
  bool force = false, partial = false;
};

int merge(const MergeOptions& o) {
  require_distinct(o.folders, o.target);
  Conclusion conclusion{o.target, {}, o.partial, o.history};
  if (!o.baseline.empty()) conclusion.baseline = nightly::read_baseline(o.baseline);
  const std::string& target = o.target;
  require_apart(target, o.history);
  prepare_folder(target);
  if (!o.history.empty()) prepare_folder(o.history);
  const FolderLock lock(target);
  const std::vector<std::filesystem::path> folders(o.folders.begin(), o.folders.end());
  check_replaceable(target, nightly::read_plan(folders.front()), o.force);
  const nightly::MergeReport merged = nightly::merge_folders(folders, target, true);
  for (const std::string& file : merged.refused) message("not used: {}", file);
  for (const std::string& unit : merged.missing) message("missing: {}", unit);
  const PlannedCampaign campaign = PlannedCampaign::of_folder(target);
  return conclude_campaign(campaign, campaign.read(target), conclusion);
}

}  // namespace

void add_merge_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<MergeOptions>();
  CLI::App* command =
      app.add_subcommand("merge", "Join the folders of a campaign's shards, then judge and report it");
  command->footer(
      "The folders may overlap, and come in any order. What no folder has is named, and is an ERROR in the "
      "report;\n"
      "results that contradict each other are named, and nothing is written. Exit code 1 if a verdict "
      "fails.\n"
      "  ddem validate --shard 1/2 -o a; ddem validate --shard 2/2 -o b; ddem merge a b -o night");
  command->add_option("DIR", o->folders, "folders")->required()->expected(1, -1);
  command->add_option("-o,--output", o->target, "folder for what they make together")->required();
  CLI::Option* baseline = command->add_option("--baseline", o->baseline,
                                              "a file of ddem baseline update: what got worse beyond its noise is REGRESSED");
  command->add_option("--history", o->history, "folder that gets one file of this run, and whose trends the report draws; see ddem history");
  command->add_flag("--partial", o->partial, kPartialHelp)->needs(baseline);
  command->add_flag("--force", o->force, kForceHelp);
  command->callback([o, &action] { action = [o] { return merge(*o); }; });
}

}  // namespace ddem::harness
