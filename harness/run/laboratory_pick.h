#pragma once
// One sensor of a laboratory by itself: where its wave is, and when its marks pass. See laboratory.h.

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/measure/noise_spread.h"
#include "harness/measure/quiet_part.h"
#include "harness/run/laboratory.h"

namespace ddem::harness {

/// A sensor whose wave stands clear of the noise. Places are samples.
struct ClearWave {
  Levelled levelled;
  bool clipped = false;
  double width = 0.0;  ///< of the crest at half its height

  /// Student's widening for sums over so many samples, and no fewer than the crest has.
  double widening(double length) const { return student_widening(levelled.independent(std::max(length, width))); }
  double sign() const { return levelled.crest.sign; }
  std::span<const double> quiet() const { return std::span(levelled.values).first(levelled.quiet); }
};

/// `values` as they were recorded, `filtered` after the band-pass, if any: tops are clipped before it.
Outcome<ClearWave> clear_wave(std::span<const double> values, std::span<const double> filtered, double dt, double widest_gap,
                              const LaboratoryOptions& options);

/// The same recording with another of its crests as the wave's, under the same rules.
Outcome<ClearWave> with_crest(ClearWave wave, const Crest& crest, double dt, double widest_gap, const LaboratoryOptions& options);

/// The wave turned upright.
std::vector<double> upright(const ClearWave& wave);

/// Samples; `width` is that of the pair or of all sensors, so that what the marks get wrong they get wrong alike.
Outcome<Uncertain> top_of(const ClearWave& wave, double width);
Outcome<Uncertain> first_break_of(const ClearWave& wave, double width);
Outcome<Uncertain> centroid_of(const ClearWave& wave, double width, std::optional<double> source_duration);

/// Whether a signal stands still at its highest value, or its lowest for sign -1: three samples or more in a row, next to which it
/// falls faster than the top of a pulse does, however coarse the digits.
bool has_flat_top(std::span<const double> values, double sign);

}  // namespace ddem::harness
