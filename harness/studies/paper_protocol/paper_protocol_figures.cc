#include "harness/studies/paper_protocol/paper_protocol_figures.h"

#include "reports/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ddem::harness {
namespace {


double from_p(double p, double s) { return 1.0 - 2.0 * (s / p) * (s / p); }
double from_bar(double bar, double s) { return 0.5 * (bar / s) * (bar / s) - 1.0; }

double mean(const std::vector<double>& values) { return values.empty() ? reports::kNone : sample_statistics(values).value; }

}  // namespace

PaperPoisson paper_poisson(const StripResults& r, Model model, double ratio) {
  std::vector<double> bulk, bulk_bar, strip, waves, measured;
  PaperPoisson out;
  out.ratio = ratio;
  for (const std::int64_t seed : r.campaign.seeds) {
    const StaticOutcome* s = r.find(StripMaterial{StripPacking::random, seed, model, ratio});
    if (s == nullptr || !s->failure.empty() || !s->moduli.stiffness) continue;
    bulk.push_back(from_p(s->speeds.p, s->speeds.shear));
    bulk_bar.push_back(from_bar(directional_speeds(*s->moduli.stiffness, s->moduli.moving_density).bar, s->speeds.shear));
    strip.push_back(from_bar(s->speeds.bar, s->speeds.shear));
    const double disc_area = s->moduli.solid_fraction * r.campaign.length * r.campaign.width / static_cast<double>(r.campaign.discs);
    out.radius_over_width = std::sqrt(disc_area / std::numbers::pi) / r.campaign.width;
    const WaveOutcome* b = r.find(StripCase{StripPacking::random, seed, model, ratio, Protocol::paper, StripWave::bar});
    const WaveOutcome* sh = r.find(StripCase{StripPacking::random, seed, model, ratio, Protocol::paper, StripWave::shear});
    if (b == nullptr || sh == nullptr || !b->speed || !sh->speed) continue;
    measured.push_back(from_bar(*b->speed, *sh->speed));
    waves.push_back(measured.back() - strip.back());
  }
  out.bulk = mean(bulk);
  out.bulk_bar = mean(bulk_bar);
  out.strip = mean(strip);
  out.waves = mean(waves);
  out.measured = mean(measured);
  out.seeds = measured.size();
  out.lowest = measured.empty() ? reports::kNone : *std::min_element(measured.begin(), measured.end());
  out.highest = measured.empty() ? reports::kNone : *std::max_element(measured.begin(), measured.end());
  return out;
}

reports::Figure paper_poisson_figure(const StripResults& r) {
  reports::Figure figure{.id = "paper-poisson",
                         .title = "Poisson's ratio as the paper's protocol reads it",
                         .caption = "From bar and shear velocities of a released column, peak to peak (marks: mean over seeds; shaded: from the lowest to "
                                    "the highest). The bar is a strip with free edges, few discs wide: its edges are softer than its bulk, and the ratio "
                                    "from its static speed (dashed) lies below that of the material (full line, from P and shear) before any wave is sent. "
                                    "What is left between marks and dashed line are errors of the waves; where a later crest of one packing is the highest, its ratio lies far off."};
  std::vector<Model> models = {r.campaign.models.front()};
  if (r.campaign.models.size() > 1) models.push_back(r.campaign.models.back());
  for (const Model model : models) {
    reports::Plot plot{.title = name(model), .x = {.label = "kₜ/kₙ"}, .y = {.label = "Poisson's ratio"}};
    reports::Series bulk{.name = "the material, static", .color = reports::Color::black};
    reports::Series strip{.name = "free strip and shear, static", .color = reports::Color::blue, .dash = reports::Dash::dashed};
    reports::Series measured{.name = "the paper's protocol", .kind = reports::SeriesKind::markers, .color = reports::Color::vermilion};
    reports::Band band{.name = measured.name, .color = measured.color};
    for (const double ratio : r.campaign.stiffness_ratios) {
      const PaperPoisson p = paper_poisson(r, model, ratio);
      bulk.x.push_back(p.ratio), bulk.y.push_back(p.bulk);
      strip.x.push_back(p.ratio), strip.y.push_back(p.strip);
      measured.x.push_back(p.ratio), measured.y.push_back(p.measured);
      band.x.push_back(p.ratio), band.lower.push_back(p.lowest), band.upper.push_back(p.highest);
    }
    plot.series = {bulk, strip, measured};
    plot.bands = {band};
    plot.references.push_back({.value = 1.0 / 3.0, .label = "1/3, dense DEM"});
    figure.panels.emplace_back(plot);
  }
  return figure;
}

reports::Table paper_poisson_table(const StripResults& r) {
  reports::Table t;
  t.caption = "From the material's Poisson's ratio to what the paper's protocol reads: static values, what each step adds, and the seeds that gave both "
              "velocities (the wave's error is a mean over these).";
  t.columns = {{"model"}, {"kₜ/kₙ", "", 3}, {"ν of the material", "", 3}, {"anisotropy", "", 2}, {"free edges", "", 2}, {"waves", "", 2}, {"seeds", "", 2}, {"ν read", "", 3}};
  for (const Model model : r.campaign.models) {
    for (const double ratio : r.campaign.stiffness_ratios) {
      const PaperPoisson p = paper_poisson(r, model, ratio);
      t.rows.push_back({name(model), p.ratio, p.bulk, p.bulk_bar - p.bulk, p.strip - p.bulk_bar, p.waves, p.seeds, p.measured});
    }
  }
  return t;
}

}  // namespace ddem::harness
