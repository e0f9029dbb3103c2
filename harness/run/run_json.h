#pragma once
// The JSON that the commands print: what programs read (names as in the interface).

#include "harness/io/json.h"
#include "harness/run/dem_run.h"
#include "harness/run/fem_plan.h"
#include "harness/run/scene_moduli.h"
#include "harness/run/scene_stability.h"

namespace ddem::harness {

/// Adds speeds and pairs, the same keys whether there was a wave or not; `why_not`: why there is no measurement at all.
void add_measurement(Json& j, const std::optional<WaveMeasurement>& measurement, const ProbeLayout& layout, const std::string& why_not);
/// The picks by peak, with reasons.
Json picks_json(const WaveMeasurement& measurement, const ProbeLayout& layout);

Json run_json(const DemRun& run);
Json moduli_json(const SceneModuli& moduli);
Json stability_json(const SceneStability& stability);
Json fem_json(const FemPlan& plan, const FemResult& result, const std::optional<WaveMeasurement>& measurement);

}  // namespace ddem::harness
