// The convolutions of J_n with 1 and with exp(i alpha sigma),
//     I_n(z) = int_0^z J_n(s) ds,   D_n(z) = int_0^z J_n(z - s) exp(i alpha s) ds,
// follow from 2 J_n' = J_(n-1) - J_(n+1), integrated against 1 and exp, for n >= 1:
//     I_(n-1) = I_(n+1) + 2 J_n,   D_(n-1) = D_(n+1) + 2 i alpha D_n + 2 J_n.
// Downwards from orders where all vanish these are stable for alpha < 1: solutions of the homogeneous equation keep
// their size, |-i alpha +- sqrt(1 - alpha^2)| = 1.

#include "dem/core/time_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "dem/core/bessel_lanes.h"

namespace ddem {

namespace baseline {
extern const BesselFill fill_bessel;
}
#ifdef DDEM_X86_KERNELS
namespace avx2 {
extern const BesselFill fill_bessel;
}
namespace avx512 {
extern const BesselFill fill_bessel;
}
#endif

namespace {

using std::numbers::pi;

constexpr double largest_alpha = 0.5;

// The order beyond which J_n(z) is below 1e-18 of its size at n = z: there J_n/J_(n-1) = exp(-arcosh(n/z)) in the
// leading order of Debye's expansion.
std::size_t last_order(double z) {
  double n = std::floor(z), decay = 1.0;
  while (decay > 1e-18) {
    n += 1.0;
    const double ratio = n / z;
    decay /= ratio + std::sqrt(ratio * ratio - 1.0);
  }
  return static_cast<std::size_t>(n);
}

// J_n(z) is 1 for n = 0 and 0 for the others to 1e-20 below this, which also keeps the recurrence from overflow.
constexpr double smallest_z = 1e-10;

BesselFill fill_of_this_processor() {
#ifdef DDEM_X86_KERNELS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) return avx512::fill_bessel;
  if (__builtin_cpu_supports("avx2")) return avx2::fill_bessel;
#endif
  return baseline::fill_bessel;
}

// The coefficients of 2 t/dt = z, times `factor`, added to `a`; nothing for z below smallest_z.
void add_series(BesselSeries series, double alpha, double factor, std::span<const double> z, std::span<double> a) {
  static const BesselFill fill = fill_of_this_processor();
  const std::size_t count = a.size() / z.size();
  std::vector<double> raw(count * bessel_lanes);
  for (std::size_t first = 0; first < z.size(); first += bessel_lanes) {
    const std::size_t width = std::min(bessel_lanes, z.size() - first);
    BesselTimes times{.two_alpha = 2.0 * alpha, .count = count};
    for (std::size_t l = 0; l < width; ++l) {
      if (z[first + l] < smallest_z) continue;
      times.two_over_z[l] = 2.0 / z[first + l];
      times.order[l] = last_order(z[first + l]);
    }
    // Beyond the last order of the latest of these times nothing is left.
    const std::size_t used = std::min(count, *std::max_element(std::begin(times.order), std::end(times.order)) / 2 + 1);
    std::fill_n(raw.begin(), used * bessel_lanes, 0.0);
    std::array<double, bessel_lanes> scale;
    fill(series, times, raw.data(), scale.data());
    for (std::size_t l = 0; l < width; ++l) scale[l] = times.order[l] > 0 ? factor * (1.0 / scale[l]) : 0.0;
    for (std::size_t k = 0; k < used; ++k) {
      for (std::size_t l = 0; l < width; ++l) a[k * z.size() + first + l] += scale[l] * raw[k * bessel_lanes + l];
    }
  }
}

// 2 (t - late)/dt, 0 before it.
std::vector<double> scaled(std::span<const double> times, double time_step, double late = 0.0) {
  std::vector<double> z;
  for (const double t : times) z.push_back(2.0 * std::max(t - late, 0.0) / time_step);
  return z;
}

// What is left of the series where z is 0.
void add_start(std::span<const double> times, double time_step, double (*first)(double), std::span<double> a) {
  for (std::size_t m = 0; m < times.size() && !a.empty(); ++m) {
    if (2.0 * times[m] / time_step < smallest_z) a[m] += first(times[m]);
  }
}

}  // namespace

std::size_t states_for(double time, double time_step) {
  const double z = 2.0 * time / time_step;
  return z < smallest_z ? 1 : last_order(z) / 2 + 1;
}

void release_coefficients(std::span<const double> times, double time_step, std::span<double> a) {
  std::fill(a.begin(), a.end(), 0.0);
  add_series(BesselSeries::released, 0.0, 1.0, scaled(times, time_step), a);
  add_start(times, time_step, [](double) { return 1.0; }, a);
}

void impulse_coefficients(std::span<const double> times, double time_step, std::span<double> a) {
  std::fill(a.begin(), a.end(), 0.0);
  add_series(BesselSeries::struck, 0.0, 0.5 * time_step, scaled(times, time_step), a);
  add_start(times, time_step, [](double t) { return t; }, a);
}

double Sin2::operator()(double time) const {
  if (time <= 0.0 || time >= duration) return 0.0;
  const double sine = std::sin(pi * time / duration);
  return sine * sine;
}

double Sin2::rate(double time) const {
  if (time <= 0.0 || time >= duration) return 0.0;
  return pi / duration * std::sin(2.0 * pi * time / duration);
}

double largest_step_for(const Sin2& pulse) {
  return largest_alpha * pulse.duration / pi;
}

void drive_coefficients(const Sin2& pulse, std::span<const double> times, double time_step, std::span<double> a) {
  if (!(time_step <= largest_step_for(pulse) * (1.0 + 1e-12))) {
    throw std::invalid_argument("the time step does not resolve the pulse");
  }
  std::fill(a.begin(), a.end(), 0.0);
  // sin^2 = (1 - cos(2 pi t/duration))/2, and what it would do after one period is taken away again.
  const double alpha = pi * time_step / pulse.duration, factor = 0.5 * time_step * 0.5 * time_step;
  add_series(BesselSeries::driven, alpha, factor, scaled(times, time_step), a);
  const bool after = std::any_of(times.begin(), times.end(), [&](double t) { return t > pulse.duration; });
  if (after) add_series(BesselSeries::driven, alpha, -factor, scaled(times, time_step, pulse.duration), a);
}

}  // namespace ddem
