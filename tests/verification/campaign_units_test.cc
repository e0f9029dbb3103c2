// A campaign in pieces: every member of a result is carried by its file, pieces make the whole bit by bit,
// and no number that is none passes.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "harness/campaign/planned_campaign.h"
#include "harness/campaign/report_content.h"
#include "harness/campaign/results_json.h"
#include "harness/campaign/verdicts.h"
#include "harness/nightly/merge.h"
#include "harness/nightly/unit_file.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness {
namespace {

using nlohmann::json;

/// Converts to any member.
struct Anything {
  template <class T>
  operator T() const;
};

/// How many members an aggregate has: the most values that it takes in braces. Members that are aggregates
/// themselves count as one, since Anything converts to them.
template <class T, class... Values>
consteval std::size_t members() {
  if constexpr (requires { T{Values{}..., Anything{}}; })
    return members<T, Values..., Anything>();
  else
    return sizeof...(Values);
}

template <class T>
void expect_all_members(const char* name) {
  EXPECT_EQ(json(T{}).size(), members<T>()) << name << ": name every member in results_json.h";
}

TEST(ResultsJson, NamesEveryMember) {
#define EXPECT_ALL_MEMBERS(T) expect_all_members<T>(#T)
  EXPECT_ALL_MEMBERS(StripCampaign);
  EXPECT_ALL_MEMBERS(StaticOutcome);
  EXPECT_ALL_MEMBERS(PickedSignal);
  EXPECT_ALL_MEMBERS(Recording);
  EXPECT_ALL_MEMBERS(WaveOutcome);
  EXPECT_ALL_MEMBERS(StripPicture);
  EXPECT_ALL_MEMBERS(MaterialOutcome);
  EXPECT_ALL_MEMBERS(StabilityOutcome);
  EXPECT_ALL_MEMBERS(FemOutcome);
  EXPECT_ALL_MEMBERS(EnergyCurve);
  EXPECT_ALL_MEMBERS(ReachCurve);
  EXPECT_ALL_MEMBERS(OrderCurve);
  EXPECT_ALL_MEMBERS(SchemeStudy);
  EXPECT_ALL_MEMBERS(RangeStudy);
  EXPECT_ALL_MEMBERS(CalibrationOutcome);
  EXPECT_ALL_MEMBERS(DesignStudy);
  EXPECT_ALL_MEMBERS(StabilityPoint);
  EXPECT_ALL_MEMBERS(StabilityMap);
  EXPECT_ALL_MEMBERS(DispersionBranch);
  EXPECT_ALL_MEMBERS(DispersionPanel);
  EXPECT_ALL_MEMBERS(DispersionStudy);
  EXPECT_ALL_MEMBERS(SizedWave);
  EXPECT_ALL_MEMBERS(SizedStrip);
  EXPECT_ALL_MEMBERS(bench::PrecisionPoint);
  EXPECT_ALL_MEMBERS(Discrimination);
  EXPECT_ALL_MEMBERS(Packing);
  EXPECT_ALL_MEMBERS(UserCase);
  EXPECT_ALL_MEMBERS(UserCaseOutcome);
  EXPECT_ALL_MEMBERS(CaseCriterion);
#undef EXPECT_ALL_MEMBERS
}

CampaignSpec reduced() {
  CampaignSpec spec;
  spec.strip.stiffness_ratios = {0.3};
  spec.strip.models = {Model::lagged_full, Model::implicit_full};
  spec.strip.seeds = {1, 2};
  spec.with_fem = spec.with_studies = false;
  return spec;
}

/// A unit's content, times left out.
std::map<std::string, std::string> contents(const PlannedCampaign& campaign,
                                            const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& u : campaign.plan().units)
    all[u.id] = nightly::content_digest(nightly::read_unit(folder, u.id, u.identity));
  return all;
}

TEST(CampaignUnits, PiecesMakeTheWholeBitByBit) {
  const Scratch scratch;
  const PlannedCampaign campaign(reduced());
  campaign.run({.folder = scratch / "whole", .jobs = 2});
  std::vector<std::filesystem::path> shards;
  for (const std::size_t i : {1u, 2u, 3u}) {
    shards.push_back(scratch / ("shard" + std::to_string(i)));
    std::filesystem::create_directories(shards.back());
    // Every shard is another process: nothing is shared in memory.
    const PlannedCampaign alone(reduced());
    nightly::write_plan(shards.back(), alone.plan());
    alone.run({.folder = shards.back(), .shard = {i, 3}});
  }
  std::filesystem::create_directories(scratch / "merged");
  EXPECT_TRUE(nightly::merge_folders(shards, scratch / "merged").missing.empty());
  EXPECT_EQ(contents(campaign, scratch / "merged"), contents(campaign, scratch / "whole"));

  const PlannedCampaign read = PlannedCampaign::of_folder(scratch / "merged");
  const auto judged = [&](const CampaignResults& r) {
    std::string text;
    for (const reports::Verdict& v : read.verdicts(r)) {
      text += v.case_id + v.reason;
      for (const reports::Criterion& c : v.criteria)
        text += fmt::format("{} {:a} {:a}\n", c.metric, c.actual, c.target);
    }
    return text;
  };
  EXPECT_EQ(judged(read.read(scratch / "merged")), judged(campaign.run({})));
}

/// Places of numbers in a result, one for all elements of an array.
void collect_numbers(const json& value, const json::json_pointer& at, const std::string& kind,
                     std::map<std::string, json::json_pointer>& places) {
  if (value.is_number_float()) places.emplace(kind, at);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items())
      collect_numbers(member, at / key, kind + "/" + key, places);
  } else if (value.is_array()) {
    for (std::size_t n = 0; n < value.size(); ++n) collect_numbers(value[n], at / n, kind + "/*", places);
  }
}

TEST(CampaignUnits, ANumberThatIsNoneNeverPasses) {
  CampaignOptions options;
  options.with_fem = false;
  options.with_studies = true;
  const StripCampaign s = reduced().strip;
  std::set<std::string> kinds_seen;
  std::size_t injected = 0;
  const auto units = units_of(s, options);
  for (const CampaignUnit& u : units) {
    const std::string kind = u.unit.id.substr(0, u.unit.id.find('/'));
    if (kind == "sizes" || kind == "schemes" || kind == "dispersion" || kind == "discrimination" ||
        !kinds_seen.insert(kind).second)
      continue;  // of each kind one; not the longest
    const json good = u.unit.run();
    std::map<std::string, json::json_pointer> places;
    collect_numbers(good, json::json_pointer(), "", places);
    EXPECT_FALSE(places.empty()) << u.unit.id;
    for (const auto& [name, place] : places) {
      for (const double wrong :
           {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        nightly::Unit unit = u.unit;
        unit.run = [&, p = place] {
          json bad = good;
          bad[p] = wrong;
          return bad;
        };
        CampaignResults r = empty_results(s, options);
        take_outcome(u, nightly::run_unit(unit), r);
        const auto verdicts = verdicts_of(r);
        const auto found = std::find_if(verdicts.begin(), verdicts.end(), [&](const reports::Verdict& v) {
          return v.case_id == "unit/" + u.unit.id;
        });
        ASSERT_NE(found, verdicts.end()) << u.unit.id << name;
        EXPECT_EQ(found->state, reports::State::error);
        EXPECT_NE(found->reason.find(place.to_string()), std::string::npos) << found->reason;
        ++injected;
      }
    }
  }
  EXPECT_GE(kinds_seen.size(), 5u);
  EXPECT_GE(injected, 80u);
}

/// Nothing passes of a campaign without results, and its report can be drawn.
TEST(CampaignUnits, WithoutAnyResultNothingPasses) {
  CampaignSpec spec = reduced();
  spec.with_fem = spec.with_studies = true;
  const PlannedCampaign campaign(spec);
  const Scratch scratch;
  const CampaignResults nothing = campaign.read(scratch / "");
  EXPECT_FALSE(reports::render_html(report_of(nothing, campaign.verdicts(nothing))).empty());
  for (const reports::Verdict& v : campaign.verdicts(nothing)) {
    EXPECT_EQ(v.state, reports::State::error) << v.case_id;
  }
}

}  // namespace
}  // namespace ddem::harness
