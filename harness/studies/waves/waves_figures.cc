#include "harness/studies/waves/waves_figures.h"

#include "reports/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ddem::harness {
namespace {


constexpr std::size_t kShownPairs = 2;  // A and B, as in the paper

std::vector<double> times(const Recording& recording, std::size_t samples) {
  std::vector<double> t(samples);
  for (std::size_t n = 0; n < samples; ++n) t[n] = static_cast<double>(n) * recording.sample_interval;
  return t;
}

/// NaN without values, or where one is not a number.
std::pair<double, double> range_of(const std::vector<double>& values) {
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  for (const double v : values) {
    if (std::isnan(v)) return {reports::kNone, reports::kNone};
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
  }
  return values.empty() ? std::pair{reports::kNone, reports::kNone} : std::pair{lowest, highest};
}

reports::Plot velocity_panel(const StripResults& r, StripWave wave) {
  reports::Plot plot{.title = fmt::format("{} wave", name(wave)), .x = {.label = "kₜ/kₙ"}, .y = {.label = "velocity", .unit = "m/s"}};
  for (const Model model : r.campaign.models) {
    reports::Series measured{.name = name(model), .kind = reports::SeriesKind::markers, .color = color_of(model)};
    reports::Series statics{.name = name(model) + ", static", .color = color_of(model)};
    reports::Band seeds{.name = name(model), .color = color_of(model)};
    reports::Series kinematic{.name = name(model) + ", kinematic", .color = color_of(model), .dash = reports::Dash::dotted};
    for (const double ratio : r.campaign.stiffness_ratios) {
      const SpeedPoint s = random_speed(r, model, ratio, Protocol::long_wave, wave);
      measured.x.push_back(ratio), measured.y.push_back(s.measured.value);
      seeds.x.push_back(ratio), seeds.lower.push_back(s.lowest), seeds.upper.push_back(s.highest);
      statics.x.push_back(ratio), statics.y.push_back(s.statics);
      kinematic.x.push_back(ratio), kinematic.y.push_back(s.kinematic);
    }
    plot.bands.push_back(seeds);
    plot.series.push_back(measured);
    plot.series.push_back(statics);
    plot.series.push_back(kinematic);
  }
  reports::Series fem{.name = "finite elements (first seed)", .kind = reports::SeriesKind::markers, .color = reports::Color::black};
  for (const FemOutcome& f : r.fem) {
    if (f.wave != wave || f.uniaxial) continue;
    fem.x.push_back(f.key.stiffness_ratio);
    fem.y.push_back(f.speed.value_or(reports::kNone));
  }
  if (!fem.x.empty()) plot.series.push_back(fem);
  return plot;
}

}  // namespace

reports::Color color_of(Model model) {
  switch (model) {
    case Model::dem: return reports::Color::blue;
    case Model::lagged_normal: return reports::Color::vermilion;
    case Model::lagged_full: return reports::Color::green;
    case Model::implicit_full: return reports::Color::purple;
  }
  return reports::Color::automatic;
}

SpeedPoint random_speed(const StripResults& r, Model model, double ratio, Protocol protocol, StripWave wave) {
  std::vector<double> measured, statics, kinematic;
  for (const std::int64_t seed : r.campaign.seeds) {
    const WaveOutcome* w = r.find(StripCase{StripPacking::random, seed, model, ratio, protocol, wave});
    if (w != nullptr && w->speed) measured.push_back(*w->speed);
    statics.push_back(w != nullptr ? w->static_speed : reports::kNone);
    kinematic.push_back(w != nullptr ? w->kinematic_speed : reports::kNone);
  }
  const Uncertain mean = measured.empty() ? Uncertain{reports::kNone, reports::kNone} : sample_statistics(measured);
  const auto [lowest, highest] = range_of(measured);
  return {mean, lowest, highest, sample_statistics(statics).value, sample_statistics(kinematic).value};
}

PoissonCurve poisson_curve(const StripResults& r, Model model) {
  PoissonCurve curve;
  const auto nu = [](double p, double s) { return 1.0 - 2.0 * (s / p) * (s / p); };
  for (const double ratio : r.campaign.stiffness_ratios) {
    std::vector<double> measured, statics;
    for (const std::int64_t seed : r.campaign.seeds) {
      const WaveOutcome* p = r.find(StripCase{StripPacking::random, seed, model, ratio, Protocol::long_wave, StripWave::p});
      const WaveOutcome* s = r.find(StripCase{StripPacking::random, seed, model, ratio, Protocol::long_wave, StripWave::shear});
      const bool both = p != nullptr && s != nullptr;
      measured.push_back(both ? nu(p->speed.value_or(reports::kNone), s->speed.value_or(reports::kNone)) : reports::kNone);
      statics.push_back(both ? nu(p->static_speed, s->static_speed) : reports::kNone);
    }
    const Uncertain m = sample_statistics(measured);
    curve.ratio.push_back(ratio);
    curve.mean.push_back(m.value);
    const auto [lowest, highest] = range_of(measured);
    curve.lowest.push_back(lowest);
    curve.highest.push_back(highest);
    curve.statics.push_back(sample_statistics(statics).value);
  }
  return curve;
}

reports::Figure poisson_figure(const StripResults& r) {
  reports::Plot random{.title = "random packings", .x = {.label = "kₜ/kₙ"}, .y = {.label = "Poisson's ratio"}};
  reports::Plot lattice{.title = "hexagonal lattice", .x = {.label = "kₜ/kₙ"}, .y = {.label = "Poisson's ratio"}};
  for (const Model model : r.campaign.models) {
    const PoissonCurve c = poisson_curve(r, model);
    random.series.push_back({.name = name(model), .kind = reports::SeriesKind::markers, .x = c.ratio, .y = c.mean, .color = color_of(model)});
    random.bands.push_back({.name = name(model), .x = c.ratio, .lower = c.lowest, .upper = c.highest, .color = color_of(model)});
    random.series.push_back({.name = name(model) + ", reference", .x = c.ratio, .y = c.statics, .color = color_of(model)});
    reports::Series measured{.name = name(model), .kind = reports::SeriesKind::markers, .color = color_of(model)};
    reports::Series closed{.name = name(model) + ", reference", .color = color_of(model)};
    for (const StaticOutcome& s : r.statics) {
      if (s.key.packing != StripPacking::hexagonal || s.key.model != model) continue;
      const WaveOutcome* p = r.find(StripCase{StripPacking::hexagonal, 0, model, s.key.stiffness_ratio, Protocol::long_wave, StripWave::p});
      const WaveOutcome* sh = r.find(StripCase{StripPacking::hexagonal, 0, model, s.key.stiffness_ratio, Protocol::long_wave, StripWave::shear});
      const bool both = p != nullptr && sh != nullptr && p->speed && sh->speed;
      measured.x.push_back(s.key.stiffness_ratio);
      measured.y.push_back(both ? 1.0 - 2.0 * (*sh->speed / *p->speed) * (*sh->speed / *p->speed) : reports::kNone);
      closed.x.push_back(s.key.stiffness_ratio);
      closed.y.push_back((s.kinematic.bulk - s.kinematic.shear) / (s.kinematic.bulk + s.kinematic.shear));
    }
    lattice.series.push_back(measured);
    lattice.series.push_back(closed);
  }
  for (reports::Plot* plot : {&random, &lattice}) {
    plot->references.push_back({.value = 1.0 / 3.0, .label = "1/3, dense DEM"});
  }
  return {.id = "poisson-ratio",
          .title = "Poisson's ratio over kₜ/kₙ",
          .caption = "Marks: from P and shear velocities (shaded: from the lowest seed to the highest). Lines: static moduli of the same packings (left), closed "
                     "form (right). Correcting both overlaps (F) draws ν towards the discs' own νₚ at every kₜ/kₙ; the published correction of the "
                     "normal overlap alone (N) moves it less. Dense DEM cannot exceed 1/3; packings with fewer bonds a disc do.",
          .panels = {random, lattice}};
}

reports::Figure velocity_figure(const StripResults& r) {
  return {.id = "velocities",
          .title = "Wave velocities over kₜ/kₙ, random packings",
          .caption = "Marks: measured on driven pulses (shaded: from the lowest seed to the highest). Full lines: static directional speeds of the same packings, for "
                     "the bar of the very strip with its free edges. Dotted: kinematic estimate, which no packing exceeds.",
          .panels = {velocity_panel(r, StripWave::bar), velocity_panel(r, StripWave::shear), velocity_panel(r, StripWave::p)}};
}

reports::Figure strip_figure(const StripPicture& p) {
  reports::Strip strip{.x = p.packing.x, .y = p.packing.y, .radius = p.packing.radius, .value = p.displacement,
                       .value_axis = {.label = "displacement along x", .unit = "m"}};
  for (std::size_t k = 0; k < p.probe_x.size(); ++k) strip.probes.push_back({p.probe_x[k], p.probe_y[k], p.probe_labels[k]});
  return {.id = "strip",
          .title = "The random strip and its probes",
          .caption = fmt::format("{} discs of the first seed, {:.1f} µs after the release of the discs at the left edge (bar). The wave travels from left to "
                                 "right; velocities are measured from A1 to A2, B1 to B2 and so on.",
                                 p.packing.size(), p.time * 1e6),
          .panels = {strip}};
}

reports::Figure paper_figure(const StripResults& r) {
  reports::Figure figure{.id = "paper-signals",
                         .title = "Displacement over time at pairs A and B, column release",
                         .caption = "Full line: the disc nearer to the source, dashed: the one further on. Rings: the picked peaks, whose delay gives the "
                                    "velocity of the pair. First seed, plain DEM; the other three pairs are in results.h5."};
  const double ratio = shown_ratio(r.campaign);
  for (const StripWave wave : {StripWave::bar, StripWave::shear}) {
    const WaveOutcome* w = r.find(StripCase{StripPacking::random, r.campaign.seeds.front(), r.campaign.models.front(), ratio, Protocol::paper, wave});
    reports::Plot plot{.title = fmt::format("{}, kₜ/kₙ = {:g}", name(wave), ratio), .x = {.label = "time", .unit = "s"}, .y = {.label = "displacement", .unit = "m"}};
    if (w != nullptr) {
      for (std::size_t p = 0; p < std::min(kShownPairs * 2, w->recording.signals.size()); ++p) {
        const PickedSignal& s = w->recording.signals[p];
        const std::string label = fmt::format("{}{}", static_cast<char>('A' + static_cast<int>(p / 2)), p % 2 + 1);
        static constexpr reports::Color kColors[kShownPairs] = {reports::Color::blue, reports::Color::vermilion};
        plot.series.push_back({.name = label, .x = times(w->recording, s.values.size()), .y = s.values, .color = kColors[p / 2],
                               .dash = p % 2 == 0 ? reports::Dash::solid : reports::Dash::dashed});
        if (s.pick_time) plot.picks.push_back({.x = *s.pick_time, .y = s.pick_amplitude, .series = label});
      }
    }
    figure.panels.emplace_back(plot);
  }
  figure.columns = 1;
  return figure;
}

reports::Figure waveform_figure(const StripResults& r) {
  reports::Figure figure{.id = "waveforms",
                         .title = "Particles over continuum: a driven pulse at two sections",
                         .caption = "Full lines: particles, averaged over the discs of a section. Dashed: finite elements with the static moduli of the same "
                                    "packing. Where the strains of the discs lag by a step, they damp the pulse a little."};
  const double ratio = shown_ratio(r.campaign);
  for (const StripWave wave : {StripWave::bar, StripWave::shear}) {
    reports::Plot plot{.title = fmt::format("{}, kₜ/kₙ = {:g}", name(wave), ratio), .x = {.label = "time", .unit = "s"}, .y = {.label = "displacement", .unit = "m"}};
    for (const Model model : r.campaign.models) {
      const StripMaterial key{StripPacking::random, r.campaign.seeds.front(), model, ratio};
      const WaveOutcome* w = r.find(StripCase{key.packing, key.seed, model, ratio, Protocol::long_wave, wave});
      const FemOutcome* f = r.find(key, wave);
      for (const std::size_t p : {0u, 1u}) {
        if (w != nullptr && p < w->recording.signals.size()) {
          const auto& v = w->recording.signals[p].values;
          plot.series.push_back({.name = name(model), .x = times(w->recording, v.size()), .y = v, .color = color_of(model)});
        }
        if (f != nullptr && p < f->recording.signals.size()) {
          const auto& v = f->recording.signals[p].values;
          plot.series.push_back({.name = name(model) + ", finite elements", .x = times(f->recording, v.size()), .y = v, .color = color_of(model), .dash = reports::Dash::dashed});
        }
      }
    }
    figure.panels.emplace_back(plot);
  }
  figure.columns = 1;
  return figure;
}

}  // namespace ddem::harness
