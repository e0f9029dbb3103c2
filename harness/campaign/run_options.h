#pragma once
// How a campaign is run: what every unit of it needs to know besides the campaign.

#include <functional>

#include "harness/run/fem_run.h"
#include "harness/scene/scene.h"

namespace ddem::harness {

struct CampaignOptions {
  int jobs = 1;
  bool with_fem = true;
  bool with_waves = true;    ///< false: statics and Bloch limits of the strip alone, and nothing that needs waves
  bool with_studies = true;  ///< of schemes, and of the range of Poisson's ratio
  /// Called from any thread, with the work done since the last call out of campaign_work().
  std::function<void(std::size_t)> on_progress;
  /// Changes what the solvers are given, not the references: a defect that the verdicts must find.
  std::function<void(Scene&)> disturb_scene;
  std::function<void(ContinuumMaterial&)> disturb_continuum;
};

}  // namespace ddem::harness
