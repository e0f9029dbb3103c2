#pragma once
// What becomes of noise in a run of the very scheme: growth where theory has no sharp criterion.

#include "dem/simulation/simulation.h"

namespace ddem::harness {

struct NoiseRun {
  long steps = 0;           ///< done; fewer than intended where the noise diverged
  bool diverged = false;
  double growth = 0.0;      ///< |z| - 1 of a step, from the amplitudes of the third and the last quarter of the run
  double resolution = 0.0;  ///< growth below this is none
  double detectable = 0.0;  ///< slower growth does not emerge from the noise in so many steps

  bool grew() const { return diverged || growth > resolution; }
};

/// Steps in which growth by `growth` a step emerges from the noise of so many discs.
double steps_to_see(double growth, std::size_t discs);

inline constexpr double kNoiseWork = 2e8;

/// Starts `input` (scheme, step, held discs; its state, receivers and number of steps are replaced) from white noise. As
/// many steps as `work` bonds and evaluations take, 1e4 to 1e5: some seconds. Deterministic.
NoiseRun run_noise(const ddem::Assembly& assembly, SimulationInput input, double work = kNoiseWork);

/// Growth of what flutters fastest, from noise: what find_flutter (dem/spectra/flutter.h) is too slow for. Frequencies are
/// not known then.
struct NoiseFlutter {
  double largest_frequency = 0.0;  ///< omega_max with converged strains, rad/s
  double growth_rate = 0.0;        ///< 1/s: of exp(rate t), where found
  double detectable = 0.0;         ///< slower growth does not emerge from the noise, over omega_max
  bool found = false;
};

/// Whatever the scheme, its strains converge here; at half of their critical step, where vibrations of half the largest
/// frequency grow 3 % faster in a step than in time. 1e5 steps of 20000 bonds, which take a minute, fewer of more.
NoiseFlutter flutter_from_noise(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation, const HeldDofs& held);

}  // namespace ddem::harness
