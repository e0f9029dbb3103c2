#pragma once
// Wave speeds without time steps, for the report: how far static moduli and Bloch limits are from the
// lattice's closed form, beside the driven pulses of the same campaign; and the static speeds of random
// packings.

#include "harness/studies/strip/strip_results.h"
#include "reports/figure.h"
#include "reports/table.h"

namespace ddem::harness {

/// Relative error of a lattice's speed by each way; empty: not run, or it gave none.
struct SpeedErrors {
  std::optional<double> statics, bloch, peak, centroid;
};
/// Of shear or P waves against the closed form.
SpeedErrors lattice_errors(const StripResults& results, const StaticOutcome& lattice, StripWave wave);

/// A panel a model and wave, over k_t/k_n, and a table of the same with the seconds that each took.
reports::Figure speed_error_figure(const StripResults& results);
reports::Table speed_error_table(const StripResults& results);

/// Means over the random packings, with their span and the kinematic bound.
reports::Figure static_speed_figure(const StripResults& results);

}  // namespace ddem::harness
