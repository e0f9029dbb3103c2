#include "harness/measure/phase_velocity.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

#include "harness/measure/correlation.h"

namespace ddem::harness {
namespace {

// Frequencies per independent one: enough that the phase hardly changes from one to the next.
constexpr std::size_t kPhasePadding = 8;

/// The windowed part, scaled to a largest value of 1 (squares of displacements of a nanometre are small numbers).
struct Tapered {
  std::vector<double> values;
  double t0 = 0.0;
  double noise_gain = 0.0;  ///< root of the sum of squared weights over the scale: noise's share in the spectrum
};

Tapered taper(const WindowedSignal& s) {
  const Signal part = slice(s.signal, s.window);
  Tapered out{{part.values.begin(), part.values.end()}, part.t0, 0.0};
  const double ramp = std::max(1.0, kTaper * static_cast<double>(part.size()));
  double largest = 0.0, squares = 0.0;
  for (std::size_t n = 0; n < part.size(); ++n) {
    const double from_end = static_cast<double>(std::min(n, part.size() - 1 - n)) + 0.5;
    const double weight = from_end >= ramp ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * from_end / ramp));
    out.values[n] *= weight;
    squares += weight * weight;
    largest = std::max(largest, std::abs(out.values[n]));
  }
  if (largest == 0.0) return out;
  for (double& v : out.values) v /= largest;
  out.noise_gain = std::sqrt(squares) / largest;
  return out;
}

std::vector<std::complex<double>> spectrum(const Tapered& s, std::size_t padded) {
  std::vector<double> values = s.values;
  values.resize(padded, 0.0);
  std::vector<std::complex<double>> hat;
  Eigen::FFT<double> fft;
  fft.fwd(hat, values);
  hat.resize(padded / 2);
  return hat;
}

double largest_magnitude(const std::vector<std::complex<double>>& hat, std::size_t first) {
  double largest = 0.0;
  for (std::size_t m = first; m < hat.size(); ++m) largest = std::max(largest, std::abs(hat[m]));
  return largest;
}

struct Spectra {
  std::vector<std::complex<double>> from, to;
  double least_from = 0.0, least_to = 0.0;  ///< what counts as energy
  double step = 0.0;                        ///< Hz
  std::size_t first = 0;                    ///< lowest frequency with a period in the window

  bool carries(std::size_t m) const { return std::abs(from[m]) >= least_from && std::abs(to[m]) >= least_to; }
  double strength(std::size_t m) const { return std::abs(from[m]) * std::abs(to[m]); }
};

Spectra make_spectra(const Tapered& a, const Tapered& b, double dt, const PhaseVelocityOptions& options) {
  Spectra s;
  const std::size_t padded = kPhasePadding * std::bit_ceil(std::max(a.values.size(), b.values.size()));
  s.from = spectrum(a, padded);
  s.to = spectrum(b, padded);
  s.step = 1.0 / (static_cast<double>(padded) * dt);
  const auto shorter = static_cast<double>(std::min(a.values.size(), b.values.size()));
  s.first = static_cast<std::size_t>(std::ceil(static_cast<double>(padded) / shorter));
  const auto least = [&](const std::vector<std::complex<double>>& hat, double noise_gain) {
    return std::max(options.least_share * largest_magnitude(hat, s.first), options.signal_to_noise * options.noise * noise_gain);
  };
  s.least_from = least(s.from, a.noise_gain);
  s.least_to = least(s.to, b.noise_gain);
  return s;
}

/// Contiguous frequencies [first, last) around the strongest; empty where that one does not carry energy in both.
SampleRange band_of(const Spectra& s, std::size_t strongest) {
  SampleRange band{strongest, strongest};
  while (band.last < s.from.size() && s.carries(band.last)) ++band.last;
  while (band.first > s.first && s.carries(band.first - 1)) --band.first;
  return band;
}

/// What the phase of the cross spectrum adds to that of the delay, unwrapped from `strongest` on; [n] is band.first + n.
std::vector<double> residual_phase(const Spectra& s, SampleRange band, std::size_t strongest, double shift) {
  const auto lag = [&](std::size_t m) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(m) * s.step * shift;
    return -std::arg(s.to[m] * std::conj(s.from[m]) * std::polar(1.0, turn));
  };
  std::vector<double> phase(band.size());
  const auto near = [](double value, double neighbour) {
    return value - 2.0 * std::numbers::pi * std::round((value - neighbour) / (2.0 * std::numbers::pi));
  };
  phase[strongest - band.first] = lag(strongest);
  for (std::size_t m = strongest + 1; m < band.last; ++m) phase[m - band.first] = near(lag(m), phase[m - 1 - band.first]);
  for (std::size_t m = strongest; m-- > band.first;) phase[m - band.first] = near(lag(m), phase[m + 1 - band.first]);
  return phase;
}

void require_valid(double distance, const PhaseVelocityOptions& options) {
  if (!(distance > 0.0) || !std::isfinite(distance)) throw std::invalid_argument("the distance of two signals must be positive and finite");
  if (!(options.least_share > 0.0 && options.least_share < 1.0)) throw std::invalid_argument("the share that bounds a band must lie between 0 and 1");
  if (!(options.noise >= 0.0) || !(options.signal_to_noise > 0.0)) throw std::invalid_argument("noise must not be negative, and a signal-to-noise ratio positive");
}

}  // namespace

Outcome<PhaseVelocity> phase_velocity(const WindowedSignal& from, const WindowedSignal& to, double distance,
                                      const PhaseVelocityOptions& options) {
  require_valid(distance, options);
  require_valid(from.signal, from.window);
  require_valid(to.signal, to.window);
  const double dt = from.signal.dt;
  const Tapered a = taper(from), b = taper(to);
  if (a.values.size() < 3 || b.values.size() < 3) return FailedMeasurement{Failure::empty_window, "fewer than three samples in a window"};
  const Window delays{b.t0 - a.t0 - static_cast<double>(a.values.size()) * dt, b.t0 - a.t0 + static_cast<double>(b.values.size()) * dt};
  const Outcome<double> delay = correlation_delay({a.values, dt, a.t0}, {b.values, to.signal.dt, b.t0}, delays);
  if (!delay.ok()) return delay.error();
  if (!(delay.value() > 0.0)) return FailedMeasurement{Failure::not_causal, "the second signal does not follow the first"};

  const Spectra s = make_spectra(a, b, dt, options);
  if (s.first >= s.from.size()) return FailedMeasurement{Failure::narrow_band, "the windows hold too few samples for a spectrum"};
  std::size_t strongest = s.first;
  for (std::size_t m = s.first; m < s.from.size(); ++m) {
    if (s.strength(m) > s.strength(strongest)) strongest = m;
  }
  const SampleRange band = band_of(s, strongest);
  const double independent = 1.0 / (static_cast<double>(std::min(a.values.size(), b.values.size())) * dt);
  const double width = static_cast<double>(band.size()) * s.step;
  if (width < independent) {
    return FailedMeasurement{Failure::narrow_band, fmt::format("both signals carry energy over {:.4g} Hz only, where their windows resolve {:.4g} Hz",
                                                               width, independent)};
  }
  const std::vector<double> residual = residual_phase(s, band, strongest, delay.value() - (b.t0 - a.t0));
  PhaseVelocity out;
  for (std::size_t n = 0; n < residual.size(); ++n) {
    const double frequency = static_cast<double>(band.first + n) * s.step;
    const double time = delay.value() + residual[n] / (2.0 * std::numbers::pi * frequency);
    if (!(time > 0.0)) return FailedMeasurement{Failure::not_causal, fmt::format("the phase at {:.4g} Hz is not that of a delay", frequency)};
    out.frequency.push_back(frequency);
    out.speed.push_back(distance / time);
  }
  return out;
}

}  // namespace ddem::harness
