// Wave speeds of a campaign without time steps: Bloch limits against closed forms, verdicts that find a
// millionth, and nothing that steps in time among the units.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "harness/studies/statics/bloch_limit.h"
#include "harness/campaign/planned_campaign.h"
#include "harness/campaign/report_content.h"
#include "harness/studies/statics/statics_figures.h"
#include "harness/studies/statics/statics_verdicts.h"
#include "harness/studies/strip/read_strip.h"
#include "harness/studies/strip/strip_statics.h"
#include "harness/references/effective_moduli.h"

namespace ddem::harness {
namespace {

StripCampaign reduced() {
  StripCampaign s;
  s.stiffness_ratios = {0.0, 0.3};
  s.seeds = {1, 2};
  s.discs = 300;
  s.length = 7.3e-3;
  s.pulse_length = 4e-3;
  return s;
}

/// Solved once for all tests.
const StripResults& results() {
  static const StripResults solved = [] {
    StripResults r;
    r.campaign = reduced();
    StripStatics statics(r.campaign, {});
    for (const StripMaterial& m : materials_of(r.campaign)) r.statics.push_back(statics.of(m));
    return r;
  }();
  return solved;
}

/// The states of the criteria that failed, "case: metric".
std::vector<std::string> failed(const StripResults& r) {
  std::vector<std::string> names;
  const auto look = [&](const reports::Verdict& v) {
    for (const reports::Criterion& c : v.criteria) {
      if (c.state != reports::State::pass) names.push_back(v.case_id + ": " + c.metric);
    }
  };
  for (const StaticOutcome& s : r.statics) {
    if (s.key.packing != StripPacking::hexagonal) continue;
    look(static_verdict(s));
    look(random_static_verdict(r, {StripPacking::random, 0, s.key.model, s.key.stiffness_ratio}));
  }
  return names;
}

CampaignSpec statics_alone() {
  CampaignSpec spec = campaign_of(reduced());
  spec.studies = {"statics"};
  return spec;
}

StaticOutcome& lattice(StripResults& r, Model model) {
  return *std::find_if(r.statics.begin(), r.statics.end(), [&](const StaticOutcome& s) {
    return s.key == StripMaterial{StripPacking::hexagonal, 0, model, 0.3};
  });
}

// bloch_limit.cc: dispersion leaves 1.5e-9 and round-off 1e-9 of discs ten times as soft as their contacts;
// twice that. At kr = 0.005 alone the dispersion of rigid discs, A = 0.15, would be 4e-6.
TEST(BlochLimit, IsTheClosedFormAtAnySoftnessAndRatio) {
  using references::ContactModel;
  constexpr double kNormal = 1e10, kDensity = 2000.0, kRadius = 1e-4, kPoisson = 0.3;
  const double bulk_density = kDensity * references::hexagonal_fabric().solid_fraction;
  const std::vector<std::pair<ContactModel, Correction>> models = {
      {ContactModel::ddem_normal, Correction::normal}, {ContactModel::ddem_full, Correction::full}};
  const auto expect_closed_form = [&](ContactModel model, const DeformationParameters& d, double ratio) {
    ContactParameters contact;
    contact.normal_stiffness = kNormal;
    contact.stiffness_ratio = ratio;
    const references::PlaneModuli moduli = references::effective_moduli(
        model, references::hexagonal_fabric(), {kNormal, ratio}, {{d.young_modulus, d.poisson_ratio}});
    const auto closed = references::bulk_wave_speeds(moduli, bulk_density);
    const BlochLimit bloch = bloch_limit({kRadius, kDensity}, contact, d);
    EXPECT_NEAR(bloch.shear / closed.shear, 1.0, 5e-9) << ratio << " " << d.young_modulus;
    EXPECT_NEAR(bloch.p / closed.p, 1.0, 5e-9) << ratio << " " << d.young_modulus;
  };
  for (const double ratio : {0.0, 0.1, 0.5, 1.0}) {
    expect_closed_form(ContactModel::dem, {}, ratio);
    for (const auto& [model, correction] : models) {
      for (const double softness : {0.01, 0.25, 10.0}) {
        DeformationParameters d;
        d.scheme = Scheme::implicit;
        d.correction = correction;
        d.young_modulus = kNormal / softness;
        d.poisson_ratio = kPoisson;
        expect_closed_form(model, d, ratio);
      }
    }
  }
}

TEST(StaticCampaign, PassesAndTakesNoStep) {
  EXPECT_EQ(failed(results()), std::vector<std::string>{});
  const PlannedCampaign planned(statics_alone());
  EXPECT_EQ(planned.plan().units.size(), results().statics.size());
  for (const auto& unit : planned.plan().units) EXPECT_TRUE(unit.id.starts_with("statics/")) << unit.id;
  const CampaignResults found = planned.run({});
  const std::vector<reports::Verdict> verdicts = planned.verdicts(found);
  // The lattice and the random packings of four models at two ratios.
  EXPECT_EQ(verdicts.size(), 16u);
  for (const reports::Verdict& v : verdicts) EXPECT_EQ(v.state, reports::State::pass) << v.case_id;
  const std::string html = reports::render_html(report_of(found, verdicts));
  EXPECT_NE(html.find("Wave speeds without time steps"), std::string::npos);
  EXPECT_EQ(html.find("Not drawn"), std::string::npos);
}

struct Mutation {
  std::string metric;
  std::function<void(StaticOutcome&)> apply;
};

TEST(StaticCampaign, AMillionthInASpeedFailsItsCriterionAlone) {
  constexpr double kWrong = 1.0 + 1e-6;
  const std::vector<Mutation> mutations = {
      {"shear velocity, static", [](StaticOutcome& s) { s.speeds.shear *= kWrong; }},
      {"P velocity, static", [](StaticOutcome& s) { s.speeds.p *= kWrong; }},
      {"shear velocity, Bloch limit", [](StaticOutcome& s) { s.bloch->shear *= kWrong; }},
      {"P velocity, Bloch limit", [](StaticOutcome& s) { s.bloch->p *= kWrong; }}};
  for (const Mutation& m : mutations) {
    for (const Model model : {Model::dem, Model::lagged_normal, Model::implicit_full}) {
      StripResults r = results();
      m.apply(lattice(r, model));
      EXPECT_EQ(failed(r),
                std::vector<std::string>{"static/hexagonal/" + material_slug(model, 0.3) + ": " + m.metric});
    }
  }
}

/// The bound is sharp: what the ends excuse, 7/6 of a disc in 7.3 mm (of 300 discs that fill some 0.85 of 7.3 mm x 2 mm, 0.23
/// mm: 3.7 %), and a tenth of it more or less.
TEST(StaticCampaign, TheKinematicBoundIsSharp) {
  const StripCampaign c = reduced();
  for (const auto& [share, passes] : {std::pair{0.9, true}, {1.1, false}}) {
    StripResults r = results();
    for (StaticOutcome& s : r.statics) {
      if (s.key != StripMaterial{StripPacking::random, 1, Model::dem, 0.3}) continue;
      const double area_of_a_disc = s.moduli.solid_fraction * c.length * c.width / s.moduli.discs;
      const double excused = 7.0 / 6.0 * std::sqrt(4.0 / std::numbers::pi * area_of_a_disc) / c.length;
      EXPECT_NEAR(excused, 0.037, 0.002);
      const IsotropicModuli m = s.moduli.isotropic().value();
      s.kinematic.bulk = m.bulk / (1.0 + share * excused);
      s.kinematic.shear = m.shear / (1.0 + share * excused);
    }
    const std::vector<std::string> names = failed(r);
    const auto bounds = std::count_if(names.begin(), names.end(), [](const std::string& n) { return n.ends_with("over its kinematic bound"); });
    EXPECT_EQ(bounds, passes ? 0 : 2) << share;
  }
}

/// A random packing stiffer than the bound, or sections that are not the packing's.
TEST(StaticCampaign, RandomPackingsThatCannotBeFail) {
  StripResults stiff = results(), elsewhere = results();
  for (StaticOutcome& s : stiff.statics) {
    if (s.key == StripMaterial{StripPacking::random, 2, Model::dem, 0.3}) *s.moduli.stiffness *= 1.5;
  }
  const std::string id = "static/random/" + material_slug(Model::dem, 0.3) + ": ";
  EXPECT_EQ(failed(stiff), (std::vector<std::string>{id + "highest bulk modulus over its kinematic bound",
                                                     id + "highest shear modulus over its kinematic bound"}));
  for (StaticOutcome& s : elsewhere.statics) {
    if (s.key.packing == StripPacking::random && s.key.model == Model::dem && s.key.stiffness_ratio == 0.3)
      s.sections.p *= 1.05;
  }
  EXPECT_EQ(failed(elsewhere),
            std::vector<std::string>{id + "P velocity between the sections over that of the whole packing"});
}

TEST(StaticCampaign, ErrorsAreAgainstTheClosedForm) {
  StripResults r = results();
  StaticOutcome& s = lattice(r, Model::dem);
  s.speeds.shear = 1.25 * s.kinematic_speeds.shear;
  s.bloch->shear = 0.5 * s.kinematic_speeds.shear;
  WaveOutcome& w = r.waves.emplace_back();
  w.c = {StripPacking::hexagonal, 0, Model::dem, 0.3, Protocol::long_wave, StripWave::shear};
  w.speed = 0.75 * s.kinematic_speeds.shear;
  const SpeedErrors errors = lattice_errors(r, s, StripWave::shear);
  EXPECT_NEAR(errors.statics.value(), 0.25, 1e-15);
  EXPECT_NEAR(errors.bloch.value(), -0.5, 1e-15);
  EXPECT_NEAR(errors.peak.value(), -0.25, 1e-15);
  EXPECT_FALSE(errors.centroid.has_value());
}

/// Without waves the table says so, and the figure shows two ways instead of four.
TEST(StaticCampaign, TheReportSaysWhatWasNotRun) {
  const reports::Table table = speed_error_table(results());
  ASSERT_EQ(table.rows.size(), 4u);  // rigid discs and implicit strains at two ratios
  std::size_t not_run = 0;
  for (const reports::Cell& c : table.rows.front()) {
    const auto* text = std::get_if<std::string>(&c.value);
    not_run += text != nullptr && *text == "not run";
  }
  EXPECT_EQ(not_run, 5u);  // peak and centroid of two waves, and the time of a pulse
  const reports::Figure figure = speed_error_figure(results());
  ASSERT_EQ(figure.panels.size(), 4u);
  for (const auto& panel : figure.panels) EXPECT_EQ(std::get<reports::Plot>(panel).series.size(), 2u);
}

}  // namespace
}  // namespace ddem::harness
