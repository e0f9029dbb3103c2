// A campaign in pieces: every member of a result is carried by its file, pieces make the whole bit by bit,
// and no number that is none passes.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "harness/campaign/planned_campaign.h"
#include "harness/campaign/report_content.h"
#include "harness/io/data_json.h"
#include "harness/nightly/merge.h"
#include "harness/nightly/unit_file.h"
#include "harness/studies/calibration/calibration_data.h"
#include "harness/studies/calibration/design.h"
#include "harness/studies/discrimination/discrimination_data.h"
#include "harness/studies/dispersion/dispersion_data.h"
#include "harness/studies/finite_elements/finite_elements_data.h"
#include "harness/studies/schemes/range.h"
#include "harness/studies/schemes/schemes_data.h"
#include "harness/studies/sizes/sizes_data.h"
#include "harness/studies/stability/noise_release.h"
#include "harness/studies/stability/stability_map.h"
#include "harness/studies/statics/statics_data.h"
#include "harness/studies/strip/outside_members.h"
#include "harness/studies/strip/read_strip.h"
#include "harness/studies/user_cases/user_case.h"
#include "harness/studies/waves/film.h"
#include "harness/studies/waves/waves_data.h"
#include "tests/harness/io/scratch.h"

namespace ddem::harness {
namespace {

using nlohmann::json;

/// Converts to any member.
struct Anything {
  template <class T>
  operator T() const {
    return T{};
  }
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
  EXPECT_EQ(json(T{}).size(), members<T>()) << name << ": name every member beside the type";
}

TEST(ResultsJson, NamesEveryMember) {
#define EXPECT_ALL_MEMBERS(T) expect_all_members<T>(#T)
  EXPECT_ALL_MEMBERS(StripCampaign);
  EXPECT_ALL_MEMBERS(StaticOutcome);
  EXPECT_ALL_MEMBERS(PickedSignal);
  EXPECT_ALL_MEMBERS(Recording);
  EXPECT_ALL_MEMBERS(WaveOutcome);
  EXPECT_ALL_MEMBERS(StripPicture);
  EXPECT_ALL_MEMBERS(WaveSet);
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
  EXPECT_ALL_MEMBERS(Discrimination);
  EXPECT_ALL_MEMBERS(Packing);
  EXPECT_ALL_MEMBERS(UserCase);
  EXPECT_ALL_MEMBERS(UserCaseOutcome);
  EXPECT_ALL_MEMBERS(CaseCriterion);
#undef EXPECT_ALL_MEMBERS
}

CampaignSpec reduced() {
  StripCampaign strip;
  strip.stiffness_ratios = {0.3};
  strip.models = {Model::lagged_full, Model::implicit_full};
  strip.seeds = {1, 2};
  CampaignSpec spec = campaign_of(strip);
  spec.studies = {"waves", "paper_protocol", "statics", "stability"};
  spec.with_continuum = false;
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
  CampaignSpec spec = reduced();
  spec.studies.clear();
  const CampaignOptions options{.jobs = 1, .with_continuum = false, .on_progress = {}, .disturb_scene = {}, .disturb_continuum = {}};
  std::set<std::string> kinds_seen;
  std::size_t injected = 0;
  const Scratch scratch;
  const PlannedCampaign campaign(spec, options);
  nightly::write_plan(scratch / "", campaign.plan());
  const Selection selection = select(spec, options);
  for (const PlannedStudy& study : selection.studies) {
    for (const Piece& piece : study.study->pieces()) {
      const std::string kind = piece.unit.id.substr(0, piece.unit.id.find('/'));
      if (kind == "sizes" || kind == "schemes" || kind == "dispersion" || kind == "discrimination" || !kinds_seen.insert(kind).second)
        continue;  // of each kind one; not the longest
      const json good = piece.unit.run();
      std::map<std::string, json::json_pointer> places;
      collect_numbers(good, json::json_pointer(), "", places);
      EXPECT_FALSE(places.empty()) << piece.unit.id;
      for (const auto& [name, place] : places) {
        for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
          nightly::Unit unit = piece.unit;
          unit.run = [&, p = place] {
            json bad = good;
            bad[p] = wrong;
            return bad;
          };
          const nightly::Outcome outcome = nightly::run_unit(unit);
          EXPECT_TRUE(outcome.result.is_null()) << unit.id << name;
          EXPECT_NE(outcome.failure.find(place.to_string()), std::string::npos) << outcome.failure;
          ++injected;
        }
      }
    }
  }
  EXPECT_GE(kinds_seen.size(), 5u);
  EXPECT_GE(injected, 80u);
}

/// A unit that failed is an ERROR of its own, and of every case that needs it.
TEST(CampaignUnits, AFailureIsInEveryCaseThatNeedsIt) {
  CampaignSpec spec = reduced();
  spec.only = "static/hexagonal/lagged-full/kt0.30";
  CampaignOptions options;
  options.disturb_scene = [](Scene&) { throw std::runtime_error("no such day"); };
  const PlannedCampaign campaign(spec, options);
  const auto verdicts = campaign.verdicts(campaign.run({}));
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts.front().state, reports::State::error);
  EXPECT_NE(verdicts.front().reason.find("no such day"), std::string::npos);
}

/// Nothing passes of a campaign without results, and its report can be drawn.
TEST(CampaignUnits, WithoutAnyResultNothingPasses) {
  CampaignSpec spec = reduced();
  spec.studies.clear();
  spec.with_continuum = true;
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
