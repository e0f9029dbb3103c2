#include "harness/studies/statics/statics_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/studies/waves/waves_figures.h"
#include "harness/studies/waves/pickers.h"
#include "reports/number.h"

namespace ddem::harness {
namespace {

constexpr double kLeastShown = 1e-16;  // half a bit: what is exact has a place on a logarithmic axis
constexpr std::array kBulkWaves = {StripWave::shear, StripWave::p};

struct Way {
  const char* name;
  std::optional<double> SpeedErrors::*error;
  reports::Color color;
};
constexpr std::array<Way, 2> kWithoutSteps = {{{"static", &SpeedErrors::statics, reports::Color::blue},
                                               {"Bloch limit", &SpeedErrors::bloch, reports::Color::green}}};
constexpr std::array<Way, 2> kDriven = {
    {{"pulse, by peak", &SpeedErrors::peak, reports::Color::vermilion},
     {"pulse, by centroid", &SpeedErrors::centroid, reports::Color::orange}}};

/// The two whose waves have no error of their own in the step; of a campaign without them, all.
std::vector<Model> static_models(const StripCampaign& s) {
  std::vector<Model> shown;
  for (const Model m : s.models) {
    if (m == Model::dem || m == Model::implicit_full) shown.push_back(m);
  }
  return shown.empty() ? s.models : shown;
}

const StaticOutcome* lattice_of(const StripResults& r, Model model, double ratio) {
  return r.find(StripMaterial{StripPacking::hexagonal, 0, model, ratio});
}

const WaveOutcome* pulse_in(const StripResults& r, const StripMaterial& key, StripWave wave) {
  return r.find(StripCase{key.packing, key.seed, key.model, key.stiffness_ratio, Protocol::long_wave, wave});
}

/// A gap where there is none.
double on_log_axis(const std::optional<double>& error) {
  return error ? std::max(std::abs(*error), kLeastShown) : reports::kNone;
}

reports::Plot error_panel(const StripResults& r, Model model, StripWave wave) {
  reports::Plot plot{.title = fmt::format("{} wave, {}", name(wave), name(model)),
                     .x = {.label = "kₜ/kₙ"},
                     .y = {.label = "|error| of the speed", .scale = reports::Scale::log}};
  const auto add = [&](const Way& way) {
    reports::Series series{.name = way.name, .kind = reports::SeriesKind::line_markers, .color = way.color};
    for (const double ratio : r.campaign.stiffness_ratios) {
      const StaticOutcome* s = lattice_of(r, model, ratio);
      if (s == nullptr) continue;
      const SpeedErrors errors = lattice_errors(r, *s, wave);
      series.x.push_back(ratio);
      series.y.push_back(on_log_axis(errors.*way.error));
    }
    plot.series.push_back(series);
  };
  for (const Way& way : kWithoutSteps) add(way);
  if (!r.has_waves()) return plot;
  for (const Way& way : kDriven) add(way);
  return plot;
}

/// Mean wall time of the lattice's pulses; empty where none was run.
std::optional<double> pulse_seconds(const StripResults& r, const StripMaterial& key) {
  const WaveOutcome* w = pulse_in(r, key, StripWave::shear);
  return w != nullptr && w->steps > 0 ? std::optional(w->seconds) : std::nullopt;
}

}  // namespace

SpeedErrors lattice_errors(const StripResults& r, const StaticOutcome& s, StripWave wave) {
  SpeedErrors errors;
  if (!s.failure.empty()) return errors;
  const double closed = s.kinematic_speeds.of(wave);
  errors.statics = relative_error(s.speeds.of(wave), closed);
  if (s.bloch) errors.bloch = relative_error(wave == StripWave::shear ? s.bloch->shear : s.bloch->p, closed);
  if (const WaveOutcome* w = pulse_in(r, s.key, wave)) {
    errors.peak = relative_error(w->speed, closed);
    errors.centroid = relative_error(w->centroid_speed, closed);
  }
  return errors;
}

reports::Figure speed_error_figure(const StripResults& r) {
  reports::Figure figure{
      .id = "speed-errors",
      .title = "Wave speeds with and without time steps",
      .caption =
          "How far the speeds of shear and P waves in the lattice are from the closed form, by static moduli "
          "of the "
          "very strip, by the long-wave limit of its plane waves (Bloch), and by driven pulses. Statics are "
          "at "
          "round-off, Bloch limits below 1e-9; a pulse is off by its dispersion, most by its peak, ten times "
          "less by its centroid, which travels as infinitely long waves do. Gaps: not measured."};
  if (!r.has_waves()) figure.caption += " No pulse was sent here: ddem validate without --static adds them.";
  for (const Model model : static_models(r.campaign)) {
    for (const StripWave wave : kBulkWaves) figure.panels.push_back(error_panel(r, model, wave));
  }
  return figure;
}

reports::Table speed_error_table(const StripResults& r) {
  reports::Table t;
  t.caption =
      "Relative errors of speeds in the lattice against the closed form, and wall times among the campaign's "
      "other work: of "
      "the strip's moduli (free and periodic edges, factorised and solved), of the Bloch limit, and of one "
      "driven pulse.";
  t.columns = {{"model"}, {"kₜ/kₙ", "", 3}};
  const auto add_columns = [&](StripWave wave, const Way& way) {
    t.columns.push_back({fmt::format("{}, {}", name(wave), way.name), "", 2});
  };
  for (const StripWave wave : kBulkWaves) {
    for (const Way& way : kWithoutSteps) add_columns(wave, way);
    for (const Way& way : kDriven) add_columns(wave, way);
  }
  for (const char* what : {"static", "Bloch limit", "a pulse"}) t.columns.push_back({what, "s", 2});
  for (const Model model : static_models(r.campaign)) {
    for (const double ratio : r.campaign.stiffness_ratios) {
      const StaticOutcome* s = lattice_of(r, model, ratio);
      if (s == nullptr) continue;
      std::vector<reports::Cell> row = {name(model), ratio};
      for (const StripWave wave : kBulkWaves) {
        const SpeedErrors errors = lattice_errors(r, *s, wave);
        for (const Way& way : kWithoutSteps) row.emplace_back((errors.*way.error).value_or(reports::kNone));
        for (const Way& way : kDriven)
          row.push_back(r.has_waves() ? reports::Cell((errors.*way.error).value_or(reports::kNone))
                                      : reports::Cell("not run"));
      }
      row.emplace_back(s->failure.empty() ? s->solve_seconds : reports::kNone);
      row.emplace_back(s->bloch ? s->bloch->seconds : reports::kNone);
      row.push_back(r.has_waves() ? reports::Cell(pulse_seconds(r, s->key).value_or(reports::kNone))
                                  : reports::Cell("not run"));
      t.rows.push_back(row);
    }
  }
  return t;
}

reports::Figure static_speed_figure(const StripResults& r) {
  reports::Figure figure{
      .id = "static-velocities",
      .title = "Static wave velocities over kₜ/kₙ, random packings",
      .caption =
          "Full lines: mean over the seeds of the directional speeds that static moduli give (shaded: from "
          "the "
          "lowest seed to the highest), for the bar of the very strip with its free edges. Dotted: kinematic "
          "estimate, every disc strained alike, which is too stiff."};
  for (const StripWave wave : {StripWave::bar, StripWave::shear, StripWave::p}) {
    reports::Plot plot{.title = fmt::format("{} wave", name(wave)),
                       .x = {.label = "kₜ/kₙ"},
                       .y = {.label = "velocity", .unit = "m/s"}};
    for (const Model model : r.campaign.models) {
      if (continuum_model(r.campaign, model) != model) continue;  // the same equilibrium
      const reports::Color color = color_of(model);
      reports::Series mean{.name = name(model), .color = color};
      reports::Series kinematic{
          .name = name(model) + ", kinematic", .color = color, .dash = reports::Dash::dotted};
      reports::Band span{.name = name(model), .color = color};
      for (const double ratio : r.campaign.stiffness_ratios) {
        std::vector<double> speeds, estimates;
        for (const std::int64_t seed : r.campaign.seeds) {
          const StaticOutcome* s = r.find(StripMaterial{StripPacking::random, seed, model, ratio});
          if (s == nullptr || !s->failure.empty()) continue;
          speeds.push_back(s->speeds.of(wave)), estimates.push_back(s->kinematic_speeds.of(wave));
        }
        if (speeds.empty()) continue;
        const auto [low, high] = std::minmax_element(speeds.begin(), speeds.end());
        mean.x.push_back(ratio), mean.y.push_back(sample_statistics(speeds).value);
        span.x.push_back(ratio), span.lower.push_back(*low), span.upper.push_back(*high);
        kinematic.x.push_back(ratio), kinematic.y.push_back(sample_statistics(estimates).value);
      }
      if (mean.x.empty()) continue;
      plot.bands.push_back(span);
      plot.series.push_back(mean);
      plot.series.push_back(kinematic);
    }
    figure.panels.push_back(plot);
  }
  return figure;
}

}  // namespace ddem::harness
