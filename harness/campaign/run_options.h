#pragma once
// How a campaign is run: what every unit of it needs to know besides the campaign.

#include <functional>

#include "harness/run/fem_run.h"
#include "harness/scene/scene.h"
#include "harness/solvers/solver.h"

namespace ddem::harness {

struct CampaignOptions {
  int jobs = 1;
  const Solver* solver = &builtin_solver();
  bool with_continuum = true;  ///< studies may run ddem-fem
  /// Called from any thread, with the units of work done since the last call.
  std::function<void(std::size_t)> on_progress;
  /// Changes what the solvers are given, not the references: a defect that the verdicts must find.
  std::function<void(Scene&)> disturb_scene;
  std::function<void(ContinuumMaterial&)> disturb_continuum;
};

}  // namespace ddem::harness
