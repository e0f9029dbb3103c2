// ddem run SCENE.toml
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/output.h"
#include "harness/cli/print_json.h"
#include "harness/cli/run_hdf5.h"
#include "harness/cli/run_summary.h"
#include "harness/cli/run_xdmf.h"
#include "harness/cli/scene_argument.h"
#include "harness/cli/xdmf.h"
#include "harness/io/atomic_file.h"
#include "harness/io/claim_outputs.h"
#include "harness/io/errors.h"
#include "harness/io/message.h"
#include "harness/io/progress.h"
#include "harness/run/run_json.h"
#include "harness/solvers/find_solver.h"

namespace ddem::harness {
namespace {

struct RunCommandOptions {
  std::string scene, hdf5, csv, solver = "builtin";
  std::optional<int> snapshots, ranks;
  bool json = false, force = false;
};

constexpr std::size_t kProgressUnits = 200;
constexpr int kEnergySamples = 200;

/// On standard error, that nobody takes a run with new contacts for one of bonds alone.
void tell_of_contacts(const DemRun& run) {
  if (const auto& c = run.result.new_contacts) {
    message("ddem: new contacts from step {} on (t = {:.4g} s), {} at once at most", c->first_step,
            static_cast<double>(c->first_step) * run.time_step, c->most);
  }
}

int run(const RunCommandOptions& o) {
  const Scene scene = load_scene(o.scene, Purpose::simulation);
  const std::string xdmf = o.hdf5.empty() || !o.snapshots ? std::string() : xdmf_path(o.hdf5).string();
  claim_outputs({{o.hdf5, OutputKind::run_hdf5}, {o.csv, OutputKind::signals_csv}, {xdmf, OutputKind::xdmf}}, files_read_by(scene),
                o.force);
  const std::shared_ptr<const Solver> solver = find_solver(o.solver, o.ranks);
  const bool snapshots = solver->abilities().snapshots && scene.time.integrator != Integrator::exact;
  Progress progress(kProgressUnits);
  std::size_t shown = 0;
  RunOptions options;
  options.on_stage = [&](std::string stage) { progress.set_label(std::move(stage)); };
  options.on_progress = [&](double done) {
    const auto units = static_cast<std::size_t>(done * kProgressUnits);
    if (units > shown) progress.advance(units - std::exchange(shown, units));
    return true;
  };
  if (!o.hdf5.empty()) {
    options.snapshots = o.snapshots.value_or(snapshots ? 1 : 0);
    options.energy_samples = kEnergySamples;
  }
  options.solver = solver.get();
  options.as_text = !o.csv.empty();
  const DemRun run = run_scene(scene, options);
  for (const std::string& warning : run.warnings) message("ddem: warning: {}", warning);
  tell_of_contacts(run);
  if (run.result.breakdown) {
    if (o.json) print_json(run_json(run));
    const Breakdown& b = *run.result.breakdown;
    const BreakdownText text = describe(b, scene);
    throw SolverError(fmt::format("{}: {} at step {} (t = {:.4g} s), disc {}; {}", o.scene, text.what, b.step,
                                  static_cast<double>(b.step) * run.time_step, b.disc, text.advice));
  }
  SignalTable table;
  const Signals& s = run.result.signals;
  table.time = s.time;
  for (std::size_t p = 0; p < run.layout.probes.size(); ++p) add_probe(table, run.layout.probes[p].name, s.ux[p], s.uy[p], &s.theta[p]);
  write_outputs(o.hdf5, o.csv, table, scene, [&](Hdf5Group& root) {
    write_energy_and_fields(root, run);
    if (!xdmf.empty()) write_points(root, run);
  });
  if (!xdmf.empty()) write_file(xdmf, xdmf_text(run, std::filesystem::path(o.hdf5).filename().string()));
  if (o.json) {
    print_json(run_json(run));
  } else {
    print_steps(run, scene);
    if (run.measurement) print_speeds(*run.measurement, run.layout);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<RunCommandOptions>();
  CLI::App* command = app.add_subcommand("run", "One DEM or DDEM simulation of a scene");
  command->footer("Example: ddem run bar.toml --signals bar.csv\nScenes to start from: harness/scenes/*.toml");
  command->add_option("SCENE", o->scene, "scene file (TOML)")->required();
  CLI::Option* output = command->add_option("-o,--output", o->hdf5, "write signals, energies, fields, scene and provenance to this HDF5 file");
  command->add_option("--snapshots", o->snapshots,
                      "fields of all discs at so many times, the last at the end (1; none with integrator = \"exact\"); with -o FILE.h5 "
                      "also FILE.xdmf, for ParaView")
      ->check(CLI::Range(1, 10000))
      ->needs(output);
  command->add_option("--signals", o->csv, "write the probes' signals to this CSV file");
  command->add_option("--solver", o->solver, kSolverHelp)->capture_default_str();
  command->add_option("--ranks", o->ranks, kRanksHelp)->check(CLI::Range(1, 100000));
  command->add_flag("--force", o->force, "replace files, too, that ddem did not write");
  command->add_flag("--json", o->json, "print the result as JSON");
  command->callback([o, &action] { action = [o] { return run(*o); }; });
}

}  // namespace ddem::harness
