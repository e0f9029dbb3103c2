#include "harness/studies/waves/waves_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/studies/waves/waves_figures.h"

namespace ddem::harness {
namespace {

struct Reach {
  Model model = Model::dem;
  double lowest = 0.0, highest = 0.0;
};

std::optional<Reach> reach_of(const StripResults& r, Model model) {
  std::vector<double> nu = poisson_curve(r, model).mean;
  std::erase_if(nu, [](double v) { return !std::isfinite(v); });
  if (nu.empty()) return std::nullopt;
  const auto [lowest, highest] = std::minmax_element(nu.begin(), nu.end());
  return Reach{model, *lowest, *highest};
}

/// Mean wall time of the long waves of a model through random packings, s; 0 without one. All models send the same waves.
double seconds_a_wave(const StripResults& r, Model model) {
  double seconds = 0.0;
  int waves = 0;
  for (const WaveOutcome& w : r.waves) {
    if (w.c.protocol != Protocol::long_wave || w.c.packing != StripPacking::random || w.c.model != model || !w.speed) continue;
    seconds += w.seconds;
    ++waves;
  }
  return waves > 0 ? seconds / waves : 0.0;
}

std::string text_of(const Reach& r) {
  return r.highest > r.lowest ? fmt::format("from {:.3f} to {:.3f}", r.lowest, r.highest) : fmt::format("of {:.3f}", r.highest);
}

std::string reach_sentence(const StripResults& r) {
  const std::optional<Reach> dem = reach_of(r, Model::dem);
  std::optional<Reach> best;
  for (const Model model : r.campaign.models) {
    const std::optional<Reach> reach = model == Model::dem ? std::nullopt : reach_of(r, model);
    if (reach && (!best || reach->highest > best->highest)) best = reach;
  }
  if (!dem || !best) return "";
  std::string text = fmt::format("In random packings {} reaches Poisson's ratios {}, DEM {}", name(best->model), text_of(*best), text_of(*dem));
  text += best->highest - dem->highest >= 0.0005 ? fmt::format(": {:.3f} beyond it.", best->highest - dem->highest) : ": no more.";
  const double cost = seconds_a_wave(r, best->model), of_dem = seconds_a_wave(r, Model::dem);
  if (cost > 0.0 && of_dem > 0.0) text += fmt::format(" Its waves cost {:.1f} times the computing time of DEM's.", cost / of_dem);
  return text;
}

enum class Kind { bulk, bar };  // bulk: P and shear

/// |speed / reference - 1| of the long waves of a kind through a packing, in order.
template <class Reference>
std::vector<double> deviations(const StripResults& r, StripPacking packing, Kind kind, const Reference& reference) {
  std::vector<double> all;
  for (const WaveOutcome& w : r.waves) {
    const bool wanted = w.c.protocol == Protocol::long_wave && w.c.packing == packing && (w.c.wave == StripWave::bar) == (kind == Kind::bar);
    const double right = wanted ? reference(w) : 0.0;
    if (w.speed && right > 0.0) all.push_back(std::abs(*w.speed / right - 1.0));
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::string within(const std::vector<double>& sorted) {
  const double median = 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
  return fmt::format("{:.2f} % (median {:.2f} %, waves: {})", 100.0 * sorted.back(), 100.0 * median, sorted.size());
}

std::string bulk_sentence(const std::vector<double>& sorted, const char* of_what, const char* reference) {
  return sorted.empty() ? "" : fmt::format("P and shear waves through {} run within {} of {}.", of_what, within(sorted), reference);
}

/// A bar's waves disperse: what S0 makes of the static speed is what they should have.
std::string bar_sentence(const StripResults& r) {
  const std::vector<double> of_static = deviations(r, StripPacking::random, Kind::bar, [](const WaveOutcome& w) { return w.static_speed; });
  const std::vector<double> of_s0 = deviations(r, StripPacking::random, Kind::bar, [](const WaveOutcome& w) { return w.s0.peak.value_or(0.0); });
  if (of_static.empty()) return "";
  std::string text = fmt::format("Bar waves through random packings run within {} of the static speeds of their strips", within(of_static));
  if (!of_s0.empty()) text += fmt::format(", and within {} of what the dispersion of S0 makes of these", within(of_s0));
  return text + ".";
}

}  // namespace

std::vector<std::string> wave_findings(const StripResults& r) {
  std::vector<std::string> findings = {
      reach_sentence(r),
      bulk_sentence(deviations(r, StripPacking::random, Kind::bulk, [](const WaveOutcome& w) { return w.section_speed; }), "random packings",
                    "the static speeds between the same sections"),
      bar_sentence(r),
      bulk_sentence(deviations(r, StripPacking::hexagonal, Kind::bulk, [](const WaveOutcome& w) { return w.kinematic_speed; }), "the lattice", "the closed forms"),
  };
  std::erase(findings, "");
  return findings;
}

}  // namespace ddem::harness
