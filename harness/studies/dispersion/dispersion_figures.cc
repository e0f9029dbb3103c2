#include "harness/studies/dispersion/dispersion_figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ddem::harness {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

reports::Color color_of(const std::string& wave) { return wave == "P" ? reports::Color::vermilion : wave == "shear" ? reports::Color::green : reports::Color::purple; }

/// Amplitude over the largest of the panel.
reports::HeatMap map_of(const DispersionPanel& panel, double zone_boundary) {
  const FkSpectrum& s = panel.spectrum;
  reports::HeatMap map{.value_axis = {.label = "amplitude", .limits = reports::Limits{1e-3, 1.0}}, .scale = reports::ColorScale::log};
  const double largest = s.amplitude.maxCoeff();
  for (const double k : s.wavenumber) map.x.push_back(k / zone_boundary);
  for (std::size_t n = 0; n < s.frequency.size(); ++n) {
    map.y.push_back(s.frequency[n] / kTwoPi);
    for (const double amplitude : s.amplitude.col(static_cast<Eigen::Index>(n))) map.value.push_back(std::max(amplitude / largest, 1e-9));
  }
  return map;
}

reports::Plot plot_of(const DispersionPanel& panel, double zone_boundary, double highest) {
  reports::Plot plot{.title = panel.system,
                     .x = {.label = "wavenumber over zone boundary", .limits = reports::Limits{0.0, 1.0}},
                     .y = {.label = "frequency", .unit = "Hz", .limits = reports::Limits{0.0, highest}},
                     .map = map_of(panel, zone_boundary)};
  for (const DispersionBranch& b : panel.branches) {
    reports::Series line{.name = b.wave + ", exact", .color = color_of(b.wave), .dash = reports::Dash::dashed};
    for (std::size_t n = 0; n < b.wavenumber.size(); ++n) {
      if (b.exact[n] / kTwoPi > highest) break;
      line.x.push_back(b.wavenumber[n] / zone_boundary), line.y.push_back(b.exact[n] / kTwoPi);
    }
    plot.series.push_back(line);
  }
  return plot;
}

}  // namespace

reports::Figure dispersion_figure(const DispersionStudy& study) {
  reports::Figure figure{.id = "dispersion",
                         .title = "Which waves travel: discs and continuum",
                         .caption = "Amplitude over wavenumber and frequency of a strip whose first column was displaced and let go, on a logarithmic scale. Dashed: exact "
                                    "branches, of plane waves in the lattice, of the continuum, and of Rayleigh and Lamb (S0) where the edges are free. Discs follow the "
                                    "continuum for long waves and are slower for short ones; lagged strains damp those away. The faint branch above in the strips of "
                                    "discs is rotation; those of the free strip are its higher modes."};
  const double highest = highest_frequency(study) / kTwoPi;
  for (const DispersionPanel& panel : study.panels) {
    if (panel.spectrum.amplitude.size() > 0) figure.panels.emplace_back(plot_of(panel, study.zone_boundary, highest));
  }
  return figure;
}

reports::Verdict dispersion_verdict(const DispersionPanel& panel) {
  reports::Verdict v{.case_id = "dispersion/" + panel.slug, .title = "Spectrum of waves against exact branches: " + panel.system, .state = reports::State::pass, .reason = panel.failure};
  if (!panel.failure.empty()) {
    v.state = reports::State::error;
    return v;
  }
  for (const DispersionBranch& b : panel.branches) {
    const auto judge = [&](const std::string& metric, double actual, double lower, double upper, const std::string& derivation) {
      reports::Criterion c{.metric = b.wave + ": " + metric, .target = lower, .lower = lower, .upper = upper, .derivation = derivation};
      if (std::isfinite(actual)) {
        c.actual = actual;
        c.state = actual >= lower && actual <= upper ? reports::State::pass : reports::State::fail;
      }
      if (c.state != reports::State::pass && v.state != reports::State::error) v.state = c.state;
      v.criteria.push_back(c);
    };
    judge("largest deviation of a crest", b.worst_deviation(), 0.0, 0.01,
          "up to half the zone boundary; the step's dispersion is (omega dt)^2/24, below 1e-3, a line is found within 0.02 of 2 pi/duration, and reflections add lines beside");
    judge("wavenumbers with a crest", static_cast<double>(b.ridge.size()), b.expected, b.expected, "every one from 8 waves over the strip to half the zone boundary");
  }
  return v;
}

}  // namespace ddem::harness
