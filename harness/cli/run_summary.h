#pragma once
// What a run and its signals amount to, for people.

#include "harness/run/dem_run.h"

namespace ddem::harness {

/// Discs, steps and the drift of the energy.
void print_steps(const DemRun& run, const Scene& scene);
/// The pairs, and their mean or why there is none.
void print_speeds(const WaveMeasurement& measurement, const ProbeLayout& layout);

}  // namespace ddem::harness
