#pragma once
// Stationary noise of eight colours, white first; seeded.

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tests/harness/measure/synthetic.h"

namespace ddem::harness::synthetic {

/// Noise of unit variance, stationary, by its recipe.
struct NoiseKind {
  std::string name;
  std::function<std::vector<double>(Noise& white, std::size_t samples)> make;
};

/// y_n = a y_(n-1) + b y_(n-2) + white, scaled to unit variance, from its stationary state.
inline std::vector<double> autoregressive(Noise& white, std::size_t samples, double a, double b) {
  const double variance = (1.0 - b) / ((1.0 + b) * ((1.0 - b) * (1.0 - b) - a * a));
  const auto settle = static_cast<std::size_t>(8.0 / (1.0 - std::sqrt(std::abs(b) > 0.0 ? std::abs(b) : a * a)));
  std::vector<double> out;
  double last = 0.0, before = 0.0;
  for (std::size_t n = 0; n < settle + samples; ++n) {
    const double next = a * last + b * before + white() / std::sqrt(variance);
    before = last, last = next;
    if (n >= settle) out.push_back(next);
  }
  return out;
}

/// A sum of autoregressive noises, a factor of four apart, of equal variance: power 1/f over three decades.
inline std::vector<double> pink(Noise& white, std::size_t samples) {
  std::vector<double> sum(samples, 0.0);
  constexpr std::array times = {1.0, 4.0, 16.0, 64.0, 256.0};
  for (const double time : times) {
    const std::vector<double> part = autoregressive(white, samples, std::exp(-1.0 / time), 0.0);
    for (std::size_t n = 0; n < samples; ++n) sum[n] += part[n] / std::sqrt(static_cast<double>(times.size()));
  }
  return sum;
}

/// Noise smoothed by a gaussian of that width in samples: of a drive's 100 samples 21 make it as wide as the pulse itself.
inline std::vector<double> smooth(Noise& white, std::size_t samples, double width) {
  const int reach = static_cast<int>(4.0 * width);
  std::vector<double> kernel, in, out(samples, 0.0);
  double squares = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    kernel.push_back(gaussian(k, 0.0, width));
    squares += kernel.back() * kernel.back();
  }
  for (std::size_t n = 0; n < samples + kernel.size(); ++n) in.push_back(white() / std::sqrt(squares));
  for (std::size_t n = 0; n < samples; ++n) {
    for (std::size_t k = 0; k < kernel.size(); ++k) out[n] += kernel[k] * in[n + k];
  }
  return out;
}

inline const std::vector<NoiseKind>& noises() {
  static const std::vector<NoiseKind> kinds = {
      {"white", [](Noise& w, std::size_t n) { return autoregressive(w, n, 0.0, 0.0); }},
      {"correlated over 10 samples", [](Noise& w, std::size_t n) { return autoregressive(w, n, std::exp(-0.1), 0.0); }},
      {"correlated over 100 samples", [](Noise& w, std::size_t n) { return autoregressive(w, n, std::exp(-0.01), 0.0); }},
      {"pink", pink},
      {"narrow band, 30 samples a period",
       [](Noise& w, std::size_t n) { return autoregressive(w, n, 2.0 * 0.99 * std::cos(0.2), -0.99 * 0.99); }},
      {"narrow band, 100 samples a period",
       [](Noise& w, std::size_t n) { return autoregressive(w, n, 2.0 * 0.995 * std::cos(0.06), -0.995 * 0.995); }},
      {"smooth, a third of the pulse", [](Noise& w, std::size_t n) { return smooth(w, n, 5.0); }},
      {"smooth, the pulse's own width", [](Noise& w, std::size_t n) { return smooth(w, n, 15.0); }},
  };
  return kinds;
}

}  // namespace ddem::harness::synthetic
