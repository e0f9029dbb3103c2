#pragma once
// What a bar run would measure if the free strip were a continuum: the S0 wave of the same pulse, measured in the same way.

#include "harness/references/s0_pulse.h"
#include "harness/run/measure_wave.h"

namespace ddem::harness {

/// The probes' signals of a driven edge (see s0_pulse.h), measured like recorded ones. `strip.bar_speed` and
/// `strip.poisson_ratio` are those of the strip under tension; a contraction below 0 counts as 0, where S0 has no
/// dispersion (it goes with its square). Throws std::invalid_argument for a source that is not a driven edge.
WaveMeasurement s0_measurement(const references::FreeStrip& strip, const ProbeLayout& layout, const WaveContext& context);

}  // namespace ddem::harness
