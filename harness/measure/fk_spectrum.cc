#include "harness/measure/fk_spectrum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <unsupported/Eigen/FFT>

#include "harness/measure/signal.h"

namespace ddem::harness {
namespace {

constexpr std::size_t kFewest = 8;
constexpr std::size_t kSpectrumPadding = 4;
constexpr double kCrestOverMedian = 10.0;

using Complex = std::complex<double>;
using Column = std::vector<Complex>;

double hann(std::size_t n, std::size_t count) {
  const double s = std::sin(std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(count));
  return s * s;
}

void check(std::span<const std::vector<double>> signals, double spacing, double dt) {
  if (signals.size() < kFewest || signals.front().size() < kFewest) {
    throw std::invalid_argument("a frequency-wavenumber spectrum needs at least 8 receivers and samples");
  }
  if (!(spacing > 0.0 && dt > 0.0) || !std::isfinite(spacing) || !std::isfinite(dt)) {
    throw std::invalid_argument("the spacing of receivers and samples must be positive");
  }
  for (const std::vector<double>& s : signals) {
    if (s.size() != signals.front().size()) throw std::invalid_argument("the signals must be equally long");
    if (!all_finite(s)) throw std::invalid_argument("a signal is not finite");
  }
}

/// Windowed, zero-mean, padded signals over frequency: spectrum[x][frequency >= 0].
std::vector<Column> over_frequency(std::span<const std::vector<double>> signals, std::size_t padded) {
  Eigen::FFT<double> fft(Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::HalfSpectrum);
  const std::size_t samples = signals.front().size();
  std::vector<double> window;
  for (std::size_t n = 0; n < samples; ++n) window.push_back(hann(n, samples));
  std::vector<Column> result;
  for (std::size_t x = 0; x < signals.size(); ++x) {
    // The mean from the first value on: a constant signal is nothing but zeros then, without round-off.
    const double first = signals[x].front();
    double mean = 0.0;
    for (const double value : signals[x]) mean += (value - first) / static_cast<double>(samples);
    std::vector<double> time(padded);
    const double here = hann(x, signals.size());
    for (std::size_t n = 0; n < samples; ++n) time[n] = here * window[n] * ((signals[x][n] - first) - mean);
    fft.fwd(result.emplace_back(), time);
  }
  return result;
}

/// Offset of a parabola's crest from its middle point, in units of the spacing.
double crest_offset(double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  return curvature < 0.0 ? 0.5 * (before - after) / curvature : 0.0;
}

std::optional<RidgePoint> highest_crest(const FkSpectrum& s, Eigen::Index row, double from, double to) {
  const Eigen::RowVectorXd a = s.amplitude.row(row);
  std::vector<double> sorted(a.begin(), a.end());
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double median = sorted[sorted.size() / 2];
  Eigen::Index best = 0;
  for (Eigen::Index n = 1; n + 1 < a.size(); ++n) {
    const double frequency = s.frequency[static_cast<std::size_t>(n)];
    if (frequency < from || frequency > to) continue;
    if (a[n] >= a[n - 1] && a[n] > a[n + 1] && (best == 0 || a[n] > a[best])) best = n;
  }
  if (best == 0 || !(a[best] > kCrestOverMedian * median)) return std::nullopt;
  const double offset = a[best - 1] > 0.0 && a[best + 1] > 0.0
                            ? crest_offset(std::log(a[best - 1]), std::log(a[best]), std::log(a[best + 1]))
                            : 0.0;
  return RidgePoint{s.wavenumber[row], (static_cast<double>(best) + offset) * s.frequency[1], a[best]};
}

}  // namespace

FkSpectrum fk_spectrum(std::span<const std::vector<double>> signals, double spacing, double dt) {
  check(signals, spacing, dt);
  const std::size_t receivers = signals.size(), padded = std::bit_ceil(kSpectrumPadding * signals.front().size());
  const std::vector<Column> in_time = over_frequency(signals, padded);
  const std::size_t frequencies = padded / 2 + 1, wavenumbers = receivers / 2 + 1;
  FkSpectrum s;
  for (std::size_t m = 0; m < wavenumbers; ++m) {
    s.wavenumber.push_back(2.0 * std::numbers::pi * static_cast<double>(m) / (static_cast<double>(receivers) * spacing));
  }
  for (std::size_t n = 0; n < frequencies; ++n) {
    s.frequency.push_back(2.0 * std::numbers::pi * static_cast<double>(n) / (static_cast<double>(padded) * dt));
  }
  s.amplitude.resize(static_cast<Eigen::Index>(wavenumbers), static_cast<Eigen::Index>(frequencies));
  Eigen::FFT<double> fft;
  Column line(receivers), transformed;
  for (std::size_t n = 0; n < frequencies; ++n) {
    for (std::size_t x = 0; x < receivers; ++x) line[x] = in_time[x][n];
    fft.fwd(transformed, line);
    for (std::size_t m = 0; m < wavenumbers; ++m) {
      s.amplitude(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n)) =
          std::hypot(std::abs(transformed[m]), std::abs(transformed[(receivers - m) % receivers]));
    }
  }
  return s;
}

std::vector<RidgePoint> main_ridge(const FkSpectrum& spectrum) {
  std::vector<RidgePoint> ridge;
  for (Eigen::Index row = 0; row < spectrum.amplitude.rows(); ++row) {
    if (const auto point = highest_crest(spectrum, row, 0.0, HUGE_VAL)) ridge.push_back(*point);
  }
  return ridge;
}

std::optional<RidgePoint> crest_near(const FkSpectrum& spectrum, std::size_t row, double frequency, double share) {
  return highest_crest(spectrum, static_cast<Eigen::Index>(row), frequency * (1.0 - share), frequency * (1.0 + share));
}

}  // namespace ddem::harness
