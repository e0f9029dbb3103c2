#pragma once
// Recordings of a made-up laboratory, whose speed is known.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "harness/run/laboratory.h"
#include "tests/harness/measure/coloured_noise.h"

namespace ddem::harness::laboratory_test {

inline constexpr double kDt = 1e-7, kSpeed = 3000.0;  // s, m/s

/// Waves by the time after `top` in widths.
inline double ricker(double t) {
  return (1.0 - 1.44 * t * t) * std::exp(-0.72 * t * t);
}
inline double bipolar(double t) {
  return t * std::exp(0.5 - 0.5 * t * t);
}
inline double burst(double t) {
  return std::abs(t) < 8.0 ? std::sin(2.0 * t) * std::pow(std::cos(std::numbers::pi * t / 16.0), 2) : 0.0;
}
inline double ringing(double t) {
  return t > 0.0 ? std::sin(2.0 * t) * std::exp(-0.1 * t) * (1.0 - std::exp(-t)) : 0.0;
}

/// A squared sine of height 1 that passes two sensors, and what a laboratory adds to it. Times are samples.
struct Shot {
  std::size_t samples = 1000;
  double width = 30.0;   ///< of the pulse at half its height
  double first = 400.3;  ///< the top at the nearer sensor
  double delay = 200.0;
  double noise = 0.0;                ///< of the height
  double offset = 0.0;               ///< of the height
  double trend = 0.0;                ///< over the recording, of the height
  double precursor = 0.0;            ///< of the height, five widths before
  double echo = 0.0;                 ///< of the height, four widths later
  double second = 1.0;               ///< height at the farther sensor; negative where its cable is reversed
  std::size_t kind = 0;              ///< of the noise: white
  double (*wave)(double) = nullptr;  ///< instead of the squared sine
};

inline std::vector<double> signal_of(const Shot& s, double top, double height, synthetic::Noise& random) {
  std::vector<double> values = synthetic::noises()[s.kind].make(random, s.samples);
  for (std::size_t n = 0; n < s.samples; ++n) {
    const auto t = static_cast<double>(n);
    const double wave = (s.wave ? s.wave((t - top) / s.width) : synthetic::sin2(t, top, 2.0 * s.width)) +
                        s.precursor * synthetic::sin2(t, top - 5.0 * s.width, 2.0 * s.width) +
                        s.echo * synthetic::sin2(t, top + 4.0 * s.width, 2.0 * s.width);
    values[n] = s.noise * values[n] + height * wave + s.offset + s.trend * t / static_cast<double>(s.samples);
  }
  return values;
}

inline LaboratoryRecording recording_of(const Shot& s, unsigned long long seed) {
  synthetic::Noise random(seed);
  LaboratoryRecording r{0.0, kDt, kDt, {}};
  r.sensors.push_back({"a", 0.0, signal_of(s, s.first, 1.0, random)});
  r.sensors.push_back({"b", kSpeed * s.delay * kDt, signal_of(s, s.first + s.delay, s.second, random)});
  return r;
}

}  // namespace ddem::harness::laboratory_test
