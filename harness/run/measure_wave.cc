#include "harness/run/measure_wave.h"

#include <algorithm>
#include <cmath>

namespace ddem::harness {

Window causal_window(const WaveContext& c, double x) {
  const double s = x - c.left_end;
  // The top of the pulse travels at more than half and less than twice the expected speed; what comes back from the
  // right end is a reflection, and a pulse released inside the strip comes a second time, from the left end.
  const double travel = std::abs(s - c.source_centre) / c.speed;
  const double from_the_right = (2.0 * c.length - s - c.source_centre) / c.speed;
  const double from_the_left = c.source_centre > 0.0 ? s / c.speed : from_the_right;
  return {0.5 * travel, std::min({2.0 * travel + c.source_duration, from_the_right, from_the_left})};
}

double time_of_passage(const WaveContext& c, double x, double margin) {
  const double travel = std::abs(x - c.left_end - c.source_centre) / c.speed;
  return (1.0 + margin) * travel + 0.75 * c.source_duration;
}

WaveMeasurement measure_wave(const std::vector<std::vector<double>>& signals, double dt,
                             const ProbeLayout& layout, const WaveContext& context) {
  std::vector<ProbePick> picks;
  PickOptions options;
  options.expected_amplitude = context.source_amplitude;
  options.detection_fraction = context.smallest_arrival;
  for (int p = 0; p < static_cast<int>(layout.probes.size()); ++p) {
    const Signal signal{signals[p], dt, 0.0};
    Window window = causal_window(context, layout.probes[p].x);
    window.end = std::min(window.end, signal.time(static_cast<double>(signal.size() - 1)));
    picks.push_back({p, window.end > window.begin ? pick_peak(signal, window, options)
                                                    : Pick(FailedMeasurement{Failure::empty_window, "the signal ends before the wave can have arrived"})});
  }
  std::vector<PairDelay> delays;
  for (const ProbePair& pair : layout.pairs) {
    delays.push_back({pair.from, pair.to, pair.distance, delay_between(picks[pair.from].pick, picks[pair.to].pick)});
  }
  return {std::move(picks), wave_speed(delays, delays.size() / 2 + 1)};
}

}  // namespace ddem::harness
