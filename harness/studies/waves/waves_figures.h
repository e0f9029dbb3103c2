#pragma once
// The figures of a campaign's report, and the means over seeds that they and its tables show.

#include <vector>

#include "harness/studies/strip/strip_results.h"
#include "reports/figure.h"

namespace ddem::harness {

/// The same in all figures.
reports::Color color_of(Model model);

/// Means over those seeds of the random packings that gave a velocity; not-a-number where none did.
struct SpeedPoint {
  Uncertain measured;
  double lowest = 0.0, highest = 0.0;  ///< of the seeds
  double statics = 0.0, kinematic = 0.0;
};
SpeedPoint random_speed(const StripResults& results, Model model, double ratio, Protocol protocol, StripWave wave);

/// nu = 1 - 2 (c_s/c_p)^2 over k_t/k_n: mean, lowest and highest of the seeds, and the mean from static speeds.
struct PoissonCurve {
  std::vector<double> ratio, mean, lowest, highest, statics;
};
PoissonCurve poisson_curve(const StripResults& results, Model model);

reports::Figure poisson_figure(const StripResults& results);
reports::Figure velocity_figure(const StripResults& results);
reports::Figure strip_figure(const StripPicture& picture);
/// Displacement over time at the first two pairs of probes, with picks: the paper's protocol.
reports::Figure paper_figure(const StripResults& results);
/// Particles over continuum for the driven pulse.
reports::Figure waveform_figure(const StripResults& results);

}  // namespace ddem::harness
