#pragma once
// Two sensors of a laboratory: whether they saw the same wave, and by how much later. See laboratory.h.

#include "harness/run/laboratory_pick.h"

namespace ddem::harness {

/// The crest of `to` that answers to that of `from`: where the two signals, four widths on either side, are most alike, as they are or,
/// where `turned` may be, upside down. Two crests of a wave may be as high, and noise may choose another in either sensor. Fails
/// where they are as much alike at another place.
Outcome<Crest> answering_crest(const ClearWave& from, const ClearWave& to, bool may_be_turned);

/// The delay by correlation, in samples, or why the two waves are not one that passes `from` and then `to`.
Outcome<Uncertain> correlated_delay(const ClearWave& from, const ClearWave& to, double width);

/// Why the waves of two sensors are not one, whatever their delay.
std::optional<FailedMeasurement> different_waves(const ClearWave& from, const ClearWave& to);

/// Whether a delay is that of a wave, beyond its noise; in seconds.
Outcome<Uncertain> causal_delay(const Outcome<Uncertain>& delay);

Outcome<PhaseVelocity> phase_velocity_of(const ClearWave& from, const ClearWave& to, double width, double dt, double distance);

}  // namespace ddem::harness
