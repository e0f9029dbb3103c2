#include "harness/run/measure_wave.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/measure/correlation.h"
#include "harness/run/measurability.h"

namespace ddem::harness {
namespace {

/// The signal of a probe, its window, and how a pulse in it is picked.
struct ProbeSignal {
  Signal signal;
  Window window;
  Window pick;  ///< the part of it in which the pulse is looked for
  PickOptions options;
  bool cut_off = false;  ///< the recording ends before the window

  bool too_short() const { return !(window.end > window.begin); }
  Pick failed() const {
    return FailedMeasurement{Failure::empty_window, "the signal ends before the wave can have arrived; record longer (time.end)"};
  }

  Pick peak() const { return too_short() ? failed() : pick_peak(signal, pick, options); }
  /// What follows the window is a reflection, and no part of the pulse.
  Pick centroid(double half_width) const {
    return too_short() ? failed() : pick_centroid(causal(), pick, half_width, options);
  }
  Signal causal() const { return slice(signal, {signal.t0, window.end}); }
};

/// Root mean square of what all probes record before the wave can have come to them, or to each other: of few samples of one
/// signal it may be small by chance.
double noise_of(const std::vector<ProbeSignal>& probes) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const ProbeSignal& p : probes) {
    const SampleRange quiet = samples_in(p.signal, {p.signal.t0, std::max(p.signal.t0, p.window.begin)});
    for (std::size_t n = quiet.first; n < quiet.last; ++n) sum += p.signal.values[n] * p.signal.values[n];
    count += quiet.size();
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

// A released column leaves the strip ringing, without shear stiffness as high as the wave itself or higher, and the wave is what
// comes first: the first crest of half the largest one's height. Forerunners have a tenth of it.
constexpr double kFirstCrest = 0.5;
constexpr double kValley = 0.75;  // a crest ends where the signal has fallen to this part of it

Window until_first_crest(const Signal& signal, const Window& window, double amplitude) {
  if (!(window.end > window.begin)) return window;
  const SampleRange range = samples_in(signal, window);
  const auto upright = [&](std::size_t n) { return amplitude < 0.0 ? -signal.values[n] : signal.values[n]; };
  double largest = 0.0, crest = 0.0;
  for (std::size_t n = range.first; n < range.last; ++n) largest = std::max(largest, upright(n));
  for (std::size_t n = range.first; n < range.last; ++n) {
    crest = std::max(crest, upright(n));
    if (crest >= kFirstCrest * largest && upright(n) < kValley * crest) return {window.begin, signal.time(static_cast<double>(n))};
  }
  return window;
}

std::vector<ProbeSignal> probe_signals(const std::vector<std::vector<double>>& signals, double dt, const ProbeLayout& layout,
                                       const WaveContext& context) {
  PickOptions options;
  options.polarity = context.source_amplitude < 0.0 ? Polarity::negative : Polarity::positive;
  options.expected_amplitude = std::abs(context.source_amplitude);
  options.detection_fraction = context.smallest_arrival;
  std::vector<ProbeSignal> probes;
  for (std::size_t p = 0; p < layout.probes.size(); ++p) {
    const Signal signal{signals[p], dt, 0.0};
    Window window = causal_window(context, layout.probes[p].x);
    const double last = signal.time(static_cast<double>(signal.size()) - 1.0);
    const bool cut_off = last < window.end;
    window.end = std::min(window.end, last);
    const Window pick = context.pulse_width > 0.0 ? window : until_first_crest(signal, window, context.source_amplitude);
    probes.push_back({signal, window, pick, options, cut_off});
  }
  const double noise = noise_of(probes);
  for (ProbeSignal& p : probes) p.options.noise = noise;
  return probes;
}

// Dispersion stretches a pulse: over its own width only, the centroid loses the end that lags behind. On the lattice a tenth
// more takes the error of the shear centroid from -0.04 to 0.004 % (P: -0.07 to -0.014 %).
constexpr double kWindowStretch = 1.1;

/// The same for all probes, as wide as there is room for between each peak and the first reflection.
double centroid_half_width(const std::vector<ProbeSignal>& probes, const std::vector<ProbePick>& picks, double pulse) {
  double room = kWindowStretch * pulse;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    if (picks[p].pick.ok()) room = std::min(room, probes[p].window.end - picks[p].pick.value().time - probes[p].signal.dt);
  }
  return std::max(pulse, room);
}

/// A pair in the wave's order, and why it gives no number, by whatever way its delay is found.
struct Path {
  ProbePair pair;
  std::optional<FailedMeasurement> failure;
};

std::optional<FailedMeasurement> pulse_failure(const ProbeSignal& probe, const Pick& pick, const ProbePair& path, const WaveContext& context) {
  if (!pick.ok()) {
    const bool later = pick.error().failure == Failure::at_edge && probe.cut_off;
    return FailedMeasurement{pick.error().failure, pick.error().reason + (later ? "; record longer (time.end)" : "")};
  }
  return doubt(pick.value(), probe.causal(), path, context);
}

std::vector<Path> paths_of(const std::vector<ProbeSignal>& probes, const std::vector<ProbePick>& picks, double dt, const ProbeLayout& layout,
                           const WaveContext& context) {
  std::vector<Path> paths;
  for (const ProbePair& pair : layout.pairs) {
    Path path{path_of(layout, pair, context), std::nullopt};
    path.failure = obstacle(layout, path.pair, context, dt);
    for (const int p : {path.pair.from, path.pair.to}) {
      if (path.failure) break;
      path.failure = pulse_failure(probes[p], picks[p].pick, path.pair, context);
      if (path.failure) path.failure->reason.insert(0, p == path.pair.from ? "first probe: " : "second probe: ");
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

/// A mean needs more than half of the pairs.
template <class Delay>
WaveSpeed speed_of_pairs(const std::vector<Path>& paths, const WaveContext& context, const Delay& delay) {
  std::vector<PairDelay> delays;
  for (const auto& [pair, failure] : paths) {
    delays.push_back({pair.from, pair.to, pair.distance, failure ? Outcome<double>(*failure) : plausible(delay(pair), pair, context)});
  }
  return consistent(wave_speed(delays, delays.size() / 2 + 1));
}

/// The wave travels at more than half and less than twice the expected speed.
Outcome<double> correlated(const ProbeSignal& from, const ProbeSignal& to, const ProbePair& pair, double speed) {
  const double travel = pair.distance / speed;
  return correlation_delay(from.causal(), to.causal(), {0.5 * travel, 2.0 * travel});
}

std::optional<double> mean_of(const WaveSpeed& w) {
  return w.speed.ok() ? std::optional(w.speed.value().mean) : std::nullopt;
}

std::vector<ProbePick> peaks_of(const std::vector<ProbeSignal>& probes) {
  std::vector<ProbePick> picks;
  for (int p = 0; p < static_cast<int>(probes.size()); ++p) picks.push_back({p, probes[p].peak()});
  return picks;
}

}  // namespace

PickedSpeeds picked_speeds(const WaveMeasurement& m) {
  return {mean_of(m.speed), m.by_centroid ? mean_of(*m.by_centroid) : std::nullopt, mean_of(m.by_correlation)};
}

WaveMeasurement measure_wave(const std::vector<std::vector<double>>& signals, double dt,
                             const ProbeLayout& layout, const WaveContext& context) {
  const auto probes = probe_signals(signals, dt, layout, context);
  std::vector<ProbePick> picks = peaks_of(probes);
  const std::vector<Path> paths = paths_of(probes, picks, dt, layout, context);
  WaveSpeed speed =
      speed_of_pairs(paths, context, [&](const ProbePair& pair) { return delay_between(picks[pair.from].pick, picks[pair.to].pick); });
  std::optional<WaveSpeed> by_centroid;
  if (context.pulse_half_width > 0.0) {
    const double half_width = centroid_half_width(probes, picks, context.pulse_half_width);
    std::vector<Pick> centroids;
    for (const ProbeSignal& probe : probes) centroids.push_back(probe.centroid(half_width));
    by_centroid = speed_of_pairs(paths, context, [&](const ProbePair& pair) { return delay_between(centroids[pair.from], centroids[pair.to]); });
  }
  WaveSpeed by_correlation = speed_of_pairs(
      paths, context, [&](const ProbePair& pair) { return correlated(probes[pair.from], probes[pair.to], pair, context.speed); });
  return {std::move(picks), std::move(speed), std::move(by_centroid), std::move(by_correlation)};
}

std::vector<Outcome<PhaseVelocity>> phase_velocities(const std::vector<std::vector<double>>& signals, double dt,
                                                     const ProbeLayout& layout, const WaveContext& context) {
  const auto probes = probe_signals(signals, dt, layout, context);
  std::vector<Outcome<PhaseVelocity>> out;
  for (const auto& [pair, failure] : paths_of(probes, peaks_of(probes), dt, layout, context)) {
    const ProbeSignal &from = probes[pair.from], &to = probes[pair.to];
    PhaseVelocityOptions options;
    options.noise = from.options.noise.value();
    out.push_back(failure ? Outcome<PhaseVelocity>(*failure)
                          : phase_velocity({from.signal, from.window}, {to.signal, to.window}, pair.distance, options));
  }
  return out;
}

}  // namespace ddem::harness
