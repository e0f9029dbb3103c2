#include "harness/studies/waves/waveforms.h"

#include <algorithm>
#include <cmath>

namespace ddem::harness {

double value_at(const std::vector<double>& signal, double sample_interval, double time) {
  const double position = time / sample_interval;
  if (position <= 0.0 || signal.empty()) return 0.0;
  const auto n = static_cast<std::size_t>(position);
  if (n + 1 >= signal.size()) return signal.back();
  const double f = position - static_cast<double>(n);
  return (1.0 - f) * signal[n] + f * signal[n + 1];
}

std::optional<double> waveform_correlation(const StripResults& r, const StripMaterial& key, StripWave wave) {
  const WaveOutcome* dem = r.find(StripCase{key.packing, key.seed, key.model, key.stiffness_ratio, Protocol::long_wave, wave});
  const FemOutcome* fem = r.find(key, wave);
  if (dem == nullptr || fem == nullptr) return std::nullopt;
  const Recording &a = dem->recording, &b = fem->recording;
  if (a.signals.empty() || a.signals.size() != b.signals.size()) return std::nullopt;
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t p = 0; p < a.signals.size(); ++p) {
    const auto &u = a.signals[p].values, &v = b.signals[p].values;
    const double end = std::min(static_cast<double>(v.size() - 1) * b.sample_interval, a.signals[p].window_end);
    for (std::size_t n = 0; n < u.size(); ++n) {
      const double time = static_cast<double>(n) * a.sample_interval;
      if (time > end) break;
      const double w = value_at(v, b.sample_interval, time);
      ab += u[n] * w;
      aa += u[n] * u[n];
      bb += w * w;
    }
  }
  return aa > 0.0 && bb > 0.0 ? std::optional(ab / std::sqrt(aa * bb)) : std::nullopt;
}

}  // namespace ddem::harness
