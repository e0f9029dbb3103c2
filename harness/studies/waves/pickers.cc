#include "harness/studies/waves/pickers.h"

#include <fmt/format.h>

#include <limits>

namespace ddem::harness {

std::optional<double> relative_error(std::optional<double> speed, std::optional<double> reference) {
  return speed && reference ? std::optional(*speed / *reference - 1.0) : std::nullopt;
}

std::optional<double> mean_over_seeds(const StripResults& r, StripCase key, std::size_t least,
                                      const std::function<std::optional<double>(const WaveOutcome&)>& error) {
  std::vector<double> errors;
  for (const std::int64_t seed : r.campaign.seeds) {
    key.seed = seed;
    const WaveOutcome* w = r.find(key);
    const std::optional<double> value = w != nullptr ? error(*w) : std::nullopt;
    if (value) errors.push_back(*value);
  }
  if (errors.empty() || errors.size() < least) return std::nullopt;
  return sample_statistics(errors).value;
}

void add_failure(reports::Verdict& v, const WaveOutcome& w) {
  if (!w.failure.empty()) v.reason += fmt::format("{}: {}. ", id_of(w.c), w.failure);
}

std::optional<double> speed_error(const StripResults& r, StripMaterial key, Protocol protocol, StripWave wave, std::size_t least, reports::Verdict& v) {
  for (const std::int64_t seed : r.campaign.seeds) {
    key.seed = seed;
    if (const WaveOutcome* w = r.find(case_of(key, wave, protocol))) add_failure(v, *w);
  }
  return mean_over_seeds(r, case_of(key, wave, protocol), least, [](const WaveOutcome& w) { return relative_error(w.speed, w.static_speed); });
}

reports::Table picker_table(const StripResults& r) {
  reports::Table t;
  t.caption = "The same pulses by peak, centroid and cross-correlation: mean over the random packings of measured over static speed between the very "
              "sections, less one. Bar over S0: against what the dispersion of the narrow strip makes of its static speed.";
  t.columns = {{"model"}, {"kₜ/kₙ", "", 3}};
  for (const char* what : {"shear", "P", "bar", "bar over S0"}) {
    for (const Picker& by : kPickers) t.columns.push_back({fmt::format("{}, {}", what, by.name), "%", 2});
  }
  for (const Model model : r.campaign.models) {
    for (const double ratio : r.campaign.stiffness_ratios) {
      std::vector<reports::Cell> row = {name(model), ratio};
      const auto add = [&](StripWave wave, const auto& error) {
        const auto value = mean_over_seeds(r, {StripPacking::random, 0, model, ratio, Protocol::long_wave, wave}, 1, error);
        row.emplace_back(100.0 * value.value_or(std::numeric_limits<double>::quiet_NaN()));
      };
      for (const StripWave wave : {StripWave::shear, StripWave::p, StripWave::bar}) {
        for (const Picker& by : kPickers) add(wave, [&](const WaveOutcome& w) { return relative_error(w.*by.speed, w.section_speed); });
      }
      for (const Picker& by : kPickers) add(StripWave::bar, [&](const WaveOutcome& w) { return relative_error(w.*by.speed, w.s0.*by.s0); });
      t.rows.push_back(row);
    }
  }
  return t;
}

}  // namespace ddem::harness
