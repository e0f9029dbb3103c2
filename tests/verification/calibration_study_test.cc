// Calibration inside a campaign: the cases pass, each wrong parameter is found by the criterion that is there
// for it, and the commands that the report gives are those of the cases.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "harness/calibrate/calibrate.h"
#include "harness/studies/calibration/calibration_data.h"
#include "harness/studies/calibration/design.h"
#include "harness/run/scene_moduli.h"
#include "harness/scene/read_scene.h"

namespace ddem::harness {
namespace {

using reports::State;

/// One packing fitted, one other.
StripCampaign reduced() {
  StripCampaign s;
  s.seeds = {1, 2};
  return s;
}

const CalibrationCase kLattice = calibration_cases()[0], kOutOfReach = calibration_cases()[1],
                      kRigid = calibration_cases()[2], kSoft = calibration_cases()[3];

const reports::Criterion& criterion(const reports::Verdict& v, const std::string& metric) {
  const auto it =
      std::find_if(v.criteria.begin(), v.criteria.end(), [&](const auto& c) { return c.metric == metric; });
  if (it == v.criteria.end()) throw std::logic_error("no criterion " + metric);
  return *it;
}

reports::Verdict verdict(const StripCampaign& s, const CalibrationCase& c,
                         const std::function<void(Scene&)>& disturb = {}) {
  CampaignOptions options;
  options.disturb_scene = disturb;
  return calibration_verdict(study_calibration(s, c, options));
}

TEST(CalibrationStudy, PassesUndisturbed) {
  for (const CalibrationCase& c : calibration_cases()) {
    const reports::Verdict v = verdict({}, c);
    EXPECT_EQ(v.state, State::pass) << v.case_id;
    EXPECT_TRUE(v.reason.empty());
    EXPECT_GE(v.criteria.size(), 4u);
  }
}

/// What was fitted must come out within 2e-10: parameters wrong by 1e-6 move moduli by 1e-8 or more (k_t and
/// nu_p by their part in them, E_p likewise).
TEST(CalibrationStudy, WrongParametersAreFound) {
  constexpr double kWrong = 1.0 + 1e-6;
  const auto k_n = [](Scene& s) { std::get<NormalStiffness>(s.contact.value().stiffness).k_n *= kWrong; };
  const auto k_t = [](Scene& s) { s.contact.value().stiffness_ratio *= kWrong; };
  const auto e_p = [](Scene& s) { s.deformation.value().young_modulus *= kWrong; };
  const auto nu_p = [](Scene& s) { s.deformation.value().poisson_ratio *= kWrong; };
  struct Defect {
    const CalibrationCase& c;
    std::function<void(Scene&)> disturb;
    const char* fails;
  };
  for (const Defect& d : {Defect{kLattice, k_n, "Young's modulus, fitted packings"},
                          Defect{kLattice, k_t, "Poisson's ratio, fitted packings"},
                          Defect{kRigid, k_n, "Young's modulus, fitted packings"},
                          Defect{kRigid, k_t, "Poisson's ratio, fitted packings"},
                          Defect{kSoft, e_p, "Young's modulus, fitted packings"},
                          Defect{kSoft, nu_p, "Poisson's ratio, fitted packings"}}) {
    const reports::Verdict v = verdict(reduced(), d.c, d.disturb);
    EXPECT_EQ(v.state, State::fail) << v.case_id;
    EXPECT_EQ(criterion(v, d.fails).state, State::fail) << v.case_id << " " << d.fails;
  }
}

/// Packings that were not fitted are seen, too: 10 % is beyond three standard deviations of single packings
/// (3 sqrt(2) 1 %).
TEST(CalibrationStudy, OtherPackingsAreJudged) {
  const reports::Verdict v = verdict(
      reduced(), kRigid, [](Scene& s) { std::get<NormalStiffness>(s.contact.value().stiffness).k_n *= 1.1; });
  EXPECT_EQ(criterion(v, "Young's modulus, other packings").state, State::fail);
  EXPECT_EQ(criterion(v, "Poisson's ratio, other packings").state, State::pass);
}

TEST(CalibrationStudy, WrongAnswersFail) {
  const StripCampaign s = reduced();
  const CalibrationOutcome found = study_calibration(s, kLattice, {}),
                           refused = study_calibration(s, kOutOfReach, {});
  const auto state = [&](CalibrationOutcome o, const std::function<void(CalibrationOutcome&)>& spoil) {
    spoil(o);
    return calibration_verdict(o).state;
  };
  EXPECT_EQ(state(found, [](auto&) {}), State::pass);
  EXPECT_EQ(state(found, [](auto& o) { o.feasible = false; }), State::fail);
  EXPECT_EQ(state(found, [](auto& o) { o.stiffness_ratio += 1e-9; }), State::fail);
  EXPECT_EQ(state(found, [](auto& o) { o.normal_stiffness *= 1.0 + 1e-9; }), State::fail);
  EXPECT_EQ(state(found, [](auto& o) { o.failure = "no packing"; }), State::error);
  EXPECT_EQ(state(refused, [](auto&) {}), State::pass);
  EXPECT_EQ(state(refused, [](auto& o) { o.feasible = true; }), State::fail);
  EXPECT_EQ(state(refused, [](auto& o) { o.highest_rigid += 1e-9; }), State::fail);
  EXPECT_EQ(state(refused, [](auto& o) { o.highest_implicit.reset(); }), State::error);
}

Scene shipped(const std::string& name) {
  const SceneResult scene = read_scene(std::filesystem::path(DDEM_SCENES) / name, {Purpose::packing});
  EXPECT_TRUE(scene) << to_string(scene.violations);
  return *scene;
}

/// `ddem calibrate` with a shipped scene finds what the case finds: their assemblies are the same.
TEST(CalibrationStudy, ShippedScenesAreTheCases) {
  const StripCampaign s;
  const StripCase strip{StripPacking::random, 1,           Model::implicit_full, 0.2,
                        Protocol::long_wave,  StripWave::p};
  const Scene own = scene_of(assembly_text(s, strip, false), "own"), soft = shipped("calibrate_ddem.toml");
  const auto &a = std::get<RandomPacking>(own.assembly.packing),
             &b = std::get<RandomPacking>(soft.assembly.packing);
  EXPECT_EQ(std::tie(a.length, a.width, a.discs, a.seed, a.radius_ratio, a.walls),
            std::tie(b.length, b.width, b.discs, b.seed, b.radius_ratio, b.walls));
  EXPECT_EQ(std::get<BondCoordination>(own.assembly.bonding).bonds_per_disc,
            std::get<BondCoordination>(soft.assembly.bonding).bonds_per_disc);
  EXPECT_TRUE(soft.assembly.periodic.y && !soft.assembly.periodic.x);
  EXPECT_EQ(soft.deformation->scheme, own.deformation->scheme);
  EXPECT_EQ(soft.deformation->correction, own.deformation->correction);
  EXPECT_EQ(soft.deformation->plane, own.deformation->plane);

  const Scene lattice = shipped("calibrate_lattice.toml");
  EXPECT_TRUE(lattice.assembly.periodic.x && lattice.assembly.periodic.y && !lattice.deformation);
  EXPECT_TRUE(std::holds_alternative<HexagonalPacking>(lattice.assembly.packing));
}

/// Moduli scale with k_n and depend on E_p by k_n/E_p alone: the scene's moduli at its own stiffness, over that.
TEST(DesignStudy, IsThatOfAnyStiffness) {
  const StripCampaign s;
  const DesignStudy study = study_design(s);
  const StripCase c{StripPacking::random, s.seeds.front(), Model::implicit_full, study.stiffness_ratio, Protocol::long_wave, StripWave::p};
  Scene scene = scene_of(assembly_text(s, c, false), "design");
  for (const SoftnessCurve& curve : study.curves) {
    scene.deformation->poisson_ratio = curve.particle_poisson_ratio;
    for (const std::size_t k : {std::size_t{0}, study.softness.size() - 1}) {
      scene.deformation->young_modulus = s.normal_stiffness / study.softness[k];
      const IsotropicModuli m = scene_moduli(scene).isotropic().value();
      EXPECT_NEAR(curve.random[k].young_over_stiffness * s.normal_stiffness / m.young(), 1.0, 1e-9);
      EXPECT_NEAR(curve.random[k].poisson_ratio, m.poisson(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace ddem::harness
