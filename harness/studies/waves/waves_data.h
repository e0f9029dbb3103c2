#pragma once
// What the waves of the strip leave: speeds, and recordings for the figures.

#include <optional>
#include <string>
#include <vector>

#include "harness/run/measure_wave.h"
#include "harness/studies/strip/material.h"
#include "dem/core/packing.h"

namespace ddem::harness {

struct PickedSignal {
  std::string probe;
  double x = 0.0;                     ///< m, from the source
  std::vector<double> values;         ///< m
  double window_end = 0.0;            ///< s: what follows is no first arrival
  std::optional<double> pick_time, pick_amplitude;
  std::string pick_failure;
};

/// A recording kept for the figures.
struct Recording {
  double sample_interval = 0.0;  ///< s
  std::vector<PickedSignal> signals;
};

/// Every so many samples, 300 to 600 of each signal: what is stored of a recording, and more than a figure shows.
Recording thinned(const Recording& recording);

/// One simulation.
struct WaveOutcome {
  StripCase c;
  std::string scene;    ///< its scene file
  std::string failure;  ///< why there is no speed; empty: ok
  bool diverged = false;
  long diverged_step = 0;
  int diverged_disc = 0;
  std::optional<double> speed, speed_stddev;  ///< peak to peak, m/s, over its pairs of probes
  std::optional<double> centroid_speed, correlation_speed;  ///< of driven pulses, m/s
  PickedSpeeds s0;  ///< a driven bar's: what S0 makes of the static speed
  int good_pairs = 0;
  double static_speed = 0.0, kinematic_speed = 0.0;
  double section_speed = 0.0;  ///< static, between the same sections; 0 on the lattice and for single discs
  double time_step = 0.0, critical_time_step = 0.0;
  long steps = 0;
  double seconds = 0.0;  ///< wall time, the mean of its material's waves
  Recording recording;
};

/// The random strip of the first seed, for its picture: positions, the displacement half-way through a column release
/// (bar), and the probes of the paper's protocol.
struct StripPicture {
  Packing packing;
  double time = 0.0;  ///< s
  std::vector<double> displacement;
  std::vector<double> probe_x, probe_y;
  std::vector<std::string> probe_labels;
};

/// What a unit sends through the strip of one material by one protocol.
struct WaveSet {
  std::vector<WaveOutcome> waves;       ///< in the order of cases_of()
  std::optional<StripPicture> picture;  ///< of the material that shows_strip(), long waves
};

DDEM_MEMBERS(PickedSignal, probe, x, values, window_end, pick_time, pick_amplitude, pick_failure)
DDEM_MEMBERS(Recording, sample_interval, signals)
DDEM_MEMBERS(PickedSpeeds, peak, centroid, correlation)
DDEM_MEMBERS(WaveOutcome, c, scene, failure, diverged, diverged_step, diverged_disc, speed, speed_stddev, centroid_speed,
             correlation_speed, s0, good_pairs, static_speed, kinematic_speed, section_speed, time_step, critical_time_step,
             steps, seconds, recording)
DDEM_MEMBERS(StripPicture, packing, time, displacement, probe_x, probe_y, probe_labels)
DDEM_MEMBERS(WaveSet, waves, picture)

/// Throw std::runtime_error where members that belong together do not fit: a result of another program.
void require_whole(const Recording& found);
void require_whole(const WaveSet& found);

}  // namespace ddem::harness
