#pragma once
// A driven strip and its recordings, with places and times of a small campaign.

#include <cmath>
#include <vector>

#include "harness/references/dalembert.h"
#include "harness/run/measure_wave.h"

namespace ddem::harness::recordings {

using Recording = std::vector<std::vector<double>>;

inline constexpr double kSpeed = 2500.0, kLength = 16.5e-3, kDuration = 8e-3 / kSpeed, kDt = kDuration / 100.0, kAmplitude = 1e-8;
inline constexpr std::size_t kSamples = 540;

inline ProbeLayout layout(int pairs) { return nominal_pairs({pairs, true}, kLength, 2e-3); }

inline WaveContext driven() {
  WaveContext c;
  c.speed = kSpeed, c.length = kLength;
  c.source_duration = kDuration, c.source_amplitude = kAmplitude, c.pulse_half_width = 0.5 * kDuration, c.pulse_width = 0.5 * kDuration;
  return c;
}

/// A released column: nothing is known of its pulse, and a hundredth of the amplitude may be one.
inline WaveContext released() {
  WaveContext c;
  c.speed = kSpeed, c.length = kLength;
  c.source_reach = 3e-4, c.source_amplitude = kAmplitude, c.smallest_arrival = 0.01;
  return c;
}

/// A driven strip with its echoes, as high as the source sends it.
inline Recording waves(const ProbeLayout& probes, double amplitude = kAmplitude, double dt = kDt) {
  Recording out;
  for (const Probe& p : probes.probes) {
    std::vector<double>& u = out.emplace_back();
    for (std::size_t n = 0; static_cast<double>(n) * dt < kSamples * kDt; ++n) {
      u.push_back(amplitude * references::driven_strip({kLength, kSpeed, references::End::fixed, references::End::free},
                                                       [](double time) { return references::sin2_motion(time, kDuration); }, p.x,
                                                       static_cast<double>(n) * dt));
    }
  }
  return out;
}

inline bool any_number(const WaveMeasurement& m) {
  return m.speed.speed.ok() || (m.by_centroid && m.by_centroid->speed.ok()) || m.by_correlation.speed.ok();
}

}  // namespace ddem::harness::recordings
