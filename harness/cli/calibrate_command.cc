// ddem calibrate --young E --poisson NU --density RHO
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <thread>

#include "harness/calibrate/calibrate_json.h"
#include "harness/calibrate/curves.h"
#include "harness/calibrate/scene_text.h"
#include "harness/cli/commands.h"
#include "harness/cli/print_json.h"
#include "harness/cli/scene_argument.h"
#include "harness/io/atomic_file.h"
#include "harness/io/claim_outputs.h"
#include "harness/io/errors.h"
#include "harness/io/message.h"
#include "harness/io/progress.h"
#include "reports/svg.h"

namespace ddem::harness {
namespace {

struct CalibrateOptions {
  std::array<std::string, kTargetKinds.size()> targets;  // by TargetKind
  std::string density, assembly, plane = "stress", output, curves, prefer = "stiffest";
  std::optional<double> stiffness_ratio, softness, particle_poisson_ratio;
  int seeds = 6, proof_seeds = 8, jobs = 0;
  const CLI::Option *seeds_option = nullptr, *proof_seeds_option = nullptr, *prefer_option = nullptr;
  bool json = false, force = false;
};

constexpr std::array<const char*, kTargetKinds.size()> kTargetOptions = {
    "--young", "--poisson", "--bar-velocity", "--shear-velocity", "--p-velocity"};

WantedValues wanted_values(const CalibrateOptions& o) {
  WantedValues wanted;
  std::vector<std::string> problems;
  const auto read = [&](const char* option, const std::string& text,
                        Dimension dimension) -> std::optional<Uncertain> {
    if (text.empty()) return std::nullopt;
    try {
      return parse_uncertain(option, text, dimension);
    } catch (const InputError& e) {
      problems.push_back(e.what());
      return std::nullopt;
    }
  };
  for (std::size_t k = 0; k < kTargetKinds.size(); ++k)
    wanted.values[k] = read(kTargetOptions[k], o.targets[k], dimension_of(kTargetKinds[k]));
  if (const auto density = read("--density", o.density, Dimension::density)) {
    wanted.density = density->value;
    if (density->stddev != 0.0)
      problems.push_back("--density " + o.density +
                         ": its uncertainty has no use here; give the value alone");
  }
  if (!problems.empty()) throw InputError(problems);
  wanted.plane = o.plane == "strain" ? Plane::strain : Plane::stress;
  return wanted;
}

Scene scene_to_calibrate(const CalibrateOptions& o, const Target& target) {
  Scene scene;
  if (o.assembly.empty()) {
    const SceneResult read = parse_scene(default_assembly_text(), "the default assembly",
                                         std::filesystem::current_path(), {Purpose::packing});
    if (!read) throw std::logic_error("the default assembly is no scene:\n" + to_string(read.violations));
    scene = *read;
  } else {
    scene = load_scene(o.assembly, Purpose::packing);
  }
  if (!target.density && !scene.material)
    throw InputError(
        "--density: missing, and the assembly's scene has no material.density; give one of them");
  // A packing has its moduli whatever it weighs; the discs' own density is found with its solid fraction.
  if (!scene.material) scene.material = Material{*target.density};
  return scene;
}

SearchSpace search_space(const CalibrateOptions& o, const Scene& scene) {
  SearchSpace space;
  space.preference = o.prefer == "margin" ? Preference::margin : Preference::stiffest;
  std::vector<std::string> problems;
  if (o.stiffness_ratio) {
    const bool usual = magnitude_problem(*o.stiffness_ratio, Dimension::none).empty();
    if (!usual || !(*o.stiffness_ratio >= 0.0) || !(*o.stiffness_ratio <= space.stiffness_ratio.high))
      problems.push_back(fmt::format("--stiffness-ratio {}: give a number from 0 to {:g}", *o.stiffness_ratio,
                                     space.stiffness_ratio.high));
    space.stiffness_ratio = {*o.stiffness_ratio, *o.stiffness_ratio};
  }
  if ((o.softness || o.particle_poisson_ratio) && !scene.deformation) {
    problems.push_back(
        "--softness and --particle-poisson: the assembly's scene has no [deformation]; its discs are rigid");
  }
  if (o.softness) {
    if (!(*o.softness >= 1e-6 && *o.softness <= 1e3))
      problems.push_back(fmt::format("--softness {}: give k_n/E_p from 1e-6 to 1000", *o.softness));
    space.softness = {*o.softness, *o.softness};
  }
  if (o.particle_poisson_ratio) {
    const double upper = scene.deformation && scene.deformation->plane == Plane::strain ? 0.5 : 1.0;
    if (!(*o.particle_poisson_ratio > -1.0 && *o.particle_poisson_ratio < upper)) {
      problems.push_back(fmt::format("--particle-poisson {}: give a number between -1 and {}",
                                     *o.particle_poisson_ratio, upper));
    }
    space.particle_poisson_ratio = {*o.particle_poisson_ratio, *o.particle_poisson_ratio};
  }
  for (const CLI::Option* option : {o.seeds_option, o.proof_seeds_option}) {
    const bool counts_packings = option == o.seeds_option || o.proof_seeds > 1;
    if (option->count() > 0 && counts_packings && !seed_of(scene))
      problems.push_back(option->get_name() + ": this assembly has no seed, one packing is all there is; leave it out");
  }
  if (o.prefer_option->count() > 0 && !(scene.deformation && space.free_parameters() > 1))
    problems.push_back("--prefer: there is nothing to choose, " +
                       std::string(scene.deformation ? "Poisson's ratio settles the one parameter that is not held; leave it out, or hold less"
                                                     : "rigid discs have k_t/k_n alone to meet Poisson's ratio; leave it out"));
  if (!problems.empty()) throw InputError(problems);
  return space;
}

std::filesystem::path curves_path(const CalibrateOptions& o, const char* ending) {
  return o.curves.empty() ? std::filesystem::path() : std::filesystem::path(o.curves) / (std::string("design-curves") + ending);
}

void write_curves(const CalibrateOptions& o, const Scene& scene, const Calibration& c, int threads) {
  CurveOptions options{.seeds = o.seeds, .threads = threads};
  if (scene.deformation)
    options.softness = c.found.point.softness,
    options.particle_poisson_ratio = c.found.point.particle_poisson_ratio;
  std::vector<DesignCurve> curves;
  {
    Progress progress(curve_count(scene), "design curves");
    curves = design_curves(scene, options, [&] { progress.advance(); });
  }
  write_file(curves_path(o, ".csv"), curve_csv(curves));
  write_file(curves_path(o, ".svg"), reports::render_svg(curve_figure(curves)));
}

std::string scene_file_text(const CalibrateOptions& o, const Scene& scene, const Calibration& c) {
  std::string text = calibrated_text(scene, c.found);
  if (!text.starts_with(kWrittenScene)) text.insert(0, kWrittenScene);
  if (!o.assembly.empty()) return text;
  const double shear = c.target.young_modulus / (2.0 * (1.0 + c.target.poisson_ratio));
  return text + default_load_text(std::sqrt(shear / c.target.density.value()));
}

int calibrate(const CalibrateOptions& o) {
  const Target target = make_target(wanted_values(o));
  const Scene scene = scene_to_calibrate(o, target);
  const SearchSpace space = search_space(o, scene);
  claim_outputs({{o.output, OutputKind::scene},
                 {curves_path(o, ".csv"), OutputKind::curves_csv},
                 {curves_path(o, ".svg"), OutputKind::figure}},
                o.assembly.empty() ? std::vector<std::filesystem::path>{} : files_read_by(scene), o.force);
  const int threads =
      o.jobs > 0 ? o.jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const Calibration c = calibrate(scene, target, {space, o.seeds, threads});
  std::optional<Proof> proof;
  if (c.feasible && o.proof_seeds > 0) {
    Progress progress(seed_of(scene) ? static_cast<std::size_t>(o.proof_seeds) : 1, "unseen packings");
    proof = prove(scene, c.found, seed_of(scene).value_or(0) + (seed_of(scene) ? o.seeds : 0), o.proof_seeds,
                  threads, [&] { progress.advance(); });
  }
  if (c.feasible && !o.output.empty()) write_file(o.output, scene_file_text(o, scene, c));
  if (!o.curves.empty()) write_curves(o, scene, c, threads);
  if (o.json) {
    print_json(calibration_json(scene, c, proof));
  } else {
    fmt::print("{}", calibration_text(scene, c, proof));
  }
  if (!c.feasible && !o.output.empty())
    message("ddem: {} was not written: no parameters reach the target", o.output);
  return static_cast<int>(c.feasible ? ExitCode::done : ExitCode::verdict_failed);
}

void add_targets(CLI::App& command, CalibrateOptions& o) {
  constexpr std::array<const char*, kTargetKinds.size()> what = {
      "Young's modulus", "Poisson's ratio", "velocity of long waves in a thin bar, sqrt(E/density)",
      "velocity of shear waves", "velocity of P waves"};
  for (std::size_t k = 0; k < kTargetKinds.size(); ++k)
    command.add_option(kTargetOptions[k], o.targets[k], what[k])
        ->group("Targets: two or more, such as \"30 GPa\" or \"30 GPa +- 1 GPa\"");
  command.add_option(
      "--density", o.density,
      "bulk density of the material, \"2400 kg/m3\": a disc's is that over the solid fraction");
  command
      .add_option("--plane", o.plane,
                  "stress: the plane model takes E and nu as they are; strain: those of a solid, E/(1-nu^2) "
                  "and nu/(1-nu)")
      ->check(CLI::IsMember({"stress", "strain"}))
      ->capture_default_str();
}

}  // namespace

void add_calibrate_command(CLI::App& app, Action& action) {
  auto o = std::make_shared<CalibrateOptions>();
  CLI::App* command = app.add_subcommand("calibrate", "Contact (and particle) parameters for target moduli");
  command->footer(
      "ddem calibrate --young \"30 GPa\" --poisson 0.25 --density 2400 -o scene.toml\n"
      "Static moduli of the real assembly, closed in y and averaged over seeds, are inverted for k_n, "
      "k_t/k_n and, with\n"
      "[deformation] in SCENE.toml, k_n/E_p and nu_p; the result is tried on seeds that were not fitted, at "
      "rest and in motion.\n"
      "In SCENE.toml, [assembly] is enough; what it says of the parameters searched is replaced. With more "
      "parameters than\n"
      "targets, --prefer chooses. Exit code 1 where the target is out of reach: it says what is nearest, and "
      "what would help.");
  add_targets(*command, *o);
  command->add_option(
      "--assembly", o->assembly,
      "scene whose kind of assembly and [deformation] to calibrate (default: 682 random discs, rigid)");
  o->seeds_option = command->add_option("--seeds", o->seeds, "random packings to fit, from the scene's seed on")
                        ->check(CLI::Range(1, 1000))
                        ->capture_default_str();
  o->proof_seeds_option = command->add_option("--proof-seeds", o->proof_seeds, "further ones to try the result on; 0: none")
                              ->check(CLI::Range(0, 1000))
                              ->capture_default_str();
  command->add_option("--stiffness-ratio", o->stiffness_ratio, "hold k_t/k_n");
  command->add_option("--softness", o->softness, "hold k_n/E_p");
  command->add_option("--particle-poisson", o->particle_poisson_ratio, "hold nu_p");
  o->prefer_option = command
                         ->add_option("--prefer", o->prefer,
                                      "stiffest: the stiffest discs, then the largest stability margin; margin: the largest "
                                      "stability margin")
                         ->check(CLI::IsMember({"stiffest", "margin"}))
                         ->capture_default_str();
  command->add_option("--curves", o->curves,
                      "folder for design-curves.csv and .svg: nu and E/k_n over k_t/k_n");
  command->add_option("-o,--output", o->output, "scene file to write");
  command->add_option("-j,--jobs", o->jobs, "packings at a time (default: the machine's cores)")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--force", o->force, "replace files, too, that ddem did not write");
  command->add_flag("--json", o->json, "print the result as JSON");
  command->callback([o, &action] { action = [o] { return calibrate(*o); }; });
}

}  // namespace ddem::harness
