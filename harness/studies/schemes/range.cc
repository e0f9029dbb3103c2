#include "harness/studies/schemes/range.h"

#include <fmt/format.h>

#include "dem/statics/moduli.h"
#include "harness/model/assemble.h"
#include "harness/studies/strip/whole.h"

namespace ddem::harness {
namespace {

double poisson_ratio(const ddem::Assembly& a, const ContactParameters& contact, const DeformationParameters& discs, double edge_band) {
  return isotropic_part(homogenise_strip(a, contact, discs, edge_band)).poisson();
}

}  // namespace

void require_whole(const RangeStudy& found) {
  GroupNames names;
  for (const RangeCurve& c : found.curves) {
    names.add(fmt::format("{:g}", c.particle_poisson_ratio));
    require(!c.ranges.empty(), "a curve without points");
    require_length("a curve", c.ranges.size(), found.softness.size());
  }
}

RangeStudy study_range(const StripCampaign& s) {
  RangeStudy study;
  study.softness = {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0};
  try {
    const StripCase c{StripPacking::random, s.seeds.front(), Model::dem, 0.0, Protocol::long_wave, StripWave::p};
    const Scene scene = scene_of(assembly_text(s, c, false), "range");
    const ddem::Assembly a = build_assembly(scene);
    const auto range = [&](const DeformationParameters& discs) {
      ContactParameters contact;
      contact.normal_stiffness = s.normal_stiffness;
      contact.stiffness_ratio = 1.0;
      const double lowest = poisson_ratio(a, contact, discs, edge_band(scene, a));
      contact.stiffness_ratio = 0.0;
      return PoissonRange{lowest, poisson_ratio(a, contact, discs, edge_band(scene, a))};
    };
    study.rigid = range({});
    for (const double nu_p : {0.0, 0.2, 0.3, 0.4, 0.49}) {
      RangeCurve curve{nu_p, {}};
      for (const double softness : study.softness) {
        DeformationParameters discs;
        discs.scheme = Scheme::implicit;
        discs.correction = Correction::full;
        discs.young_modulus = s.normal_stiffness / softness;
        discs.poisson_ratio = nu_p;
        curve.ranges.push_back(range(discs));
      }
      study.curves.push_back(curve);
    }
  } catch (const std::exception& e) {
    study.failure = e.what();
  }
  return study;
}

reports::Figure range_figure(const RangeStudy& study) {
  static constexpr reports::Color kColors[] = {reports::Color::blue, reports::Color::sky, reports::Color::green, reports::Color::orange, reports::Color::vermilion};
  reports::Plot plot{.x = {.label = "kₙ/Eₚ", .scale = reports::Scale::log}, .y = {.label = "Poisson's ratio"}};
  for (std::size_t k = 0; k < study.curves.size(); ++k) {
    const RangeCurve& c = study.curves[k];
    const std::string name = fmt::format("νₚ = {:g}", c.particle_poisson_ratio);
    reports::Series low{.name = name, .x = study.softness, .color = kColors[k % std::size(kColors)]}, high = low;
    for (const PoissonRange& r : c.ranges) low.y.push_back(r.lowest), high.y.push_back(r.highest);
    plot.series.push_back(low);
    plot.series.push_back(high);
  }
  plot.references = {{.value = study.rigid.lowest, .label = "rigid, kₜ = kₙ"}, {.value = study.rigid.highest, .label = "rigid, kₜ = 0"}};
  return {.id = "poisson-range",
          .title = "Which Poisson's ratios can be reached",
          .caption = "For each νₚ two lines, kₜ/kₙ = 1 below and 0 above: what lies between them can be reached by choosing kₜ/kₙ. Static moduli of the "
                     "first random packing, full correction, converged strains. Soft discs draw everything towards their own νₚ: a high νₚ lifts the "
                     "range above what rigid discs allow, and at the same time narrows it.",
          .panels = {plot}};
}

}  // namespace ddem::harness
