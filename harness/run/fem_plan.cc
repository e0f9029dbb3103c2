#include "harness/run/fem_plan.h"

#include <algorithm>
#include <cmath>

#include "dem/statics/sections.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/model/load.h"
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
  return {mean_x(a.packing, edge_discs(a.packing, ddem::Edge::left, band)),
          mean_x(a.packing, edge_discs(a.packing, ddem::Edge::right, band)), bottom, a.packing.width};
}

/// How far left of its discs' mean place a driven edge acts, m (right of it: negative). Few discs of an irregular end are
/// driven, and a grip of few discs gives: in equilibrium the inner strip lies there as if a plane end stood further away.
/// The wave comes later by as much: without it the waveforms of particles and continuum are shifted by up to 0.6 mm.
/// Free strips are left alone, since what pulls at a few discs bends them, and a wave has no time to.
double grip_offset(const Scene& scene, const ddem::Assembly& a, double static_speed, Wave wave) {
  const double band = edge_band(scene, a);
  SectionDiscs inner;
  const auto [lo, hi] = std::minmax_element(a.packing.x.begin(), a.packing.x.end());
  for (std::size_t d = 0; d < a.size(); ++d) {
    const double place = (a.packing.x[d] - *lo) / (*hi - *lo);
    if (place > 0.2 && place < 0.8 && !std::binary_search(a.rattlers.begin(), a.rattlers.end(), static_cast<int>(d))) inner.push_back(static_cast<int>(d));
  }
  const std::vector<SectionDiscs> sections = {edge_discs(a.packing, ddem::Edge::left, band), inner};
  const std::vector<double> compliance = static_compliances(a, contact_parameters(scene), deformation_parameters(scene), band,
                                                            sections, wave == Wave::shear ? 1 : 0);
  // u' = F/(rho c^2 W h) in the continuum.
  const double stiffness = bulk_density(a) * static_speed * static_speed * a.packing.width * a.thickness;
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

/// What the scene does not write is the discs' default; the continuum is exact in time unless it asks for less.
Integrator integrator_of(const Scene& scene) {
  return scene.places.contains("time.integrator") ? scene.time.integrator : Integrator::exact;
}

}  // namespace

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

FemPlan plan_fem(const Scene& scene, const std::optional<SceneModuli>& moduli, const ddem::Assembly* assembly) {
  const auto wave = wave_of(scene);
  if (!wave) throw InputError(scene.path.string() + ": [initial]: a state from files has no continuum counterpart; give a pulse or [drive]");
  std::optional<ddem::Assembly> built;
  if (moduli && assembly == nullptr) assembly = &built.emplace(build_assembly(scene));
  Rectangle box = assembly != nullptr ? rectangle_of(scene, *assembly) : nominal_rectangle(scene).value();
  if (assembly != nullptr && scene.assembly.periodic.y && std::holds_alternative<Drive>(scene.load)) {
    box.x0 -= grip_offset(scene, *assembly, moduli->speed_of(*wave, true).value(), *wave);
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
    fem.degree = static_cast<int>(scene.continuum->degree);
    if (scene.continuum->mesh) fem.mesh = std::filesystem::absolute(*scene.continuum->mesh).string();
    fem.elements = {static_cast<int>(scene.continuum->elements[0]), static_cast<int>(scene.continuum->elements[1])};
  }
  fem.integrator = integrator_of(scene);
  const auto written = [&](const char* key) { return scene.places.contains(key); };
  if (written("time.step") || written("time.step_fraction") || fem.integrator == Integrator::verlet) fem.step = scene.time.step;
  fem.sample_every = static_cast<int>(scene.time.sample_every);

  const double speed = fem.material.wave_speed(*wave, fem.periodic);
  plan.context = {speed, fem.length, box.x0, source_centre(scene), source_duration(scene), source_amplitude(scene),
                  smallest_arrival(scene), pulse_half_width(scene, speed)};
  fem.end = choose_end(scene, plan);
  for (const Probe& p : plan.layout.probes) {
    const double x = std::clamp(p.x - box.x0, 0.0, fem.length), y = std::clamp(p.y - box.y0, 0.0, fem.width);
    if (plan.sections) {
      fem.sections.push_back(x);
    } else {
      fem.points.push_back({x, y});
    }
  }
  return plan;
}

const std::vector<std::vector<double>>& receiver_signals(const FemPlan& plan, const FemResult& result, Wave wave) {
  if (plan.sections) return wave == Wave::longitudinal ? result.section_ux : result.section_uy;
  return wave == Wave::longitudinal ? result.point_ux : result.point_uy;
}

}  // namespace ddem::harness
