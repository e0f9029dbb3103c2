#include "harness/run/measurability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace ddem::harness {
namespace {

// Of a pulse at half its height. Three points of a parabola need four samples there to lie on its top.
constexpr double kLeastSamplesOfAWave = 4.0;
// Leapfrog moves waves of period T by (2 pi dt/T)^2/24; what discs pass on of a pulse of four steps is longer (0.3 % then).
constexpr double kLeastSteps = 4.0;
// By which a pick between samples may falsify a speed.
constexpr double kSamplingError = 1e-3;
// Two tops of gaussians are two while they are four standard widths apart: of the source and its image behind an end.
constexpr double kTwoTops = 2.0 / 3.0;  // of the reach
// How much of a pulse's width at half height the fit over its top takes on either side, with some room.
constexpr double kTopOfAWave = 0.25;
// Dispersion and scatter widen pulses; what is narrower than half of what was sent is none.
constexpr double kNarrowestWave = 0.5;
// What arrives is at most what was sent; free edges and single discs add something.
constexpr double kHighest = 3.0;
// Pairs scatter by 15 % of their mean in the worst of random strips (free edges, no shear stiffness), and in slow noise of 5 %.
constexpr double kMostScatter = 0.25;

double millimetres(double metres) { return 1e3 * metres; }

FailedMeasurement beside_source(std::string reason) { return {Failure::beside_source, std::move(reason)}; }

/// How a smaller reach is written in a scene.
std::string narrower(const WaveContext& c, double reach) {
  const bool senseless = reach < 0.01 * c.source_reach;  // narrower than discs
  if (!(c.pulse_width > 0.0) || c.source_duration > 0.0 || senseless) return "put the probes further away, in a longer assembly";
  const bool gaussian = c.pulse_width < 0.99 * c.pulse_half_width;
  const double width = millimetres(gaussian ? reach / 3.0 : reach);
  return fmt::format("narrow it (initial.width at most {:.3g} mm){}", width, gaussian ? " or let it start further away (initial.center)" : "");
}

/// The source and its image behind an end are two pulses, or one: in between they are neither.
std::optional<FailedMeasurement> end_failure(const WaveContext& c) {
  if (c.period > 0.0 || !(c.pulse_half_width > 0.0) || c.source_duration > 0.0) return std::nullopt;
  const double room = kTwoTops * c.source_reach;
  if (c.source_centre == 0.0 || (c.source_centre >= room && c.source_centre <= c.length - room)) return std::nullopt;
  return beside_source(fmt::format("the pulse starts at {:.4g} mm, so near to an end of the strip that it meets its own echo at once; let it start "
                                   "at the left end (initial.center = 0), or {:.3g} mm or more from either end",
                                   millimetres(c.source_centre), millimetres(room)));
}

std::optional<FailedMeasurement> place_failure(const ProbeLayout& layout, const ProbePair& path, const WaveContext& c) {
  const double from = layout.probes[path.from].x - c.left_end - c.source_centre, to = layout.probes[path.to].x - c.left_end - c.source_centre;
  const double nearer = std::min(std::abs(from), std::abs(to));
  if ((from > 0.0) != (to > 0.0)) {
    return beside_source(fmt::format("the source, at {:.4g} mm, lies between the probes, at {:.4g} and {:.4g} mm: no wave passes from one to the "
                                     "other; let it start at the left end (initial.center = 0), or beyond all pairs of probes",
                                     millimetres(c.source_centre), millimetres(from + c.source_centre), millimetres(to + c.source_centre)));
  }
  if (nearer <= c.source_reach) {
    return beside_source(fmt::format("a probe stands {:.4g} mm from the centre of the source, which reaches {:.4g} mm: it sees no pulse pass; {}",
                                     millimetres(nearer), millimetres(c.source_reach), narrower(c, nearer)));
  }
  if (c.period > 0.0 && std::max(std::abs(from), std::abs(to)) > 0.5 * c.period) {
    return beside_source("a probe is nearer to the source through the period: both waves cross there; move initial.center nearer to the pairs of probes");
  }
  return std::nullopt;
}

std::optional<FailedMeasurement> echo_failure(const ProbeLayout& layout, const ProbePair& path, const WaveContext& c) {
  for (const int p : {path.from, path.to}) {
    const double x = layout.probes[p].x, top = time_of_top(c, x), end = causal_window(c, x).end;
    if (top + kTopOfAWave * c.pulse_width <= end) continue;
    return beside_source(fmt::format("the echo of the pulse reaches the probe at {:.4g} mm before the top of the pulse is expected to pass, at {:.4g} us; "
                                     "shorten {} or lengthen the strip",
                                     millimetres(x - c.left_end), 1e6 * top, c.source_duration > 0.0 ? "drive.duration" : "initial.width"));
  }
  return std::nullopt;
}

/// The samples and steps that a pulse of that width takes. A parabola through three samples of a squared sine misses its top
/// by 0.41 dt (dt/width)^2 where that lies between two of them; a delay has two tops.
std::optional<FailedMeasurement> resolution_failure(double width, double delay, const WaveContext& c, double dt) {
  const double coarsest = std::min(width / kLeastSamplesOfAWave, std::cbrt(kSamplingError * delay * width * width / 0.82));
  const double round_off = 1.0 + 1e-9;
  if (c.march_step > 0.0 && c.pulse_width > 0.0 && c.march_step * kLeastSteps > width * round_off) {
    return FailedMeasurement{Failure::undersampled,
                             fmt::format("the pulse is {:.3g} us wide at half its height, which takes {:.3g} steps of {:.3g} us, and {} are needed; "
                                         "shorten the step {:.2g} times (time.step_fraction), or send a longer pulse",
                                         1e6 * width, width / c.march_step, 1e6 * c.march_step, kLeastSteps, kLeastSteps * c.march_step / width)};
  }
  if (dt <= coarsest * round_off) return std::nullopt;
  const double every = c.sample_step > 0.0 ? std::floor(coarsest * round_off / c.sample_step) : 0.0;
  return FailedMeasurement{Failure::undersampled,
                           fmt::format("the pulse is {:.3g} us wide at half its height, which takes {:.3g} samples, and {:.3g} are needed; {}", 1e6 * width,
                                       width / dt, width / coarsest,
                                       every >= 1.0 ? fmt::format("set time.sample_every = {:.0f}{}", every, every > 1.0 ? " or less" : "")
                                                    : fmt::format("take samples every {:.3g} us or closer{}", 1e6 * coarsest,
                                                                  c.sample_step > 0.0 ? ": lower the time step (time.step_fraction)" : ""))};
}

}  // namespace

ProbePair path_of(const ProbeLayout& layout, const ProbePair& pair, const WaveContext& c) {
  const double from = layout.probes[pair.from].x - c.left_end - c.source_centre, to = layout.probes[pair.to].x - c.left_end - c.source_centre;
  return std::abs(to) >= std::abs(from) ? pair : ProbePair{pair.to, pair.from, pair.distance};
}

std::optional<FailedMeasurement> obstacle(const ProbeLayout& layout, const ProbePair& path, const WaveContext& c, double dt) {
  if (c.obstacle) return c.obstacle;
  if (auto failure = end_failure(c)) return failure;
  if (auto failure = place_failure(layout, path, c)) return failure;
  if (auto failure = echo_failure(layout, path, c)) return failure;
  if (c.pulse_width > 0.0) return resolution_failure(c.pulse_width, path.distance / c.speed, c, dt);
  return std::nullopt;
}

std::optional<FailedMeasurement> doubt(const Arrival& pulse, const Signal& causal, const ProbePair& path, const WaveContext& c) {
  double highest = 0.0;
  for (const double u : causal.values) highest = std::max(highest, std::abs(u));
  if (const double sent = std::abs(c.source_amplitude); highest > kHighest * sent) {
    return FailedMeasurement{Failure::too_high, fmt::format("the signal reaches {:.3g} mm, {:.3g} times what the source sends: something grows, or came from elsewhere",
                                                            millimetres(highest), highest / sent)};
  }
  if (pulse.width < kNarrowestWave * c.pulse_width) {
    return FailedMeasurement{Failure::not_first, fmt::format("what was picked is {:.3g} us wide at half its height, and the source's pulse {:.3g} us: it is another",
                                                             1e6 * pulse.width, 1e6 * c.pulse_width)};
  }
  return resolution_failure(pulse.width, path.distance / c.speed, c, causal.dt);
}

Outcome<double> plausible(const Outcome<double>& delay, const ProbePair& path, const WaveContext& c) {
  if (!delay.ok()) return delay;
  const double speed = path.distance / delay.value();
  if (delay.value() > 0.0 && speed >= 0.5 * c.speed && speed <= 2.0 * c.speed) return delay;
  return FailedMeasurement{Failure::not_causal, fmt::format("the delay, {:.4g} us, is not that of a wave at half to twice the expected {:.4g} m/s: "
                                                            "the two picks are not of one pulse",
                                                            1e6 * delay.value(), c.speed)};
}

WaveSpeed consistent(WaveSpeed w) {
  if (!w.speed.ok() || !w.speed.value().stddev) return w;
  const auto [mean, stddev] = w.speed.value();
  if (*stddev <= kMostScatter * mean) return w;
  w.speed = FailedMeasurement{Failure::inconsistent, fmt::format("the pairs contradict each other: {:.4g} m/s with a standard deviation of {:.3g} m/s; they "
                                                                 "did not see one pulse pass",
                                                                 mean, *stddev)};
  return w;
}

double longest_drive_step(double duration) { return 0.5 * duration; }

double drive_error(double duration, double step) {
  // Of the sum of sin^2(pi n dt/T) dt against T/2: third order, since the curvature of the motion jumps at its ends.
  return 0.4 * std::pow(step / duration, 3);
}

}  // namespace ddem::harness
