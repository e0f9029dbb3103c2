// Units whose digest holds and whose content was made up: the campaign is judged, drawn and stored all the same, or a unit is
// named as one that gave no result. Whoever writes a file can write its digest.

#include "harness/campaign/planned_campaign.h"
#include "harness/campaign/report_content.h"
#include "harness/campaign/write_results.h"
#include "harness/io/atomic_file.h"
#include "harness/io/errors.h"
#include "harness/nightly/unit_file.h"
#include "tests/harness/damage/kept_files.h"
#include "tests/harness/damage/mutations.h"

namespace ddem::harness::test {
namespace {

class ForgedUnits : public testing::Test {
 protected:
  static constexpr int kForgeries = 5;  // of every unit
  static constexpr int kAtOnce = 6;      // units in a campaign that is written

  ForgedUnits() : folder_(kept_files() / "night"), campaign_(PlannedCampaign::of_folder(folder_)) {}

  void forge(const nightly::Plan::Entry& unit, Chance& chance) const {
    nightly::UnitRecord record = nightly::read_unit(folder_, unit.id, unit.identity);
    record.outcome.result = forged(record.outcome.result, chance);
    if (chance.below(20) == 0) record.outcome.failure = std::string("made\0up", 7);
    nightly::write_unit(folder_, record);
  }

  /// All that follows from a folder of units.
  void conclude() const {
    const CampaignResults results = campaign_.read(folder_);
    write_results(kept_files() / "forged", results, report_of(results, campaign_.verdicts(results)));
  }

  std::filesystem::path folder_;
  PlannedCampaign campaign_;
};

TEST_F(ForgedUnits, AreJudgedDrawnAndStoredOrNamed) {
  prepare_folder(kept_files() / "forged");
  const std::vector<nightly::Plan::Entry>& units = campaign_.plan().units;
  Chance chance(26);
  for (int round = 0; round < kForgeries; ++round) {
    for (std::size_t first = 0; first < units.size(); first += kAtOnce) {
      const std::size_t last = std::min(units.size(), first + kAtOnce);
      std::vector<std::string> whole;
      for (std::size_t k = first; k < last; ++k) {
        whole.push_back(read_file(nightly::unit_path(folder_, units[k].id)));
        forge(units[k], chance);
      }
      EXPECT_NO_THROW(conclude()) << "round " << round << ", units from " << units[first].id;
      for (std::size_t k = first; k < last; ++k) write_file(nightly::unit_path(folder_, units[k].id), whole[k - first], Flush::none);
    }
  }
}

/// A plan that was made up is refused, or is a campaign.
TEST_F(ForgedUnits, PlansAreRefusedOrPossible) {
  const nightly::Plan plan = nightly::read_plan(folder_);
  Chance chance(5);
  int refused = 0;
  for (int k = 0; k < 300; ++k) {
    const Json campaign = Json(forged(nlohmann::json(plan.campaign), chance));
    try {
      const PlannedCampaign planned(spec_of(campaign));
      EXPECT_FALSE(planned.plan().units.empty());
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 150);
}

}  // namespace
}  // namespace ddem::harness::test
