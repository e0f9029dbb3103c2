// ddem report DIR
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "harness/campaign/report_file.h"
#include "harness/cli/campaign_folder.h"
#include "harness/cli/commands.h"
#include "harness/io/errors.h"

namespace ddem::harness {
namespace {

struct ReportOptions {
  std::string folder, output;
  bool force = false;
};

int run(const ReportOptions& o) {
  const reports::Report report = load_report(o.folder);
  const std::string& output = o.output.empty() ? o.folder : o.output;
  std::error_code ignored;
  if (!std::filesystem::equivalent(output, o.folder, ignored)) check_drawable(output, report, o.force);
  try {
    write_report_files(output, draw_report(report));
  } catch (const std::invalid_argument& e) {  // what cannot be drawn was not written by ddem
    throw InputError(
        fmt::format("{}/results.h5: damaged: {}; run `ddem validate` again", o.folder, e.what()));
  }
  fmt::print("report: {}/report.html\n", output);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<ReportOptions>();
  CLI::App* command =
      app.add_subcommand("report", "Draw the report of a finished campaign again, from its results.h5 alone");
  command->footer(
      "Example: ddem report ddem-report -o redrawn\n"
      "Writes report.html, figures/*.svg and figures/*.csv. Runs nothing, and changes nothing unless "
      "results.h5 is whole.");
  command->add_option("DIR", o->folder, "folder that `ddem validate` wrote")->required();
  CLI::Option* output = command->add_option("-o,--output", o->output, "another folder for what is drawn (default: DIR)");
  command->add_flag("--force", o->force, "draw over the report of another campaign")->needs(output);
  command->callback([o, &action] { action = [o] { return run(*o); }; });
}

}  // namespace ddem::harness
