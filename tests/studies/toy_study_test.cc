// The study that the guide adds: it is listed, run, judged, drawn and stored like any other.

#include <gtest/gtest.h>

#include "harness/campaign/planned_campaign.h"
#include "harness/campaign/report_content.h"
#include "harness/campaign/write_results.h"
#include "harness/io/hdf5.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness {
namespace {

TEST(ToyStudy, IsAStudyLikeAnyOther) {
  CampaignSpec spec = default_campaign();
  spec.only = "toy";
  const PlannedCampaign campaign(spec);
  ASSERT_EQ(campaign.plan().units.size(), 1u);
  const CampaignResults results = campaign.run({});
  const auto verdicts = campaign.verdicts(results);
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts.front().state, reports::State::pass);
  const reports::Report report = report_of(results, verdicts);
  ASSERT_EQ(report.sections.size(), 1u);
  EXPECT_EQ(report.sections.front().heading, "A toy");
  const Scratch scratch;
  write_results(scratch / "", results, report);
  EXPECT_EQ(Hdf5File::open(scratch / "results.h5").root().group("toy").int_attribute("discs"), 682);
  std::size_t listed = 0;
  for (const StudyListing& s : list_studies(default_campaign(), {})) listed += s.id == "toy";
  EXPECT_EQ(listed, 1u);
}

}  // namespace
}  // namespace ddem::harness
