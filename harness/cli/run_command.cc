// ddem run SCENE.toml
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/output.h"
#include "harness/cli/run_hdf5.h"
#include "harness/cli/run_xdmf.h"
#include "harness/cli/scene_argument.h"
#include "harness/cli/xdmf.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/io/progress.h"
#include "harness/run/run_json.h"

namespace ddem::harness {
namespace {

struct Options {
  std::string scene, hdf5, csv;
  std::optional<int> snapshots;
  bool json = false;
};

constexpr std::size_t kProgressUnits = 200;
constexpr int kEnergySamples = 200;

void print_summary(const DemRun& run) {
  const SimulationResult& r = run.result;
  fmt::print("{} discs, {} bonds; {} steps of {:.4g} s ({:.3g} of the critical {:.4g} s) in {:.3g} s\n", run.assembly.size(),
             run.assembly.bonds.size(), r.steps_done, run.time_step, run.time_step / run.critical_time_step,
             run.critical_time_step, r.wall_seconds);
  if (r.energy_drift) fmt::print("energy drift {:.3g}\n", *r.energy_drift);
  if (!run.measurement) return;
  for (const PairSpeed& p : run.measurement->speed.pairs) {
    const std::string pair = fmt::format("{} to {}, {:.4g} mm", run.layout.probes[p.from].name, run.layout.probes[p.to].name, p.distance * 1e3);
    if (p.speed.ok()) {
      fmt::print("  {}: {:.5g} us, {:.5g} m/s\n", pair, p.delay.value() * 1e6, p.speed.value());
    } else {
      fmt::print("  {}: no velocity: {}\n", pair, p.speed.error().reason);
    }
  }
  const auto& speed = run.measurement->speed.speed;
  if (speed.ok()) {
    fmt::print("wave speed {:.5g} m/s, standard deviation {:.2g} m/s over {} pairs\n", speed.value().mean,
               speed.value().stddev.value_or(0.0), run.measurement->speed.good_pairs);
  } else {
    fmt::print("no wave speed: {}\n", speed.error().reason);
  }
}

/// On standard error, that nobody takes a run with new contacts for one of bonds alone.
void tell_of_contacts(const DemRun& run) {
  if (const auto& c = run.result.new_contacts) {
    fmt::print(stderr, "ddem: new contacts from step {} on (t = {:.4g} s), {} at once at most\n", c->first_step,
               static_cast<double>(c->first_step) * run.time_step, c->most);
  }
}

int run(const Options& o) {
  const Scene scene = load_scene(o.scene, Purpose::simulation);
  const std::string xdmf = o.hdf5.empty() || !o.snapshots ? std::string() : xdmf_path(o.hdf5).string();
  check_outputs({o.hdf5, o.csv, xdmf}, scene);
  Progress progress(kProgressUnits, "simulating");
  std::size_t shown = 0;
  RunOptions options;
  options.on_progress = [&](double done) {
    const auto units = static_cast<std::size_t>(done * kProgressUnits);
    if (units > shown) progress.advance(units - std::exchange(shown, units));
    return true;
  };
  if (!o.hdf5.empty()) {
    options.snapshots = o.snapshots.value_or(scene.time.integrator == Integrator::exact ? 0 : 1);
    options.energy_samples = kEnergySamples;
  }
  const DemRun run = run_scene(scene, options);
  for (const std::string& warning : run.warnings) fmt::print(stderr, "ddem: warning: {}\n", warning);
  tell_of_contacts(run);
  if (o.json) fmt::print("{}", to_text(run_json(run)));
  if (run.result.breakdown) {
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
  if (!o.json) print_summary(run);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("run", "One DEM or DDEM simulation of a scene");
  command->footer("Example: ddem run bar.toml --signals bar.csv\nScenes to start from: harness/scenes/*.toml");
  command->add_option("SCENE", o->scene, "scene file (TOML)")->required();
  command->add_option("-o,--output", o->hdf5, "write signals, energies, fields, scene and provenance to this HDF5 file");
  command->add_option("--snapshots", o->snapshots,
                      "fields of all discs at so many times, the last at the end (1; none with integrator = \"exact\"); with -o FILE.h5 "
                      "also FILE.xdmf, for ParaView")
      ->check(CLI::Range(1, 10000));
  command->add_option("--signals", o->csv, "write the probes' signals to this CSV file");
  command->add_flag("--json", o->json, "print the result as JSON");
  command->callback([o, &action] { action = [o] { return run(*o); }; });
}

}  // namespace ddem::harness
