#include "harness/run/fem_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem/core/narrow.h"
#include "dem/statics/sections.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/model/load.h"
#include "harness/model/memory_need.h"
#include "harness/run/load_limits.h"
#include "harness/scene/place.h"

namespace ddem::harness {
namespace {

/// The rectangle of the continuum in the packing's coordinates.
struct Rectangle {
  double x0 = 0.0, x1 = 0.0, y0 = 0.0, width = 0.0;
};

double mean_x(const Packing& p, const std::vector<int>& discs) {
  double sum = 0.0;
  for (const int d : discs) sum += p.x[d];
  return sum / static_cast<double>(discs.size());
}

Rectangle rectangle_of(const Scene& scene, const ddem::Assembly& a) {
  const double band = edge_band(scene, a);
  double bottom = HUGE_VAL;
  for (std::size_t d = 0; d < a.size(); ++d) bottom = std::min(bottom, a.packing.y[d] - a.packing.radius[d]);
  return {mean_x(a.packing, edge_discs(a, ddem::Edge::left, band)),
          mean_x(a.packing, edge_discs(a, ddem::Edge::right, band)), bottom, a.packing.width};
}

/// How far left of its discs' mean place a driven edge acts, m (right of it: negative). Few discs of an irregular end are
/// driven, and a grip of few discs gives: in equilibrium the inner strip lies there as if a plane end stood further away.
/// The wave comes later by as much: without it the waveforms of particles and continuum are shifted by up to 0.6 mm.
/// Free strips are left alone, since what pulls at a few discs bends them, and a wave has no time to.
double grip_offset(const Scene& scene, const ddem::Assembly& a, double static_speed, Wave wave) {
  const double band = edge_band(scene, a);
  SectionDiscs inner;
  const auto [lo, hi] = network_ends(a);
  for (const int d : network_discs(a)) {
    const double place = (a.packing.x[d] - lo) / (hi - lo);
    if (place > 0.2 && place < 0.8) inner.push_back(d);
  }
  const std::vector<SectionDiscs> sections = {edge_discs(a, ddem::Edge::left, band), inner};
  const std::vector<double> compliance = static_compliances(a, contact_parameters(scene), deformation_parameters(scene), band,
                                                            sections, wave == Wave::shear ? 1 : 0);
  // u' = F/(rho c^2 W h) in the continuum.
  const double stiffness = moving_density(a) * static_speed * static_speed * a.packing.width * a.thickness;
  return (compliance[1] - compliance[0]) * stiffness - (mean_x(a.packing, inner) - mean_x(a.packing, sections[0]));
}

std::optional<Rectangle> nominal_rectangle(const Scene& scene) {
  if (const auto* random = std::get_if<RandomPacking>(&scene.assembly.packing)) return Rectangle{0.0, random->length, 0.0, random->width};
  if (const auto* hexagonal = std::get_if<HexagonalPacking>(&scene.assembly.packing)) {
    if (const auto* r = std::get_if<HexagonalRectangle>(&hexagonal->size)) return Rectangle{0.0, r->length, 0.0, r->width};
  }
  return std::nullopt;
}

/// The layout that lay_probes would give on a strip without discs, at the wanted places exactly.
ProbeLayout nominal_layout(const Scene& scene, const Rectangle& box) {
  if (const auto* pairs = std::get_if<ProbePairs>(&scene.probes)) return nominal_pairs(*pairs, box.x1 - box.x0, box.width);
  ProbeLayout layout;
  for (const auto& [x, y] : std::get<ProbePoints>(scene.probes).points) {
    if (x < 0.0 || x > box.x1 - box.x0 || y < 0.0 || y > box.width) {
      throw InputError(scene_problem(scene, "probes.points", "a point lies outside the strip", "x and y count from its lower left corner"));
    }
    layout.probes.push_back({"p" + std::to_string(layout.probes.size()), x, y, {}});
  }
  return layout;
}

double mean_column_spacing(const ddem::Assembly* a, const Rectangle& box) {
  // Columns of a dense packing are sqrt(3) r apart; without discs, a sixtieth of the length.
  return a != nullptr ? std::sqrt(3.0) * mean_radius(a->packing) : (box.x1 - box.x0) / 60.0;
}

double choose_end(const Scene& scene, const FemPlan& plan) {
  if (const auto* end = std::get_if<EndTime>(&scene.time.end)) return end->seconds;
  if (const auto* end = std::get_if<EndSteps>(&scene.time.end)) {
    if (const auto* step = std::get_if<StepSeconds>(&scene.time.step)) return static_cast<double>(end->steps) * step->seconds;
    throw InputError(scene_problem(scene, "time.steps", "the continuum's time step is not that of the discs", "give time.end, or time.step in seconds"));
  }
  if (plan.layout.pairs.empty()) {
    throw InputError(scene_problem(scene, "time.end", "without pairs of probes there is no last peak to wait for", "give time.end"));
  }
  double seconds = 0.0;
  for (const Probe& p : plan.layout.probes) seconds = std::max(seconds, time_of_passage(plan.context, p.x, 0.3));
  return seconds;
}

/// A step of nodes an even spacing d apart is at most d/c, and shorter where the degree is higher: as many samples or more.
double least_samples(const FemCase& fem) {
  double step = 0.0;
  if (const auto* seconds = std::get_if<StepSeconds>(&fem.step)) {
    step = seconds->seconds;
  } else if (fem.mesh.empty()) {
    const double spacing = std::min(fem.length / fem.elements[0], fem.width / fem.elements[1]) / fem.degree;
    step = std::get<StepFraction>(fem.step).of_critical * spacing / fem.material.wave_speed(Wave::longitudinal, true);
  }
  return step > 0.0 ? 1.0 + std::floor(fem.end / (step * static_cast<double>(fem.sample_every))) : 0.0;
}

void check_elements(const Scene& scene, const FemCase& fem) {
  constexpr double most = 5e7;  // ddem-fem counts them in 32 bits
  const double p = fem.degree, dofs = 2.0 * p * fem.elements[0] * p * fem.elements[1];
  const std::string what = fmt::format("{} x {} elements of degree {}: {:.3g} degrees of freedom", fem.elements[0], fem.elements[1], fem.degree, dofs);
  if (fem.mesh.empty() && dofs > most) throw InputError(scene_problem(scene, "continuum.elements", what, fmt::format("at most {:g}", most)));
  const MemoryPart parts[] = {{what, memory_of_elements(fem), "continuum.elements", "take fewer"},
                              {fmt::format("{:.3g} samples of {} receivers", least_samples(fem), fem.points.size() + fem.sections.size()), memory_of_signals(fem),
                               "time.sample_every", "raise it, or end earlier"}};
  require_memory(scene, parts);
}

/// What the scene does not write is the discs' default; the continuum is exact in time unless it asks for less.
Integrator integrator_of(const Scene& scene) {
  return scene.places.contains("time.integrator") ? scene.time.integrator : Integrator::exact;
}

}  // namespace

double memory_of_elements(const FemCase& fem) {
  constexpr double bytes = 200.0;  // a degree of freedom, while a case is set up
  return fem.mesh.empty() ? bytes * 2.0 * fem.degree * fem.elements[0] * fem.degree * fem.elements[1] : 0.0;
}

double memory_of_signals(const FemCase& fem) {
  // Two numbers a receiver and sample: in ddem-fem as recorded, by kind, in its file and in that file's image.
  return 4.0 * 16.0 * least_samples(fem) * static_cast<double>(fem.points.size() + fem.sections.size());
}

void check_snapshots(const Scene& scene) {
  if (integrator_of(scene) == Integrator::verlet) return;
  throw InputError(scene_problem(scene, "time.integrator",
                                 "snapshots of all nodes are not exact in time, as ddem fem is by default: the receivers' signals alone are",
                                 "leave --snapshots out, or write integrator = \"verlet\" in [time]"));
}

bool continuum_stands_alone(const Scene& scene) {
  return scene.continuum && scene.continuum->young_modulus && scene.continuum->poisson_ratio && scene.continuum->density &&
         nominal_rectangle(scene) && !std::holds_alternative<ProbeDiscs>(scene.probes);
}

bool needs_moduli(const Scene& scene) {
  const auto& c = scene.continuum;
  if (!c || !c->young_modulus || !c->poisson_ratio || !c->density) return true;
  // The place of the driven edge is found in the assembly, with its speed.
  return !continuum_stands_alone(scene) && scene.assembly.periodic.y && std::holds_alternative<Drive>(scene.load);
}

FemPlan plan_fem(const Scene& scene, const std::optional<SceneModuli>& moduli, const ddem::Assembly* assembly) {
  const auto wave = wave_of(scene);
  if (!wave) throw InputError(scene.path.string() + ": [initial]: a state from files has no continuum counterpart; give a pulse or [drive]");
  std::optional<ddem::Assembly> built;
  if ((moduli || !continuum_stands_alone(scene)) && assembly == nullptr) assembly = &built.emplace(build_assembly(scene));
  Rectangle box = assembly != nullptr ? rectangle_of(scene, *assembly) : nominal_rectangle(scene).value();
  if (assembly != nullptr && scene.assembly.periodic.y && std::holds_alternative<Drive>(scene.load)) {
    box.x0 -= grip_offset(scene, *assembly, moduli->speed_of(*wave, true).value(), *wave);
  }

  if (const auto* pulse = std::get_if<InitialPulse>(&scene.load)) {
    require_inside(scene, *pulse, box.x1 - box.x0);
    check_held_ends(scene, *pulse, box.x1 - box.x0);
  }

  FemPlan plan;
  plan.layout = assembly != nullptr ? lay_probes(scene, *assembly) : nominal_layout(scene, box);
  const auto* pairs = std::get_if<ProbePairs>(&scene.probes);
  plan.sections = pairs != nullptr && pairs->section;

  FemCase& fem = plan.fem;
  fem.id = "case";
  fem.length = box.x1 - box.x0;
  fem.width = box.width;
  fem.material = continuum_material(scene, moduli, *wave);
  fem.periodic = scene.assembly.periodic.y;
  fem.left = scene.boundary.left;
  fem.right = scene.boundary.right;
  fem.load = scene.load;
  fem.column_spacing = mean_column_spacing(assembly, box);
  if (scene.continuum) {
    fem.degree = narrow<int>(scene.continuum->degree, "continuum.degree");
    if (scene.continuum->mesh) fem.mesh = std::filesystem::absolute(*scene.continuum->mesh).string();
    for (std::size_t k = 0; k < 2; ++k) fem.elements[k] = narrow<int>(scene.continuum->elements[k], "continuum.elements");
  }
  fem.integrator = integrator_of(scene);
  const auto written = [&](const char* key) { return scene.places.contains(key); };
  if (written("time.step") || written("time.step_fraction") || fem.integrator == Integrator::verlet) fem.step = scene.time.step;
  fem.sample_every = scene.time.sample_every;

  const double speed = fem.material.wave_speed(*wave, fem.periodic);
  plan.context = wave_context(scene, {box.x0, fem.length, 0.0, fem.column_spacing}, speed);
  strain_warning(scene, plan.context, fem.column_spacing);  // refuses what is beyond all measure
  fem.end = choose_end(scene, plan);
  for (const Probe& p : plan.layout.probes) {
    const double x = std::clamp(p.x - box.x0, 0.0, fem.length), y = std::clamp(p.y - box.y0, 0.0, fem.width);
    if (plan.sections) {
      fem.sections.push_back(x);
    } else {
      fem.points.push_back({x, y});
    }
  }
  check_elements(scene, fem);
  return plan;
}

namespace {

/// A pulse that the nodes do not carry. Linear elements slow a wave of n nodes by (2 pi/n)^2/24, half a per cent of 18 nodes;
/// three of a higher degree suffice (0.05 %). Of a mesh from a file the spacing is not known.
std::optional<FailedMeasurement> coarse_elements(const FemCase& fem, const WaveContext& c) {
  if (!fem.mesh.empty() || !(c.pulse_width > 0.0)) return std::nullopt;
  const double nodes = c.pulse_width * c.speed / fem.length * fem.elements[0] * fem.degree;
  const double needed = fem.degree == 1 ? 9.0 : fem.degree == 2 ? 6.0 : 3.0;
  if (nodes >= needed) return std::nullopt;
  return FailedMeasurement{Failure::undersampled, fmt::format("the pulse takes {:.2g} nodes at half its height, and {} are needed; set continuum.elements = [{:.0f}, {}] or more",
                                                              nodes, needed, std::ceil(fem.elements[0] * needed / nodes), fem.elements[1])};
}

}  // namespace

WaveMeasurement measure_fem(const FemPlan& plan, const FemResult& result, Wave wave) {
  WaveContext context = plan.context;
  context.sample_step = result.sample_interval / static_cast<double>(plan.fem.sample_every);
  if (plan.fem.integrator == Integrator::verlet) context.march_step = result.time_step;
  context.obstacle = coarse_elements(plan.fem, context);
  return measure_wave(receiver_signals(plan, result, wave), result.sample_interval, plan.layout, context);
}

const std::vector<std::vector<double>>& receiver_signals(const FemPlan& plan, const FemResult& result, Wave wave) {
  if (plan.sections) return wave == Wave::longitudinal ? result.section_ux : result.section_uy;
  return wave == Wave::longitudinal ? result.point_ux : result.point_uy;
}

}  // namespace ddem::harness
