#pragma once
// Growth a step of a motion, measured: released from it, and from noise.

#include <optional>

#include "harness/studies/stability/subject.h"

namespace ddem::harness {

/// Noise must blow up, in its run, at growth above this.
inline constexpr long kNoiseSteps = 400;
// Noise of displacements holds a share of 1/sqrt(2 discs) of the worst motion, 0.1, or a hundredth of that where rotations and
// strains are most of it, and diverges at 1e3: 1e6 = e^13.8.
inline constexpr double kNoiseGrowth = 14.0 / kNoiseSteps;

/// All but the time step and the start.
SimulationInput input_of(const Subject& subject, const DeformationParameters& d);

/// Released from the predicted motion, its growth a step; empty where the run was too short to tell.
std::optional<double> release(const Solver& solver, const Subject& subject, const Start& start, SimulationInput in);

/// Whether a run from noise blows up.
bool noise_grows(const Solver& solver, const Subject& subject, SimulationInput in);

}  // namespace ddem::harness
