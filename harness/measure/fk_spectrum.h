#pragma once
// Frequency-wavenumber spectra: which waves travel in a line of receivers, and their dispersion relation.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace ddem::harness {

/// Root of the power of waves in both directions, exp(i(k x - omega t)) and exp(i(-k x - omega t)).
struct FkSpectrum {
  std::vector<double> wavenumber;  ///< 1/m, from 0 to pi/spacing in steps of 2 pi/(receivers spacing)
  std::vector<double> frequency;   ///< angular, rad/s, from 0 to pi/dt
  Eigen::MatrixXd amplitude;       ///< rows: wavenumbers, columns: frequencies; in the signals' unit, times a constant
};

/// `signals[x][n]`: receiver x stands at x * spacing (m), sample n was taken at n * dt (s). Both directions are windowed
/// (Hann), the time mean of each signal is taken out, and time is padded to four times its length, rounded up to a power
/// of two, so that ridges can be interpolated. Throws std::invalid_argument on fewer than 8 receivers or samples, signals
/// of unequal length, values that are not finite, a spacing or dt that is not positive.
FkSpectrum fk_spectrum(std::span<const std::vector<double>> signals, double spacing, double dt);

/// A crest of the spectrum over frequency, at one wavenumber.
struct RidgePoint {
  double wavenumber = 0.0, frequency = 0.0;
  double amplitude = 0.0;
};

/// The highest crest of each wavenumber, by a parabola through the logarithms of three amplitudes (exact for a Gaussian
/// line, within 0.02 of a resolved interval 2 pi/duration for a Hann line). A wavenumber whose highest crest does not
/// stand ten times above the median of its amplitudes has none: white noise reaches four times.
std::vector<RidgePoint> main_ridge(const FkSpectrum& spectrum);

/// The highest crest of the wavenumber `row` within `share` of a frequency (rad/s), where other branches are in the spectrum
/// too; none where that does not stand ten times above the median of the row.
std::optional<RidgePoint> crest_near(const FkSpectrum& spectrum, std::size_t row, double frequency, double share);

}  // namespace ddem::harness
