#include "harness/run/wave_context.h"

#include <algorithm>
#include <cmath>

#include "harness/model/load.h"

namespace ddem::harness {
namespace {

double travel_time(const WaveContext& c, double x) { return std::abs(x - c.left_end - c.source_centre) / c.speed; }

}  // namespace

WaveContext wave_context(const Scene& scene, const SourceStrip& strip, double speed) {
  WaveContext c;
  c.speed = speed;
  c.length = strip.length;
  c.left_end = strip.left_end;
  c.period = strip.period;
  c.source_centre = source_centre(scene);
  c.source_reach = source_reach(scene).value_or(strip.edge_band);
  c.source_duration = source_duration(scene);
  c.source_amplitude = source_amplitude(scene);
  c.smallest_arrival = smallest_arrival(scene);
  c.pulse_half_width = pulse_half_width(scene, speed);
  c.pulse_width = pulse_width(scene, speed);
  // A gaussian and its image behind a free end have one top between them, at the end, up to a standard width from it.
  if (c.period == 0.0 && c.source_centre > 0.0 && c.source_centre <= c.source_reach / 3.0) c.source_centre = 0.0;
  return c;
}

Window causal_window(const WaveContext& c, double x) {
  const double s = x - c.left_end;
  // The top of the pulse travels at more than half and less than twice the expected speed; what comes back from the
  // right end is a reflection, and a pulse released inside the strip comes a second time, from the left end. A drive's
  // front starts with it, that of a released pulse is ahead of its top.
  const double travel = travel_time(c, x), last = 2.0 * travel + c.source_duration;
  const double ahead = c.source_duration > 0.0 ? 0.0 : c.pulse_half_width;
  if (c.period > 0.0) return {0.5 * travel, std::min(last, c.period / c.speed - travel - ahead)};
  const double from_the_right = (2.0 * c.length - s - c.source_centre) / c.speed - ahead;
  // Half-way between the two tops.
  const double from_the_left = c.source_centre > 0.0 ? std::max(s, c.source_centre) / c.speed : from_the_right;
  return {0.5 * travel, std::min({last, from_the_right, from_the_left})};
}

double time_of_top(const WaveContext& c, double x) { return travel_time(c, x) + 0.5 * c.source_duration; }

double time_of_passage(const WaveContext& c, double x, double margin) {
  return (1.0 + margin) * travel_time(c, x) + 0.75 * c.source_duration;
}

}  // namespace ddem::harness
