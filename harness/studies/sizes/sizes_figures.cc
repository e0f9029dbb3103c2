#include "harness/studies/sizes/sizes_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ddem::harness {
namespace {

constexpr reports::Color kRatioColors[] = {reports::Color::vermilion, reports::Color::blue, reports::Color::green, reports::Color::orange};

reports::Series marks(const std::string& name, const std::vector<SizeMean>& means, reports::Color color) {
  reports::Series s{.name = name, .kind = reports::SeriesKind::markers, .color = color};
  for (const SizeMean& m : means) {
    s.x.push_back(m.radius_over_width);
    s.y.push_back(100.0 * m.value.value);
    s.error.push_back(100.0 * m.value.stddev);
  }
  return s;
}

/// From 0 to a little beyond the coarsest strip.
std::vector<double> abscissa(const std::vector<SizeMean>& means) {
  std::vector<double> x;
  const double end = means.empty() ? 0.0 : 1.08 * means.front().radius_over_width;
  for (int k = 0; k <= 40; ++k) x.push_back(end * k / 40.0);
  return x;
}

reports::Plot bias_panel(const SizeStudy& study) {
  reports::Plot plot{.title = "free strip over bulk, static bar speed",
                     .x = {.label = "mean radius / width"},
                     .y = {.label = "bias, %"}};
  for (std::size_t k = 0; k < study.stiffness_ratios.size(); ++k) {
    const auto random = study.mean_bias(StripPacking::random, k), lattice = study.mean_bias(StripPacking::hexagonal, k);
    const double ratio = study.stiffness_ratios[k];
    const reports::Color color = kRatioColors[k % std::size(kRatioColors)];
    plot.series.push_back(marks(fmt::format("random, kₜ/kₙ = {:g}", ratio), random, color));
    const PowerLaw law = power_law(random);
    reports::Series fit{.name = fmt::format("∝ (radius/width)^{1:.2f}, kₜ/kₙ = {0:g}", ratio, law.power), .x = abscissa(random), .color = color};
    for (const double x : fit.x) fit.y.push_back(x > 0.0 ? 100.0 * law.slope * std::pow(x, law.power) : 0.0);
    plot.series.push_back(fit);
    if (ratio == 0.0) continue;  // the lattice has none
    plot.series.push_back(marks(fmt::format("lattice, kₜ/kₙ = {:g}", ratio), lattice, reports::Color::grey));
    reports::Series closed{.name = "lattice, closed form", .x = abscissa(lattice), .color = reports::Color::grey, .dash = reports::Dash::dashed};
    for (const double x : closed.x) {  // rows = width / (sqrt(3) r)
      closed.y.push_back(x > 0.0 ? 100.0 * hexagonal_width_bias(ratio, 1.0 / (std::sqrt(3.0) * x)) : 0.0);
    }
    plot.series.push_back(closed);
  }
  return plot;
}

reports::Plot wave_panel(const SizeStudy& study, StripPacking packing) {
  double coarsest = 0.0;
  for (const SizedStrip& s : study.strips) coarsest = std::max(coarsest, s.radius_over_width);
  reports::Plot plot{.title = fmt::format("waves over statics, {}, kₜ/kₙ = {:g}", packing == StripPacking::random ? "random" : "lattice", study.stiffness_ratios.back()),
                     .x = {.label = "mean radius / width", .limits = reports::Limits{0.0, 1.08 * coarsest}},
                     .y = {.label = "error of the speed, %"}};
  plot.series.push_back(marks("shear", study.mean_error(packing, StripWave::shear), reports::Color::purple));
  plot.series.push_back(marks("P", study.mean_error(packing, StripWave::p), reports::Color::sky));
  plot.series.push_back(marks("bar, S0 taken out", study.mean_error(packing, StripWave::bar), reports::Color::orange));
  for (reports::Series& s : plot.series) s.kind = reports::SeriesKind::line_markers;
  plot.references.push_back({.value = 0.0});
  return plot;
}

}  // namespace

reports::Figure size_figure(const SizeStudy& study) {
  return {.id = "sizes",
          .title = "What the strip's width in discs does",
          .caption = "The same strip out of 4 and 16 times as many discs; bars: scatter of single packings. First: free edges soften the bar, in "
                     "proportion to radius over width, whether it is measured in waves or statically. It is no property of the material, and the "
                     "largest error of a Poisson's ratio from bar and shear velocities. Then: speeds of driven pulses, by centroid, against the "
                     "static speeds between the same sections (bar: of the pulled strip): their mean does not depend on the size, their scatter shrinks.",
          .panels = {bias_panel(study), wave_panel(study, StripPacking::random), wave_panel(study, StripPacking::hexagonal)}};
}

reports::Table size_table(const SizeStudy& study) {
  reports::Table t;
  t.caption = "Mean and scatter of single packings, %. Bias: static bar speed of the free strip over its bulk's. Waves: driven pulse, by centroid, "
              "over the static speed between the same sections (bar: of the pulled strip, times what S0 makes of it).";
  t.columns = {{"packing"}, {"discs"}, {"strips", "", 3}, {"cells", "", 3}, {"radius/width", "", 3}};
  for (const double ratio : study.stiffness_ratios) {
    t.columns.push_back({fmt::format("bias, kₜ/kₙ = {:g}", ratio), "%", 3});
    t.columns.push_back({"±", "%", 2});
  }
  for (const char* wave : {"bar", "shear", "P"}) {
    t.columns.push_back({fmt::format("{} wave", wave), "%", 2});
    t.columns.push_back({"±", "%", 2});
  }
  for (const StripPacking packing : {StripPacking::hexagonal, StripPacking::random}) {
    std::vector<std::vector<SizeMean>> columns;
    for (std::size_t k = 0; k < study.stiffness_ratios.size(); ++k) columns.push_back(study.mean_bias(packing, k));
    for (const StripWave wave : {StripWave::bar, StripWave::shear, StripWave::p}) columns.push_back(study.mean_error(packing, wave));
    for (std::size_t size = 0; size < columns.front().size(); ++size) {
      const double x = columns.front()[size].radius_over_width;
      const auto strip = std::min_element(study.strips.begin(), study.strips.end(), [&](const SizedStrip& a, const SizedStrip& b) {
        const auto off = [&](const SizedStrip& s) { return s.packing == packing && s.failure.empty() ? std::abs(s.radius_over_width - x) : HUGE_VAL; };
        return off(a) < off(b);
      });
      std::vector<reports::Cell> row = {packing == StripPacking::random ? "random" : "lattice", strip->discs, columns.front()[size].strips, strip->cells, x};
      for (const auto& column : columns) {
        row.insert(row.end(), {100.0 * column[size].value.value, 100.0 * column[size].value.stddev});
      }
      t.rows.push_back(row);
    }
  }
  return t;
}

}  // namespace ddem::harness
