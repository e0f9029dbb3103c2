#include "harness/studies/waves/speed_table.h"

#include <cmath>
#include <limits>

#include "harness/measure/elastic_constants.h"
#include "harness/studies/waves/waves_figures.h"

namespace ddem::harness {
namespace {

/// Mean bulk density of the random packings, kg/m3.
double mean_density(const StripResults& r, Model model, double ratio) {
  std::vector<double> densities;
  for (const StaticOutcome& s : r.statics) {
    if (s.key.packing == StripPacking::random && s.key.model == model && s.key.stiffness_ratio == ratio && s.failure.empty())
      densities.push_back(s.moduli.moving_density);
  }
  return sample_statistics(densities).value;
}

struct ElasticConstants {
  double young = std::numeric_limits<double>::quiet_NaN(), shear = young, poisson = young;
};

/// E and G from bar and shear speed; nu from P and shear where there is a P wave, else from bar and shear.
ElasticConstants elastic_constants(double density, const Uncertain& bar, const Uncertain& shear, const Uncertain* p) {
  ElasticConstants e;
  // Statics that failed leave no density, and a file may say anything.
  const auto is_usable = [](double value) { return std::isfinite(value) && value > 0.0; };
  const bool has_bar = is_usable(bar.value), has_shear = is_usable(shear.value);
  if (has_bar && is_usable(density)) e.young = young_modulus_from_bar(density, bar).value;
  if (has_shear && is_usable(density)) e.shear = shear_modulus_from_shear(density, shear).value;
  if (p != nullptr && is_usable(p->value) && has_shear) e.poisson = poisson_ratio_from_p_and_shear(*p, shear).value;
  if (p == nullptr && has_bar && has_shear) e.poisson = poisson_ratio_from_bar_and_shear(bar, shear).value;
  return e;
}

}  // namespace

reports::Table speed_table(const StripResults& r, Protocol protocol) {
  const bool with_p = protocol == Protocol::long_wave;
  reports::Table t;
  t.caption = with_p ? "Driven long pulse, section averages: mean over the random packings."
                     : "The paper's protocol, column release and peak to peak: mean over the random packings.";
  t.columns = {{"model"}, {"kₜ/kₙ", "", 3}};
  std::vector<StripWave> waves = {StripWave::bar, StripWave::shear};
  if (with_p) waves.push_back(StripWave::p);
  for (const StripWave wave : waves) {
    t.columns.push_back({name(wave), "m/s", 5});
    t.columns.push_back({"− static", "%", 2});
  }
  t.columns.insert(t.columns.end(), {{"E", "GPa", 4}, {"G", "GPa", 4}, {with_p ? "ν (P, shear)" : "ν (bar, shear)", "", 3}});
  for (const Model model : r.campaign.models) {
    for (const double ratio : r.campaign.stiffness_ratios) {
      std::vector<reports::Cell> row = {name(model), ratio};
      std::vector<Uncertain> speeds;
      for (const StripWave wave : waves) {
        const SpeedPoint s = random_speed(r, model, ratio, protocol, wave);
        row.insert(row.end(), {s.measured.value, 100.0 * (s.measured.value / s.statics - 1.0)});
        speeds.push_back(s.measured);
      }
      const ElasticConstants e = elastic_constants(mean_density(r, model, ratio), speeds[0], speeds[1], with_p ? &speeds[2] : nullptr);
      row.insert(row.end(), {e.young * 1e-9, e.shear * 1e-9, e.poisson});
      t.rows.push_back(row);
    }
  }
  return t;
}

}  // namespace ddem::harness
