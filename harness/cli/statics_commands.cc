// ddem moduli SCENE.toml and ddem pack SCENE.toml: an assembly without time.
#include <fmt/format.h>

#include <array>
#include <memory>
#include <span>

#include "harness/cli/commands.h"
#include "harness/cli/scene_argument.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/model/packing_report.h"
#include "harness/run/run_json.h"
#include "harness/scene/csv.h"

namespace ddem::harness {
namespace {

struct ModuliOptions {
  std::string scene;
  bool json = false;
};

int moduli(const ModuliOptions& o) {
  const SceneModuli m = scene_moduli(load_scene(o.scene, Purpose::statics));
  if (o.json) {
    fmt::print("{}", to_text(moduli_json(m)));
    return 0;
  }
  fmt::print("{} discs, {} bonds, coordination {:.3f}, solid fraction {:.4f}, bulk density {:.6g} kg/m3\n{}\n", m.discs, m.bonds,
             m.coordination, m.solid_fraction, m.bulk_density, m.method);
  if (const auto iso = m.isotropic()) {
    const auto& c = *m.stiffness;
    fmt::print("stiffness (Pa; xx, yy, xy)\n");
    for (int i = 0; i < 3; ++i) fmt::print("  {:14.7e} {:14.7e} {:14.7e}\n", c(i, 0), c(i, 1), c(i, 2));
    fmt::print("E = {:.7e} Pa, G = {:.7e} Pa, K = {:.7e} Pa, nu = {:.7f} (isotropic part, plane)\n", iso->young(), iso->shear,
               iso->bulk, iso->poisson());
    const DirectionalSpeeds s = *m.speeds();
    fmt::print("waves along x: bar {:.6g} m/s, shear {:.6g} m/s, P {:.6g} m/s\n", s.bar, s.s, s.p);
  }
  if (m.strip) {
    fmt::print("free strip: EA = {:.6g} N, bar {:.6g} m/s, lateral contraction {:.4f}\n", m.strip->axial_stiffness,
               m.strip->bar_velocity(), m.strip->lateral_contraction);
  }
  return 0;
}

struct PackOptions {
  std::string scene, output;
  bool json = false;
};

int pack(const PackOptions& o) {
  const Scene scene = load_scene(o.scene, Purpose::packing);
  check_outputs({o.output}, scene);
  const Packing p = build_packing(scene);
  const PackingReport report = report_on_packing(scene, p);
  write_file(o.output, csv_text("x,y,radius", std::array<std::span<const double>, 3>{p.x, p.y, p.radius}));
  fmt::print(stderr, "{}", packing_text(report));
  if (o.json) fmt::print("{}", to_text(packing_json(report)));
  return 0;
}

}  // namespace

void add_moduli_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<ModuliOptions>();
  CLI::App* command = app.add_subcommand("moduli", "Static plane moduli of a scene's assembly, by sparse solves");
  command->footer("Periodic directions are homogenised; a free strip is pulled. An infinite hexagonal lattice is\n"
                  "[assembly] packing = \"hexagonal\", periodic = \"xy\" (see harness/scenes/moduli_cell.toml).");
  command->add_option("SCENE", o->scene, "scene file (TOML)")->required();
  command->add_flag("--json", o->json, "print the result as JSON");
  command->callback([o, &action] { action = [o] { return moduli(*o); }; });
}

void add_pack_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<PackOptions>();
  CLI::App* command = app.add_subcommand("pack", "The packing that a scene describes, as CSV (x,y,radius in metres)");
  command->footer("Example: ddem pack bar.toml -o discs.csv");
  command->add_option("SCENE", o->scene, "scene file (TOML); [assembly] alone is enough")->required();
  command->add_option("-o,--output", o->output, "CSV file to write")->required();
  command->add_flag("--json", o->json, "print what the packing is like as JSON");
  command->callback([o, &action] { action = [o] { return pack(*o); }; });
}

}  // namespace ddem::harness
