// ddem fem SCENE.toml
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/fem_fields.h"
#include "harness/cli/output.h"
#include "harness/cli/print_json.h"
#include "harness/cli/scene_argument.h"
#include "harness/cli/xdmf.h"
#include "harness/io/atomic_file.h"
#include "harness/io/claim_outputs.h"
#include "harness/io/errors.h"
#include "harness/io/message.h"
#include "harness/model/load.h"
#include "harness/run/load_limits.h"
#include "harness/run/run_json.h"

namespace ddem::harness {
namespace {

struct FemOptions {
  std::string scene, hdf5, csv;
  int snapshots = 0;
  bool json = false, force = false;
};

void print_summary(const FemPlan& plan, const FemResult& r, const std::optional<WaveMeasurement>& m) {
  fmt::print("degree {} on {} x {} elements, {} degrees of freedom; {} steps of {:.4g} s in {:.3g} s\n", r.degree, r.elements[0],
             r.elements[1], r.dofs, r.steps, r.time_step, r.solve_seconds);
  fmt::print("E = {:.6g} Pa, nu = {:.6g}, density {:.6g} kg/m3; analytical velocity {:.6g} m/s\n", plan.fem.material.young_modulus,
             plan.fem.material.poisson_ratio, plan.fem.material.density, plan.context.speed);
  if (!m) return;
  if (m->speed.speed.ok()) {
    fmt::print("wave speed {:.6g} m/s over {} pairs\n", m->speed.speed.value().mean, m->speed.good_pairs);
  } else {
    fmt::print("no wave speed: {}\n", m->speed.speed.error().reason);
  }
}

int run(const FemOptions& o) {
  const Scene scene = load_scene(o.scene, Purpose::continuum);
  const std::string xdmf = o.snapshots > 0 ? xdmf_path(o.hdf5).string() : std::string();
  claim_outputs({{o.hdf5, OutputKind::run_hdf5}, {o.csv, OutputKind::signals_csv}, {xdmf, OutputKind::xdmf}}, files_read_by(scene),
                o.force);
  if (o.snapshots > 0) check_snapshots(scene);
  std::optional<SceneModuli> moduli;
  if (needs_moduli(scene)) moduli = scene_moduli(scene);
  FemPlan plan = plan_fem(scene, moduli);
  plan.fem.snapshots = o.snapshots;
  const FemResult result = run_fem(std::span(&plan.fem, 1), {}, scene.run.threads).front();
  if (result.status != "ok") throw SolverError(o.scene + ": ddem-fem: " + result.status);

  std::vector<std::string> warnings;
  if (auto w = strain_warning(scene, plan.context, plan.fem.column_spacing)) warnings.push_back(std::move(*w));
  if (plan.fem.integrator == Integrator::verlet) {
    if (auto w = drive_warning(scene, result.time_step)) warnings.push_back(std::move(*w));
  }
  for (const std::string& warning : warnings) message("ddem: warning: {}", warning);
  const Wave wave = wave_of(scene).value();
  std::optional<WaveMeasurement> measurement;
  if (!plan.layout.pairs.empty()) measurement = measure_fem(plan, result, wave);
  SignalTable table;
  table.time = result.time;
  const auto& ux = plan.sections ? result.section_ux : result.point_ux;
  const auto& uy = plan.sections ? result.section_uy : result.point_uy;
  for (std::size_t p = 0; p < ux.size(); ++p) add_probe(table, "p" + std::to_string(p), ux[p], uy[p], nullptr);
  write_outputs(o.hdf5, o.csv, table, scene, [&](Hdf5Group& root) {
    if (!xdmf.empty()) write_fem_fields(root, result.fields);
  });
  if (!xdmf.empty()) write_file(xdmf, fem_xdmf_text(result.fields, std::filesystem::path(o.hdf5).filename().string()));
  if (o.json) {
    Json j = fem_json(plan, result, measurement);
    j["warnings"] = warnings;
    print_json(j);
  } else {
    print_summary(plan, result, measurement);
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_fem_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<FemOptions>();
  CLI::App* command = app.add_subcommand("fem", "The continuum model of a scene's strip: same load, same receivers");
  command->footer("E, nu and density come from [continuum], or else from the static moduli of the assembly.\n"
                  "An [initial] pulse in a bar has no lateral contraction: with nu not 0 it loads the free edges at once, and signals\n"
                  "at points are right to 1e-3 only, whatever the degree (66 x 8 elements of degree 8). Averages over sections are\n"
                  "right to 1e-5 or better, and a [drive] at the edge starts no such waves: prefer it for bars.\n"
                  "Example: ddem fem shear.toml --signals shear_fem.csv");
  command->add_option("SCENE", o->scene, "scene file (TOML)")->required();
  CLI::Option* output = command->add_option("-o,--output", o->hdf5, "write signals, scene and provenance to this HDF5 file");
  command->add_option("--snapshots", o->snapshots,
                      "displacement and velocity of all nodes at so many times, the last at the end, in FILE.h5 and, for ParaView, "
                      "FILE.xdmf (needs integrator = \"verlet\" in [time])")
      ->check(CLI::Range(1, 10000))
      ->needs(output);
  command->add_option("--signals", o->csv, "write the receivers' signals to this CSV file");
  command->add_flag("--force", o->force, "replace files, too, that ddem did not write");
  command->add_flag("--json", o->json, "print the result as JSON");
  command->callback([o, &action] { action = [o] { return run(*o); }; });
}

}  // namespace ddem::harness
