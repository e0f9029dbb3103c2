#pragma once
// Synthetic pulses with known arrivals.

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "harness/measure/signal.h"

namespace ddem::harness::synthetic {

/// Samples that a Signal can look at.
struct Record {
  std::vector<double> values;
  double dt = 1.0;
  double t0 = 0.0;

  operator Signal() const { return {values, dt, t0}; }
};

inline Record sample(const std::function<double(double)>& f, std::size_t count, double dt = 1.0,
                     double t0 = 0.0) {
  Record record{std::vector<double>(count), dt, t0};
  for (std::size_t n = 0; n < count; ++n) record.values[n] = f(t0 + static_cast<double>(n) * dt);
  return record;
}

/// sin^2 of full width `duration`, highest at `peak`.
inline double sin2(double t, double peak, double duration) {
  if (std::abs(t - peak) >= 0.5 * duration) return 0.0;
  const double c = std::cos(std::numbers::pi * (t - peak) / duration);
  return c * c;
}

inline double gaussian(double t, double peak, double sigma) {
  const double x = (t - peak) / sigma;
  return std::exp(-0.5 * x * x);
}

/// Seeded normal noise. std::normal_distribution is not specified bit for bit, so: Box and Muller's method on
/// the specified std::mt19937_64.
class Noise {
 public:
  explicit Noise(unsigned long long seed) : engine_(seed) {}

  double operator()() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

inline Record with_noise(Record record, double sigma, unsigned long long seed) {
  Noise noise(seed);
  for (double& v : record.values) v += sigma * noise();
  return record;
}

}  // namespace ddem::harness::synthetic
