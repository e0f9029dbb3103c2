#pragma once
// A band-pass without delay: Butterworth's filter of second order on either side, run forth and back.

#include <span>
#include <vector>

namespace ddem::harness {

/// Hz. An edge of 0 is none: low = 0 is a low-pass, high = 0 a high-pass.
struct Band {
  double low = 0.0, high = 0.0;
};

/// The filtered signal, as long as the given one, which is continued at its ends by its mirror image through the end point.
/// Forth and back the gain is that of one run squared, see band_pass_gain(), and the phase is zero: crests stay where they
/// are, but a sharp rise sends something ahead of itself. Throws std::invalid_argument unless 0 <= low < high < 1/(2 dt),
/// one of them given, and dt is positive.
std::vector<double> band_pass(std::span<const double> values, double dt, const Band& band);

/// 1/(1 + (w/w_high)^4) 1/(1 + (w_low/w)^4), w = tan(pi f dt) (the bilinear transform).
double band_pass_gain(double frequency, double dt, const Band& band);

}  // namespace ddem::harness
