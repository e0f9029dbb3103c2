#pragma once
// What a load may ask of small displacements and of steps, and what it must not have done: reasons to refuse a run, to warn
// of it, or to measure nothing in it.

#include <optional>
#include <string>
#include <vector>

#include "dem/simulation/simulation.h"
#include "harness/run/wave_context.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

/// Warnings of a load before it acts. Of linear kinematics: displacements from which more than 0.1 % of error is to be
/// expected. Those of a pulse or drive are its amplitude, those of any state what it asks for between bonded discs, so that a
/// body that moves as a whole asks for none. Of a march: a drive that its steps hardly sample. Throws InputError for
/// displacements beyond the mean radius, and for a drive of two steps or less. `march_step`: 0 where signals are exact in time.
std::vector<std::string> load_warnings(const Scene& scene, const ddem::Assembly& assembly, const ddem::InitialState& initial,
                                       double critical_time_step, double march_step);

/// The same of the state at the end of a run that started from files: velocities do not tell before how far they go.
std::optional<std::string> end_warning(const Scene& scene, const ddem::Assembly& assembly, const ddem::InitialState& end);

/// A march of a drive with that step, s: InputError where the steps hardly sample it, a warning with the expected error, or
/// none. The drive's scene may be the continuum's.
std::optional<std::string> drive_warning(const Scene& scene, double march_step);

/// Of the continuum, whose displacements have no disc to be compared with: linear elasticity holds for small strains. The
/// largest one of the source; InputError beyond one half, a radius between neighbouring discs.
std::optional<std::string> strain_warning(const Scene& scene, const WaveContext& context, double column_spacing);

/// Why nothing may be measured: energy that came from nowhere after the source had ended at `source_end`, s. Damping lowers
/// it, and the usual energy oscillates near the critical step, by less than this asks for.
std::optional<FailedMeasurement> growth_of(const std::vector<EnergySample>& energy, double source_end);

}  // namespace ddem::harness
