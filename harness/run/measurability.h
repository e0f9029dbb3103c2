#pragma once
// Whether signals may be measured: a speed is a number only where there was a wave. One place for every solver, campaign
// and laboratory: it knows places, times and samples, and nothing of what computed them.
//
// Before anything is looked at: both probes of a pair stand beyond the source, on one side of it, and the top of the pulse
// passes them before its echo; samples and steps resolve the pulse. Of every signal: the pulse stands six times above the
// noise and above all that comes before it (picker.h), and is no higher than the source can make it. Of every pair: the
// wave goes from the nearer probe to the farther one at half to twice the expected speed. Of all pairs together: more than
// half of them succeed, and they agree.
//
// False alarms: noise of 1 to 30 % of the expected amplitude, white or coloured, alike in strength at all times, without a
// wave gives a speed in at most 1 of 1000 recordings; with a wave and noise of 5 % at most 1 of 100 recordings gives none.

#include <optional>

#include "harness/measure/wave_speed.h"
#include "harness/model/probes.h"
#include "harness/run/wave_context.h"

namespace ddem::harness {

/// A pair in the order in which the wave passes its probes, and the way between the picks: away from the source, m.
ProbePair path_of(const ProbeLayout& layout, const ProbePair& pair, const WaveContext& context);

/// Why this path gives no number whatever its probes record; each reason ends with what to change.
std::optional<FailedMeasurement> obstacle(const ProbeLayout& layout, const ProbePair& path, const WaveContext& context, double dt);

/// Why a pulse that was picked is none of the source, or not resolved. `causal` ends before the first reflection.
std::optional<FailedMeasurement> doubt(const Arrival& pulse, const Signal& causal, const ProbePair& path, const WaveContext& context);

/// The delay of a wave between the ends of the path, or why it is none.
Outcome<double> plausible(const Outcome<double>& delay, const ProbePair& path, const WaveContext& context);

/// The speed of all pairs, or that they contradict each other.
WaveSpeed consistent(WaveSpeed speed);

/// The longest step with which a drive is marched, s; a longer one hardly samples it.
double longest_drive_step(double duration);
/// By how much a march of that step gets the impulse of a drive wrong, at most; for at least two steps in its duration.
double drive_error(double duration, double step);

}  // namespace ddem::harness
