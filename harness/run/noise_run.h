#pragma once
// What becomes of noise in a run of the very scheme: growth where theory has no sharp criterion.

#include "dem/simulation/simulation.h"

namespace ddem::harness {

struct NoiseRun {
  long steps = 0;           ///< done; fewer than intended where the noise diverged
  bool diverged = false;
  double growth = 0.0;      ///< |z| - 1 of a step, from the amplitudes of the third and the last quarter of the run
  double resolution = 0.0;  ///< growth below this is none
};

/// Starts `input` (scheme, step, held discs; its state, receivers and number of steps are replaced) from white noise. As
/// many steps as 2e8 bonds and evaluations take, 1e4 to 1e5: some seconds. Deterministic.
NoiseRun run_noise(const Assembly& assembly, SimulationInput input);

}  // namespace ddem::harness
