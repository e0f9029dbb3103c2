#pragma once
// A uniformly sampled signal and time windows on it.

#include <cstddef>
#include <span>

namespace ddem::harness {

/// Sample n was taken at t0 + n dt (seconds). A view: the values live elsewhere.
struct Signal {
  std::span<const double> values;
  double dt = 0.0;
  double t0 = 0.0;

  std::size_t size() const { return values.size(); }
  double time(double index) const { return t0 + index * dt; }
};

/// A closed time interval, s.
struct Window {
  double begin = 0.0, end = 0.0;
};

/// Indices [first, last) of the samples inside a window.
struct SampleRange {
  std::size_t first = 0, last = 0;

  std::size_t size() const { return last - first; }
};

/// Throws std::invalid_argument unless dt > 0 and all times are finite and in order.
void require_valid(const Signal& signal, const Window& window);

/// Samples with begin <= t <= end (to 1e-9 dt, so that a window given as a multiple of dt holds its end).
SampleRange samples_in(const Signal& signal, const Window& window);

/// The part of a signal inside a window, with its own t0.
Signal slice(const Signal& signal, const Window& window);

/// 0 of no values.
double largest_magnitude(std::span<const double> values);

bool all_finite(std::span<const double> values);

}  // namespace ddem::harness
