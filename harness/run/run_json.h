#pragma once
// The JSON that the commands print: what programs read (names as in the interface).

#include "harness/io/json.h"
#include "harness/run/dem_run.h"
#include "harness/run/fem_plan.h"
#include "harness/run/scene_moduli.h"
#include "harness/run/scene_stability.h"

namespace ddem::harness {

Json run_json(const DemRun& run);
Json moduli_json(const SceneModuli& moduli);
Json stability_json(const SceneStability& stability);
Json fem_json(const FemPlan& plan, const FemResult& result, const std::optional<WaveMeasurement>& measurement);

}  // namespace ddem::harness
