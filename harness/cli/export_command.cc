// ddem export SCENE.toml -o DIR [--format protocol|lammps]
#include <fmt/format.h>

#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/scene_argument.h"
#include "harness/io/claim_outputs.h"
#include "harness/io/errors.h"
#include "harness/io/message.h"
#include "harness/model/assemble.h"
#include "harness/run/dem_run.h"
#include "harness/scene/place.h"
#include "harness/solvers/exchange.h"
#include "harness/solvers/lammps_ddem.h"

namespace ddem::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDrive = "drive.csv";

struct ExportOptions {
  std::string scene, folder, format = "protocol";
  bool force = false;
};

std::vector<std::string> files_of(bool lammps) {
  if (!lammps) return {"scene.json", "discs.csv", "bonds.csv", "receivers.csv", kDrive};
  std::vector<std::string> names{kLammpsData, kLammpsScript};
  names.insert(names.end(), std::begin(kLammpsInitial), std::end(kLammpsInitial));
  return names;
}

int run(const ExportOptions& o) {
  const Scene scene = load_scene(o.scene, Purpose::simulation);
  if (scene.time.integrator == Integrator::exact) {
    throw InputError(scene_problem(scene, "time.integrator", "exact signals are made without time steps, and there are none to hand on",
                                   "use integrator = \"verlet\""));
  }
  claim_folder(o.folder);
  const fs::path folder = o.folder;
  std::vector<Output> outputs;
  const bool lammps = o.format == "lammps";
  for (const std::string& name : files_of(lammps)) outputs.push_back({folder / name, OutputKind::exchange});
  const bool something_there = std::ranges::any_of(outputs, [](const Output& output) { return fs::exists(output.path); });
  claim_outputs(outputs, files_read_by(scene), o.force && something_there);
  const PreparedRun prepared = prepare_run(scene, build_assembly(scene));
  for (const std::string& warning : prepared.run.warnings) message("ddem: warning: {}", warning);
  std::vector<std::string> receivers;
  for (const Probe& p : prepared.run.layout.probes) receivers.push_back(p.name);
  const Exchange exchange{prepared.run.assembly, prepared.input, receivers, scene.title};
  if (!lammps && !prepared.input.drive) fs::remove(folder / kDrive);  // of another scene
  if (lammps) write_lammps_ddem(folder, exchange);
  else write_exchange(folder, exchange);
  fmt::print("{}: {} discs, {} bonds, {} receivers; {} steps of {:.6g} s\n", o.folder, prepared.run.assembly.size(), prepared.run.assembly.bonds.size(),
             receivers.size(), prepared.input.steps, prepared.input.time_step);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_export_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "A scene as plain files that any solver can read: discs, bonds, receivers, steps");
  command->footer("Example: ddem export bar.toml -o bar\n"
                  "Writes scene.json, discs.csv, bonds.csv, receivers.csv, and drive.csv where an edge is driven. A solver leaves\n"
                  "signals.csv, which ddem measure judges; see harness/guide/solvers.md. --format lammps writes in.strip and\n"
                  "strip.data instead, and the discs that are displaced at first.");
  command->add_option("SCENE", o->scene, "scene file (TOML)")->required();
  command->add_option("-o,--output", o->folder, "folder for the files; made where it is missing")->required();
  command->add_option("--format", o->format, "protocol: for any solver; lammps: a script and data for ddem-lammps, see harness/guide/lammps.md")
      ->check(CLI::IsMember({"protocol", "lammps"}))
      ->capture_default_str();
  command->add_flag("--force", o->force, "replace files, too, that ddem did not write");
  command->callback([o, &action] { action = [o] { return run(*o); }; });
}

}  // namespace ddem::harness
