#include "harness/campaign/run_campaign.h"

#include "harness/campaign/planned_campaign.h"

namespace ddem::harness {

CampaignResults run_campaign(const StripCampaign& s, const CampaignOptions& options) {
  const PlannedCampaign campaign({.strip = s, .with_waves = options.with_waves, .with_fem = options.with_fem, .with_studies = options.with_studies}, options);
  nightly::RunOptions run;
  run.jobs = options.jobs;
  run.on_progress = options.on_progress;
  return campaign.run(run);
}

}  // namespace ddem::harness
