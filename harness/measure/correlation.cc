#include "harness/measure/correlation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numeric>
#include <stdexcept>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "harness/measure/picker.h"

namespace ddem::harness {
namespace {

/// sum_n a(n) b(n + k) for k = -(a.size() - 1) .. b.size() - 1, by zero-padded Fourier transforms.
std::vector<double> correlate(std::span<const double> a, std::span<const double> b) {
  const std::size_t lags = a.size() + b.size() - 1;
  const std::size_t padded = std::min(std::bit_ceil(lags), 3 * std::bit_ceil((lags + 2) / 3));
  std::vector<double> a_padded(padded, 0.0), b_padded(padded, 0.0);
  std::copy(a.begin(), a.end(), a_padded.begin());
  std::copy(b.begin(), b.end(), b_padded.begin());
  // Keeps what it has computed for a length, which all signals of a run share.
  thread_local Eigen::FFT<double> fft(Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> a_hat, b_hat;
  fft.fwd(a_hat, a_padded);
  fft.fwd(b_hat, b_padded);
  for (std::size_t m = 0; m < a_hat.size(); ++m) b_hat[m] *= std::conj(a_hat[m]);
  std::vector<double> circular;
  fft.inv(circular, b_hat, static_cast<Eigen::Index>(padded));
  // Negative lags stand at the end of the circular result.
  std::vector<double> by_lag(circular.end() - static_cast<std::ptrdiff_t>(a.size() - 1), circular.end());
  by_lag.insert(by_lag.end(), circular.begin(), circular.begin() + static_cast<std::ptrdiff_t>(b.size()));
  return by_lag;
}

/// Scaled to unit energy; scaled by the largest value first, since the squares of small displacements
/// underflow.
std::vector<double> normalised(std::span<const double> values) {
  const double largest = largest_magnitude(values);
  std::vector<double> scaled(values.begin(), values.end());
  for (double& v : scaled) v /= largest;
  const double norm = std::sqrt(std::inner_product(scaled.begin(), scaled.end(), scaled.begin(), 0.0));
  for (double& v : scaled) v /= norm;
  return scaled;
}

}  // namespace

std::vector<double> match(std::span<const double> a, std::span<const double> b) {
  if (a.empty() || b.size() < a.size() || largest_magnitude(a) == 0.0 || largest_magnitude(b) == 0.0) return {};
  const std::vector<double> unit = normalised(a), whole = normalised(b);
  const std::vector<double> sums = correlate(unit, whole);
  const std::size_t places = b.size() - a.size() + 1;
  // Energies of the pieces; each sum anew, since differences of running sums lose what is small.
  std::vector<double> energy(places, 0.0);
  for (std::size_t k = 0; k < places; ++k)
    energy[k] = std::inner_product(whole.begin() + static_cast<std::ptrdiff_t>(k), whole.begin() + static_cast<std::ptrdiff_t>(k + a.size()),
                                   whole.begin() + static_cast<std::ptrdiff_t>(k), 0.0);
  const double least = 1e-6 * *std::max_element(energy.begin(), energy.end());
  std::vector<double> coefficient(places, 0.0);
  for (std::size_t k = 0; k < places; ++k) {
    if (energy[k] > least) coefficient[k] = sums[a.size() - 1 + k] / std::sqrt(energy[k]);
  }
  return coefficient;
}

Outcome<double> correlation_delay(const Signal& from, const Signal& to, const Window& delays,
                                  double min_coefficient) {
  require_valid(from, delays);
  require_valid(to, delays);
  if (std::abs(from.dt - to.dt) > 1e-12 * from.dt)
    throw std::invalid_argument("cross-correlation needs two signals of the same sampling step");
  if (!all_finite(from.values) || !all_finite(to.values))
    return FailedMeasurement{Failure::non_finite, "a signal is not finite"};
  if (from.size() < 3 || to.size() < 3)
    return FailedMeasurement{Failure::empty_window, "fewer than three samples to correlate"};
  if (largest_magnitude(from.values) == 0.0 || largest_magnitude(to.values) == 0.0)
    return FailedMeasurement{Failure::flat, "a signal is zero throughout"};

  const std::vector<double> coefficient = correlate(normalised(from.values), normalised(to.values));
  const double first_delay = to.t0 - from.t0 - static_cast<double>(from.size() - 1) * from.dt;
  PickOptions options;
  options.expected_amplitude = 1.0;
  options.detection_fraction = min_coefficient;
  options.still_before = false;
  const Pick pick = pick_peak({coefficient, from.dt, first_delay}, delays, options);
  if (!pick.ok()) return FailedMeasurement{pick.error().failure, "cross-correlation: " + pick.error().reason};
  return pick.value().time;
}

}  // namespace ddem::harness
