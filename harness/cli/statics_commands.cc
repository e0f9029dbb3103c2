// ddem moduli SCENE.toml and ddem pack SCENE.toml: an assembly without time.
#include <fmt/format.h>

#include <array>
#include <memory>
#include <span>

#include "harness/cli/commands.h"
#include "harness/cli/packing_figure.h"
#include "harness/cli/print_json.h"
#include "harness/cli/scene_argument.h"
#include "harness/io/atomic_file.h"
#include "harness/io/claim_outputs.h"
#include "harness/io/errors.h"
#include "harness/io/message.h"
#include "harness/model/assemble.h"
#include "harness/model/packing_report.h"
#include "harness/run/run_json.h"
#include "harness/scene/csv.h"
#include "harness/scene/units.h"
#include "reports/svg.h"

namespace ddem::harness {
namespace {

struct ModuliOptions {
  std::string scene;
  bool json = false;
};

int moduli(const ModuliOptions& o) {
  const SceneModuli m = scene_moduli(load_scene(o.scene, Purpose::statics));
  if (o.json) {
    print_json(moduli_json(m));
    return 0;
  }
  fmt::print("{} discs, {} bonds, coordination {:.3f}, solid fraction {:.4f}, bulk density {:.6g} kg/m3\n", m.discs, m.bonds,
             m.coordination, m.solid_fraction, m.bulk_density);
  if (m.rattlers > 0) fmt::print("{} rattlers, which no wave moves: {:.6g} kg/m3 move\n", m.rattlers, m.moving_density);
  fmt::print("{}\n", m.method);
  if (const auto iso = m.isotropic()) {
    const auto& c = *m.stiffness;
    fmt::print("stiffness (xx, yy, xy)\n");
    const auto pascal = [](double value) { return format_quantity(value, "Pa", 8); };
    for (int i = 0; i < 3; ++i) fmt::print("  {:>16} {:>16} {:>16}\n", pascal(c(i, 0)), pascal(c(i, 1)), pascal(c(i, 2)));
    fmt::print("E = {}, G = {}, K = {}, nu = {:.7f} (isotropic part, plane)\n", pascal(iso->young()), pascal(iso->shear),
               pascal(iso->bulk), iso->poisson());
    const DirectionalSpeeds s = *m.speeds();
    fmt::print("waves along x: bar {:.6g} m/s, shear {:.6g} m/s, P {:.6g} m/s\n", s.bar, s.s, s.p);
  }
  if (m.strip) {
    const auto& contraction = m.strip->lateral_contraction;
    fmt::print("free strip: EA = {}, bar {:.6g} m/s, {}\n", format_quantity(m.strip->axial_stiffness, "N"), m.strip->bar_velocity(),
               contraction ? fmt::format("lateral contraction {:.4f}", *contraction) : "a single row: no lateral contraction");
  }
  return 0;
}

struct PackOptions {
  std::string scene, output, figure;
  bool json = false, force = false;
};

int pack(const PackOptions& o) {
  const Scene scene = load_scene(o.scene, Purpose::packing);
  claim_outputs({{o.output, OutputKind::packing_csv}, {o.figure, OutputKind::figure}}, files_read_by(scene), o.force);
  const Packing p = build_packing(scene);
  const PackingReport report = report_on_packing(scene, p);
  write_file(o.output, csv_text("x,y,radius", std::array<std::span<const double>, 3>{p.x, p.y, p.radius}));
  if (!o.figure.empty()) write_file(o.figure, reports::render_svg(packing_figure(p)));
  say(packing_text(report));
  if (o.json) print_json(packing_json(report));
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
  command->footer("Example: ddem pack bar.toml -o discs.csv --figure discs.svg");
  command->add_option("SCENE", o->scene, "scene file (TOML); [assembly] alone is enough")->required();
  command->add_option("-o,--output", o->output, "CSV file to write")->required();
  command->add_option("--figure", o->figure, "SVG file of the discs, their radii and distances");
  command->add_flag("--force", o->force, "replace files, too, that ddem did not write");
  command->add_flag("--json", o->json, "print what the packing is like as JSON");
  command->callback([o, &action] { action = [o] { return pack(*o); }; });
}

}  // namespace ddem::harness
