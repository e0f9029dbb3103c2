#include "harness/calibrate/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem/assembly/contacts.h"
#include "harness/run/scene_moduli.h"

namespace ddem::harness {
namespace {

std::vector<double> ratios() {
  std::vector<double> r;
  for (int n = 0; n <= 6; ++n) r.push_back(0.05 * n);
  for (int n = 4; n <= 10; ++n) r.push_back(0.1 * n);
  return r;
}

/// The scene's own coordination first; others only where the bonds follow from one.
std::vector<Scene> assemblies_of(const Scene& scene) {
  std::vector<Scene> scenes = {scene};
  const auto* own = std::get_if<BondCoordination>(&scene.assembly.bonding);
  if (own == nullptr || !seed_of(scene)) return scenes;
  for (const double z : {5.0, 5.4, 5.8, 6.0}) {
    if (std::abs(z - own->bonds_per_disc) < 0.1) continue;
    scenes.push_back(scene);
    scenes.back().assembly.bonding = BondCoordination{z};
  }
  return scenes;
}

DeformationParameters deformable_of(const Scene& scene) {
  if (scene.deformation) return *scene.deformation;
  DeformationParameters d;
  d.scheme = Scheme::implicit;
  d.correction = Correction::full;
  return d;
}

CurvePoint kinematic_point(const Scene& scene, const StaticModel& model, const ModelPoint& at) {
  Scene unit = scene;
  unit.contact = Contact{};
  const ContactParameters c = model.contact(at, 1.0);
  unit.contact->stiffness =
      c.uniform() ? std::variant<NormalStiffness, ContactModulus>(NormalStiffness{1.0}) : ContactModulus{1.0};
  unit.contact->stiffness_ratio = at.stiffness_ratio;
  unit.deformation.reset();
  if (model.deformable()) unit.deformation = model.discs(at, 1.0);
  CurvePoint out;
  out.stiffness_ratio = at.stiffness_ratio;
  const double weight = 1.0 / static_cast<double>(model.assemblies().size());
  for (const SeedAssembly& a : model.assemblies()) {
    const auto m = references::plane_constants(kinematic_moduli(unit, a.assembly));
    out.kinematic_poisson += weight * m.poisson_ratio;
    out.kinematic_young += weight * m.young_modulus;
  }
  return out;
}

/// As the scene asks for it; else that of the assemblies, whose open ends have fewer.
double coordination_of(const Scene& scene, const StaticModel& model) {
  if (const auto* asked = std::get_if<BondCoordination>(&scene.assembly.bonding))
    return asked->bonds_per_disc;
  double sum = 0.0;
  for (const SeedAssembly& a : model.assemblies()) sum += coordination(a.assembly.bonds, a.assembly.size());
  return sum / static_cast<double>(model.assemblies().size());
}

DesignCurve curve_of(const Scene& scene, const StaticModel& model, const CurveOptions& options) {
  DesignCurve curve;
  curve.deformable = model.deformable();
  curve.model = "DEM";
  if (curve.deformable) {
    const Correction c = model.deformation().correction;
    curve.softness = options.softness;
    curve.particle_poisson_ratio = options.particle_poisson_ratio;
    curve.model = fmt::format("DDEM {}", c == Correction::normal ? "N" : c == Correction::full ? "F" : "NN");
  }
  curve.coordination = coordination_of(scene, model);
  for (const double ratio : ratios()) {
    const ModelPoint at{ratio, options.softness, options.particle_poisson_ratio};
    CurvePoint point = kinematic_point(scene, model, at);
    try {
      std::vector<double> young, poisson;
      for (const SeedModuli& m : model.at(at).seeds) young.push_back(m.young), poisson.push_back(m.poisson);
      point.young = mean_with_confidence(young);
      point.poisson = mean_with_confidence(poisson);
    } catch (const std::runtime_error&) {
      continue;
    }
    curve.points.push_back(point);
  }
  return curve;
}

reports::Plot panel(const std::vector<DesignCurve>& curves, const char* label, const char* unit,
                    double CurvePoint::*kinematic, MeanWithConfidence CurvePoint::*statics) {
  static constexpr reports::Color kColors[] = {reports::Color::blue, reports::Color::vermilion,
                                               reports::Color::green, reports::Color::orange,
                                               reports::Color::purple};
  reports::Plot plot{.x = {.label = "kₜ/kₙ"}, .y = {.label = label, .unit = unit}};
  std::size_t color = 0;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const DesignCurve& c = curves[k];
    if (k > 0 && !c.deformable) ++color;  // each assembly begins with its rigid discs
    const std::string name = fmt::format("{}, {:.1f} bonds a disc", c.model, c.coordination);
    reports::Series line{.name = name,
                         .color = kColors[color % std::size(kColors)],
                         .dash = c.deformable ? reports::Dash::dashed : reports::Dash::solid};
    reports::Series estimate{
        .name = k < 2 ? name + ", kinematic" : "", .color = line.color, .dash = reports::Dash::dotted};
    for (const CurvePoint& p : c.points) {
      line.x.push_back(p.stiffness_ratio), line.y.push_back((p.*statics).mean);
      estimate.x.push_back(p.stiffness_ratio), estimate.y.push_back(p.*kinematic);
    }
    plot.series.push_back(line);
    if (k < 2) plot.series.push_back(estimate);
  }
  return plot;
}

}  // namespace

std::size_t curve_count(const Scene& scene) {
  return 2 * assemblies_of(scene).size();
}

std::vector<DesignCurve> design_curves(const Scene& scene, const CurveOptions& options,
                                       const std::function<void()>& on_progress) {
  std::vector<DesignCurve> curves;
  for (const Scene& s : assemblies_of(scene)) {
    const StaticModel model(s, seed_assemblies(s, seed_of(s).value_or(0), options.seeds, options.threads),
                            options.threads);
    for (const DeformationParameters& d : {DeformationParameters{}, deformable_of(scene)}) {
      curves.push_back(curve_of(s, model.variant(d), options));
      on_progress();
    }
  }
  return curves;
}

reports::Figure curve_figure(const std::vector<DesignCurve>& curves) {
  const auto soft =
      std::find_if(curves.begin(), curves.end(), [](const DesignCurve& c) { return c.deformable; });
  return {
      .id = "design-curves",
      .title = "Poisson's ratio and stiffness over kₜ/kₙ",
      .caption = fmt::format("Static moduli of the assembly, mean over its seeds. Full lines: rigid discs; "
                             "dashed: deformable ones, kₙ/Eₚ = {:g}, νₚ = {:g}. "
                             "Dotted: kinematic estimate of the first assembly, which takes every disc along "
                             "with the mean strain. Choose kₜ/kₙ on the left, "
                             "read E/kₙ on the right, and kₙ from the modulus that you want.",
                             soft->softness, soft->particle_poisson_ratio),
      .panels = {panel(curves, "Poisson's ratio", "", &CurvePoint::kinematic_poisson, &CurvePoint::poisson),
                 panel(curves, "E/kₙ", "1/m", &CurvePoint::kinematic_young, &CurvePoint::young)}};
}

std::string curve_csv(const std::vector<DesignCurve>& curves) {
  std::string text =
      "model,coordination,softness,particle_poisson_ratio,stiffness_ratio,poisson_ratio,poisson_stddev,young_"
      "over_stiffness,young_stddev,"
      "kinematic_poisson_ratio,kinematic_young_over_stiffness\n";
  for (const DesignCurve& c : curves) {
    for (const CurvePoint& p : c.points) {
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", c.model, c.coordination, c.softness,
                          c.particle_poisson_ratio, p.stiffness_ratio, p.poisson.mean, p.poisson.stddev,
                          p.young.mean, p.young.stddev, p.kinematic_poisson, p.kinematic_young);
    }
  }
  return text;
}

}  // namespace ddem::harness
