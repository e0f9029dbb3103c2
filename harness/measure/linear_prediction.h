#pragma once
// Growth and frequency of what is left in a recording, by linear prediction (Prony's method): signals that are sums of p
// motions z_j^n obey one recurrence y_{n+p} = c_0 y_n + .. + c_{p-1} y_{n+p-1}, the same at every receiver, and the z_j
// are the roots of its polynomial.

#include <complex>
#include <span>
#include <vector>

namespace ddem::harness {

struct Prediction {
  /// z_j a sample, of motions that hold 1e-4 of the largest one or more; none where the signals are zero or too short.
  std::vector<std::complex<double>> factors;
  double residual = 0.0;                      ///< root mean square of what is not predicted, over that of the signals

  /// Largest |z_j|; 0 without factors.
  double largest() const;
};

/// Of the samples [begin, end) of all signals, which must be finite and that long. Each sample counts alike, whatever has
/// grown or decayed since. Takes the lowest of the orders 1, 2, 3, 4, 6 and 8 whose residual is below `enough`, or else
/// the order of the smallest residual. Needs order + 1 samples. Throws std::invalid_argument on signals that are shorter
/// than `end` or not finite; std::runtime_error where the roots are not found.
Prediction predict_linearly(std::span<const std::vector<double>> signals, std::size_t begin, std::size_t end, double enough);

}  // namespace ddem::harness
