#include "harness/studies/calibration/calibration_figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/references/effective_moduli.h"

namespace ddem::harness {
namespace {

using Constant = double DesignPoint::*;

reports::Plot plot_of(Constant constant, reports::Axis x) {
  reports::Plot plot{.x = std::move(x)};
  plot.y = constant == &DesignPoint::poisson_ratio ? reports::Axis{.label = "Poisson's ratio"}
                                                   : reports::Axis{.label = "E/kₙ", .unit = "1/m"};
  return plot;
}

/// Static moduli of all packings of a material; none of those without.
std::vector<DesignPoint> packings_of(const StripResults& r, Model model, double ratio,
                                     StripPacking packing) {
  std::vector<DesignPoint> points;
  for (const StaticOutcome& s : r.statics) {
    if (s.key.packing != packing || s.key.model != model || s.key.stiffness_ratio != ratio ||
        !s.failure.empty())
      continue;
    const auto m = packing == StripPacking::random
                       ? s.moduli.isotropic()
                       : std::optional(IsotropicModuli{s.kinematic.bulk, s.kinematic.shear});
    if (m) points.push_back({m->young() / r.campaign.normal_stiffness, m->poisson()});
  }
  return points;
}

struct Shown {
  Model model;
  std::string name;
  reports::Color color;
};

/// Rigid discs, and soft ones with the full correction, whichever of the two schemes is there.
std::vector<Shown> shown_models(const StripCampaign& s) {
  std::vector<Shown> shown;
  for (const Model m : s.models) {
    if (m == Model::dem) shown.push_back({m, "rigid discs", reports::Color::blue});
    if (m == continuum_model(s, Model::implicit_full))
      shown.push_back({m,
                       fmt::format("kₙ/Eₚ = {:g}, νₚ = {:g}", s.normal_stiffness / s.particle_modulus,
                                   s.particle_poisson_ratio),
                       reports::Color::purple});
  }
  return shown;
}

void add_over_ratio(const StripResults& r, const Shown& shown, Constant constant, reports::Plot& plot) {
  reports::Series random{.name = shown.name, .color = shown.color};
  reports::Series lattice{
      .name = shown.name + ", lattice", .color = shown.color, .dash = reports::Dash::dashed};
  reports::Band span{.name = shown.name, .color = shown.color};
  for (const double ratio : r.campaign.stiffness_ratios) {
    std::vector<double> values;
    for (const DesignPoint& p : packings_of(r, shown.model, ratio, StripPacking::random))
      values.push_back(p.*constant);
    if (!values.empty()) {
      random.x.push_back(ratio), random.y.push_back(sample_statistics(values).value);
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      span.x.push_back(ratio), span.lower.push_back(*low), span.upper.push_back(*high);
    }
    for (const DesignPoint& p : packings_of(r, shown.model, ratio, StripPacking::hexagonal))
      lattice.x.push_back(ratio), lattice.y.push_back(p.*constant);
  }
  if (!span.x.empty()) plot.bands.push_back(span);
  plot.series.push_back(lattice);
  plot.series.push_back(random);
}

void add_over_softness(const DesignStudy& study, Constant constant, reports::Plot& plot) {
  static constexpr reports::Color kColors[] = {reports::Color::green, reports::Color::orange,
                                               reports::Color::vermilion};
  for (std::size_t k = 0; k < study.curves.size(); ++k) {
    const SoftnessCurve& c = study.curves[k];
    reports::Series random{.name = fmt::format("νₚ = {:g}", c.particle_poisson_ratio),
                           .x = study.softness,
                           .color = kColors[k % std::size(kColors)]};
    reports::Series lattice = random;
    lattice.name += ", lattice";
    lattice.dash = reports::Dash::dashed;
    for (const DesignPoint& p : c.random) random.y.push_back(p.*constant);
    for (const DesignPoint& p : c.lattice) lattice.y.push_back(p.*constant);
    plot.series.push_back(lattice);
    plot.series.push_back(random);
  }
}

/// The targets that were reached, of rigid discs over k_t/k_n, of soft ones over k_n/E_p.
void add_targets(const std::vector<CalibrationOutcome>& calibrated, bool soft, Constant constant, reports::Plot& plot) {
  reports::Series points{
      .name = "calibrated", .kind = reports::SeriesKind::markers, .color = reports::Color::black};
  for (const CalibrationOutcome& o : calibrated) {
    if (!o.failure.empty() || !o.feasible || (o.softness > 0.0) != soft) continue;
    const DesignPoint at{o.target_young / o.normal_stiffness, o.target_poisson};
    points.x.push_back(soft ? o.softness : o.stiffness_ratio), points.y.push_back(at.*constant);
  }
  if (!points.x.empty()) plot.series.push_back(points);
}

}  // namespace

reports::Figure design_figure(const std::optional<DesignStudy>& design, const std::vector<CalibrationOutcome>& calibrated, const StripResults& r) {
  reports::Figure figure{.id = "design-curves",
                         .title = "Design curves",
                         .caption =
                             "Choose kₜ/kₙ (rigid discs, above) or kₙ/Eₚ and νₚ (deformable ones, below) on "
                             "the left; read E/kₙ at the same place "
                             "on the right: kₙ is the modulus that you want over it. Full lines: static "
                             "moduli of random packings, above the mean "
                             "over the seeds with their span; dashed: closed forms of the lattice. Points: "
                             "targets that were calibrated, each on its "
                             "curve but for the scatter of packings. Rigid discs end at kₜ = 0, in the "
                             "lattice at ν = 1/3; soft ones lead to their "
                             "own νₚ, and soften the assembly, whichever νₚ they have."};
  for (const Constant q : {&DesignPoint::poisson_ratio, &DesignPoint::young_over_stiffness}) {
    reports::Plot plot = plot_of(q, {.label = "kₜ/kₙ"});
    for (const Shown& shown : shown_models(r.campaign)) add_over_ratio(r, shown, q, plot);
    add_targets(calibrated, false, q, plot);
    figure.panels.push_back(plot);
  }
  if (!design) return figure;
  for (const Constant q : {&DesignPoint::poisson_ratio, &DesignPoint::young_over_stiffness}) {
    reports::Plot plot = plot_of(q, {.label = "kₙ/Eₚ", .scale = reports::Scale::log});
    plot.title = fmt::format("deformable discs, kₜ/kₙ = {:g}", design->stiffness_ratio);
    add_over_softness(*design, q, plot);
    add_targets(calibrated, true, q, plot);
    figure.panels.push_back(plot);
  }
  return figure;
}

}  // namespace ddem::harness
