#include "harness/references/s0_pulse.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "harness/references/rayleigh_lamb.h"

namespace ddem::references {
namespace {

// Up to this many oscillations in the pulse's duration, where its spectrum, which falls as the cube, is 1e-4 of its
// maximum; faded out over the upper half, since a sharp end would ring at the top of the pulse.
constexpr double kOscillations = 16.0;
// And up to this wave number times width, where S0's share has fallen to a twentieth.
constexpr double kWidestRatio = 8.0;

double fade(double oscillations) {
  const double above = 2.0 * oscillations / kOscillations - 1.0;
  return above <= 0.0 ? 1.0 : 0.5 * (1.0 + std::cos(std::numbers::pi * std::min(above, 1.0)));
}

/// int cos^2(pi t/T) cos(w t) dt over -T/2..T/2 = sin(z pi)/(w (1 - z^2)), z = w T/(2 pi).
double spectrum(double omega, double duration) {
  const double z = 0.5 * omega * duration / std::numbers::pi;
  if (z < 1e-4) return 0.5 * duration;
  if (std::abs(z - 1.0) < 1e-6) return 0.25 * duration;
  return std::sin(std::numbers::pi * z) / (omega * (1.0 - z * z));
}

}  // namespace

S0Pulse::S0Pulse(const FreeStrip& strip, double duration, double farthest, double last) : middle_(0.5 * duration) {
  for (const double value : {strip.bar_speed, strip.width, duration, farthest, last}) {
    if (!(value > 0.0) || !std::isfinite(value)) throw std::invalid_argument("speed, width, duration, distance and time of an S0 pulse must be positive and finite");
  }
  // A sum over wave numbers dk apart repeats itself after 2 pi/dk: longer than all that is asked for, twice.
  const double reach = farthest + strip.bar_speed * (last + duration);
  const double dk = std::numbers::pi / reach;
  const double one_oscillation = 2.0 * std::numbers::pi / duration;
  add(0.5 * strip.bar_speed * 0.5 * duration * dk / std::numbers::pi, 0.0, 0.0);
  for (double n = 1.0; n * dk * strip.width < kWidestRatio; n += 1.0) {
    const double k = n * dk;
    const LambSpeeds speeds = lamb_s0(k * strip.width, strip.poisson_ratio);
    const double omega = k * strip.bar_speed * speeds.phase;
    if (omega > kOscillations * one_oscillation) break;
    const double slope = strip.bar_speed * speeds.group;  // dw = group speed dk
    const double share = fade(omega / one_oscillation) * lamb_s0_share(k * strip.width, strip.poisson_ratio, speeds.phase);
    add(share * spectrum(omega, duration) * slope * dk / std::numbers::pi, omega, k);
  }
}

void S0Pulse::add(double weight, double omega, double k) {
  weight_.push_back(weight);
  omega_.push_back(omega);
  k_.push_back(k);
}

/// Every wave is a phase that turns by omega dt a sample: no cosine but at the start.
std::vector<double> S0Pulse::signal(double x, double dt, std::size_t samples) const {
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::Map<const Eigen::ArrayXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  const Eigen::ArrayXd phase = -(vector(omega_) * middle_ + vector(k_) * x), turn = vector(omega_) * dt;
  const Eigen::ArrayXd turn_re = turn.cos(), turn_im = turn.sin();
  Eigen::ArrayXd re = vector(weight_) * phase.cos(), im = vector(weight_) * phase.sin(), before;
  std::vector<double> u;
  u.reserve(samples);
  for (std::size_t n = 0; n < samples; ++n) {
    u.push_back(re.sum());
    before = re;
    re = before * turn_re - im * turn_im;
    im = before * turn_im + im * turn_re;
  }
  return u;
}

}  // namespace ddem::references
