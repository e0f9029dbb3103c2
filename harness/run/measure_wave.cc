#include "harness/run/measure_wave.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/measure/correlation.h"

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

namespace {

/// The signal of a probe, its window, and how a pulse in it is picked.
struct ProbeSignal {
  Signal signal;
  Window window;
  PickOptions options;

  bool too_short() const { return !(window.end > window.begin); }
  Pick failed() const { return FailedMeasurement{Failure::empty_window, "the signal ends before the wave can have arrived"}; }

  Pick peak() const { return too_short() ? failed() : pick_peak(signal, window, options); }
  /// What follows the window is a reflection, and no part of the pulse.
  Pick centroid(double half_width) const {
    return too_short() ? failed() : pick_centroid(causal(), window, half_width, options);
  }
  Signal causal() const { return slice(signal, {signal.t0, window.end}); }
};

std::vector<ProbeSignal> probe_signals(const std::vector<std::vector<double>>& signals, double dt, const ProbeLayout& layout,
                                       const WaveContext& context) {
  PickOptions options;
  options.expected_amplitude = context.source_amplitude;
  options.detection_fraction = context.smallest_arrival;
  std::vector<ProbeSignal> probes;
  for (std::size_t p = 0; p < layout.probes.size(); ++p) {
    const Signal signal{signals[p], dt, 0.0};
    Window window = causal_window(context, layout.probes[p].x);
    window.end = std::min(window.end, signal.time(static_cast<double>(signal.size()) - 1.0));
    probes.push_back({signal, window, options});
  }
  return probes;
}

// Dispersion stretches a pulse: over its own width only, the centroid loses the end that lags behind. On the lattice a tenth
// more takes the error of the shear centroid from -0.04 to 0.004 % (P: -0.07 to -0.014 %).
constexpr double kStretch = 1.1;

/// The same for all probes, as wide as there is room for between each peak and the first reflection.
double centroid_half_width(const std::vector<ProbeSignal>& probes, const std::vector<ProbePick>& picks, double pulse) {
  double room = kStretch * pulse;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    if (picks[p].pick.ok()) room = std::min(room, probes[p].window.end - picks[p].pick.value().time - probes[p].signal.dt);
  }
  return std::max(pulse, room);
}

/// A mean needs more than half of the pairs.
template <class Delay>
WaveSpeed speed_of_pairs(const ProbeLayout& layout, const Delay& delay) {
  std::vector<PairDelay> delays;
  for (const ProbePair& pair : layout.pairs) delays.push_back({pair.from, pair.to, pair.distance, delay(pair)});
  return wave_speed(delays, delays.size() / 2 + 1);
}

/// The wave travels at more than half and less than twice the expected speed.
Outcome<double> correlated(const ProbeSignal& from, const ProbeSignal& to, const ProbePair& pair, double speed) {
  if (from.too_short()) return from.failed().error();
  if (to.too_short()) return to.failed().error();
  const double travel = pair.distance / speed;
  return correlation_delay(from.causal(), to.causal(), {0.5 * travel, 2.0 * travel});
}

std::optional<double> mean_of(const WaveSpeed& w) {
  return w.speed.ok() ? std::optional(w.speed.value().mean) : std::nullopt;
}

}  // namespace

PickedSpeeds picked_speeds(const WaveMeasurement& m) {
  return {mean_of(m.speed), m.by_centroid ? mean_of(*m.by_centroid) : std::nullopt, mean_of(m.by_correlation)};
}

WaveMeasurement measure_wave(const std::vector<std::vector<double>>& signals, double dt,
                             const ProbeLayout& layout, const WaveContext& context) {
  const auto probes = probe_signals(signals, dt, layout, context);
  std::vector<ProbePick> picks;
  for (int p = 0; p < static_cast<int>(probes.size()); ++p) picks.push_back({p, probes[p].peak()});
  WaveSpeed speed = speed_of_pairs(layout, [&](const ProbePair& pair) { return delay_between(picks[pair.from].pick, picks[pair.to].pick); });
  std::optional<WaveSpeed> by_centroid;
  if (context.pulse_half_width > 0.0) {
    const double half_width = centroid_half_width(probes, picks, context.pulse_half_width);
    std::vector<Pick> centroids;
    for (const ProbeSignal& probe : probes) centroids.push_back(probe.centroid(half_width));
    by_centroid = speed_of_pairs(layout, [&](const ProbePair& pair) { return delay_between(centroids[pair.from], centroids[pair.to]); });
  }
  WaveSpeed by_correlation = speed_of_pairs(layout, [&](const ProbePair& pair) {
    return correlated(probes[pair.from], probes[pair.to], pair, context.speed);
  });
  return {std::move(picks), std::move(speed), std::move(by_centroid), std::move(by_correlation)};
}

std::vector<Outcome<PhaseVelocity>> phase_velocities(const std::vector<std::vector<double>>& signals, double dt,
                                                     const ProbeLayout& layout, const WaveContext& context) {
  const auto probes = probe_signals(signals, dt, layout, context);
  std::vector<Outcome<PhaseVelocity>> out;
  for (const ProbePair& pair : layout.pairs) {
    const ProbeSignal &from = probes[pair.from], &to = probes[pair.to];
    out.push_back(from.too_short() || to.too_short()
                      ? Outcome<PhaseVelocity>(from.failed().error())
                      : phase_velocity({from.signal, from.window}, {to.signal, to.window}, pair.distance));
  }
  return out;
}

}  // namespace ddem::harness
