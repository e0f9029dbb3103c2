#pragma once
// Signals that are exact in time (theory section 3): the receivers' values in the states of leapfrog marches from rest, at
// the largest stable step, filtered by Bessel functions (core/time_filter.h). The only error is round-off, at any spacing
// of the samples. It holds where the discs' motion is linear with a stiffness that is the same at all times: plain DEM, and
// implicit strains that derive from an energy, as the polynomial finds them (then exact for the stiffness that it stands
// for, within `tolerance` of converged strains). A start from displacement and velocity and a driven edge are superposed,
// each from a march of its own.

#include "dem/simulation/simulation.h"

namespace ddem {

/// Samples at 0, interval, 2 interval ...
struct Sampling {
  double interval = 0.0;  ///< s
  std::size_t samples = 0;

  double end() const { return interval * static_cast<double>(samples - 1); }
};

/// The step of such a march, s: just below `critical`, where the states stay bounded, and short enough to resolve the drive.
double exact_step(double critical, const std::optional<EdgeDrive>& drive);

/// Multiplications of coefficients and states that the filter takes, about.
double filter_work(const SimulationInput& input, const Sampling& sampling);

/// `input.time_step`: at most exact_step(critical step). Not used are steps, sample_every, energy_samples and snapshots:
/// nothing but signals is kept, and the energy drift of the marches. New contacts that close, in the march or, where that
/// one is not the motion itself, in one that is, end it: new_contacts is set and the signals are empty.
/// Throws std::invalid_argument for lagged strains, conjugate gradients, nonlinear kinematics, or a correction without
/// an energy, and as simulate().
SimulationResult simulate_exact(const Assembly& assembly, const SimulationInput& input, const Sampling& sampling);

}  // namespace ddem
