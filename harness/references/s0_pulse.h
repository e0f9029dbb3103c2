#pragma once
// A pulse in a strip with free edges, as its S0 wave carries it: what the bar run would show in the continuum.

#include <cstddef>
#include <vector>

namespace ddem::references {

/// The strip as its bar wave sees it.
struct FreeStrip {
  double bar_speed = 0.0;      ///< of infinitely long waves, m/s
  double width = 0.0;          ///< m
  double poisson_ratio = 0.0;  ///< plane: lateral contraction under tension, 0 <= nu < 1
};

/// Mean displacement across the strip (over the amplitude) whose left end moves as sin^2(pi t/duration), 0 <= t <=
/// duration, free to slide along y:
///   u(x, t) = (1/pi) int_0^inf a(w) g(w) cos(w (t - duration/2) - k(w) x) dw,
/// g the pulse's Fourier transform about its middle, k(w) the S0 branch and a(w) its share (rayleigh_lamb.h): each
/// frequency at its own phase speed, no reflections. Higher modes are left out. They carry what the pulse holds above
/// their first cut-off, min(pi c_p, 2 pi c_s)/width, and move the top of a pulse of four widths by up to 1 % of its
/// speed where nu = 0.4, its centroid and correlation by 0.1 % (finite elements, nu = 0.06 .. 0.4).
class S0Pulse {
 public:
  /// For 0 <= x <= farthest and 0 <= t <= last. Throws std::invalid_argument on values that are not positive and finite,
  /// and outside 0 <= nu < 1.
  S0Pulse(const FreeStrip& strip, double duration, double farthest, double last);

  /// At x and the times 0, dt, 2 dt .. (samples - 1) dt.
  std::vector<double> signal(double x, double dt, std::size_t samples) const;

 private:
  void add(double weight, double omega, double k);

  std::vector<double> weight_, omega_, k_;  // of each wave
  double middle_;
};

}  // namespace ddem::references
