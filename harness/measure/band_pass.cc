#include "harness/measure/band_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace ddem::harness {
namespace {

double warped(double frequency, double dt) {
  return std::tan(std::numbers::pi * frequency * dt);
}

/// y_n = b0 x_n + b1 x_(n-1) + b2 x_(n-2) - a1 y_(n-1) - a2 y_(n-2)
struct Biquad {
  double b0, b1, b2, a1, a2;
};

// H(s) = 1/(s^2 + sqrt(2) s + 1), and s^2 over the same, with s = (1 - 1/z)/(1 + 1/z)/w.
Biquad low_pass(double w) {
  const double scale = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
  return {w * w * scale, 2.0 * w * w * scale, w * w * scale, 2.0 * (w * w - 1.0) * scale, (1.0 - std::numbers::sqrt2 * w + w * w) * scale};
}

Biquad high_pass(double w) {
  Biquad q = low_pass(w);
  const double scale = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
  q.b0 = scale, q.b1 = -2.0 * scale, q.b2 = scale;
  return q;
}

/// One run, from the state that the first value would have left if it had been there for ever.
void run(std::vector<double>& x, const Biquad& q) {
  if (x.empty()) return;
  const double gain = (q.b0 + q.b1 + q.b2) / (1.0 + q.a1 + q.a2);
  double x1 = x.front(), x2 = x.front(), y1 = gain * x.front(), y2 = y1;
  for (double& value : x) {
    const double y = q.b0 * value + q.b1 * x1 + q.b2 * x2 - q.a1 * y1 - q.a2 * y2;
    x2 = x1, x1 = value;
    y2 = y1, y1 = y;
    value = y;
  }
}

void forth_and_back(std::vector<double>& x, const Biquad& q) {
  run(x, q);
  std::reverse(x.begin(), x.end());
  run(x, q);
  std::reverse(x.begin(), x.end());
}

void require_valid(double dt, const Band& band) {
  if (!(dt > 0.0) || !std::isfinite(dt)) throw std::invalid_argument("a filter needs a positive sampling step");
  const double highest = 0.5 / dt;
  const bool ordered = band.low >= 0.0 && band.high >= 0.0 && (band.high == 0.0 || band.low < band.high);
  if (!ordered || !(band.low < highest) || !(band.high < highest) || (band.low == 0.0 && band.high == 0.0))
    throw std::invalid_argument("a band needs 0 <= low < high, both below half of the sampling rate");
}

/// The signal between its images: 2 x_0 - x_n before it, 2 x_end - x_(end - n) behind.
std::vector<double> continued(std::span<const double> x, std::size_t margin) {
  std::vector<double> out;
  out.reserve(x.size() + 2 * margin);
  for (std::size_t n = margin; n > 0; --n) out.push_back(2.0 * x.front() - x[n]);
  out.insert(out.end(), x.begin(), x.end());
  for (std::size_t n = 1; n <= margin; ++n) out.push_back(2.0 * x.back() - x[x.size() - 1 - n]);
  return out;
}

}  // namespace

std::vector<double> band_pass(std::span<const double> values, double dt, const Band& band) {
  require_valid(dt, band);
  if (values.size() < 2) return {values.begin(), values.end()};
  // Two periods of the lowest edge: there the filter has forgotten its start but for exp(-4 pi/sqrt(2)) = 1e-4.
  const double lowest = band.low > 0.0 ? band.low : band.high;
  const auto margin = static_cast<std::size_t>(std::min(2.0 / (lowest * dt), static_cast<double>(values.size() - 1)));
  std::vector<double> x = continued(values, margin);
  if (band.high > 0.0) forth_and_back(x, low_pass(warped(band.high, dt)));
  if (band.low > 0.0) forth_and_back(x, high_pass(warped(band.low, dt)));
  return {x.begin() + static_cast<std::ptrdiff_t>(margin), x.begin() + static_cast<std::ptrdiff_t>(margin + values.size())};
}

double band_pass_gain(double frequency, double dt, const Band& band) {
  require_valid(dt, band);
  const double w = warped(frequency, dt);
  double gain = 1.0;
  if (band.high > 0.0) gain /= 1.0 + std::pow(w / warped(band.high, dt), 4);
  if (band.low > 0.0) gain *= w > 0.0 ? 1.0 / (1.0 + std::pow(warped(band.low, dt) / w, 4)) : 0.0;
  return gain;
}

}  // namespace ddem::harness
