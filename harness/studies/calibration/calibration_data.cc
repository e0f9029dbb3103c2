#include "harness/studies/calibration/calibration_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem/core/narrow.h"
#include "harness/calibrate/calibrate.h"
#include "harness/studies/strip/criteria.h"
#include "harness/references/effective_moduli.h"
#include "harness/run/scene_moduli.h"
#include "reports/number.h"

namespace ddem::harness {
namespace {

constexpr double kYoung = 30e9, kDensity = 2400.0;  // Pa, kg/m3: of a mortar
constexpr std::int64_t kCellDiscs = 4;              // a row: any cell of the lattice has the same moduli

StripCase strip_case(const StripCampaign& s, const CalibrationCase& c) {
  return {c.packing,           s.seeds.front(), c.model, c.stiffness_ratio.value_or(0.0),
          Protocol::long_wave, StripWave::p};
}

/// The lattice's cell, or the random strip between periodic edges.
std::string text_of(StripCampaign s, const CalibrationCase& c) {
  s.columns = s.rows = kCellDiscs;
  return assembly_text(s, strip_case(s, c), c.packing == StripPacking::hexagonal);
}

Target target_of(const CalibrationCase& c) {
  WantedValues wanted;
  wanted.of(TargetKind::young) = Uncertain{kYoung, 0.0};
  wanted.of(TargetKind::poisson) = Uncertain{c.poisson_ratio, 0.0};
  wanted.density = kDensity;
  return make_target(wanted);
}

struct Shares {
  std::int64_t fitted = 1, unseen = 1;  ///< packings
};
Shares shares_of(const StripCampaign& s) {
  const auto seeds = static_cast<std::int64_t>(s.seeds.size());
  const std::int64_t fitted = std::max<std::int64_t>(1, seeds / 2);
  return {fitted, std::max<std::int64_t>(1, seeds - fitted)};
}

std::vector<CalibratedPacking> measured(const Scene& scene, std::int64_t first, std::int64_t count) {
  std::vector<CalibratedPacking> out;
  for (std::int64_t seed = first; seed < first + count; ++seed) {
    const IsotropicModuli m = scene_moduli(with_seed(scene, seed)).isotropic().value();
    out.push_back({seed, m.young(), m.poisson()});
  }
  return out;
}

double mean_young(const std::vector<CalibratedPacking>& packings) {
  std::vector<double> values;
  for (const CalibratedPacking& p : packings) values.push_back(p.young_modulus);
  return mean_with_confidence(values).mean;
}

double mean_poisson(const std::vector<CalibratedPacking>& packings) {
  std::vector<double> values;
  for (const CalibratedPacking& p : packings) values.push_back(p.poisson_ratio);
  return mean_with_confidence(values).mean;
}

std::optional<double> highest(const Calibration& found, const std::string& variant) {
  const auto it = std::find_if(found.ranges.begin(), found.ranges.end(),
                               [&](const VariantRange& v) { return v.name == variant; });
  return it == found.ranges.end() ? std::nullopt : std::optional(it->poisson.highest);
}

/// E/k_n and nu of the lattice of rigid discs, and of soft ones at the corner of what is searched.
references::PlaneConstants lattice(double stiffness_ratio) {
  return references::plane_constants(references::effective_moduli(references::ContactModel::dem,
                                                                  references::hexagonal_fabric(),
                                                                  {1.0, stiffness_ratio}, {{1.0, 0.0}, 1.0}));
}
references::PlaneConstants softest_lattice() {
  const SearchSpace space;
  return references::plane_constants(references::effective_moduli(
      references::ContactModel::ddem_full, references::hexagonal_fabric(), {1.0, 0.0},
      {{1.0 / space.softness.high, space.particle_poisson_ratio.high}, 1.0}));
}

/// Standard deviation of one packing's moduli about those of many (twelve were measured: 0.94 % and 0.0018
/// rigid, 0.43 % and 0.0003 soft).
struct Scatter {
  double young, poisson;
};
Scatter scatter_of(Model model) {
  return model == Model::dem ? Scatter{0.010, 0.002} : Scatter{0.005, 0.0004};
}

void judge_lattice(const CalibrationOutcome& o, reports::Verdict& v) {
  const double ratio = (1.0 - 3.0 * o.target_poisson) / (1.0 + o.target_poisson);
  v.criteria.push_back(judge("k_t/k_n", o.stiffness_ratio, absolute(ratio, 1e-10), "",
                             "closed form, (1 - 3 nu)/(1 + nu); the search ends at 1e-11 of nu, and k_t/k_n "
                             "is 2.6 times as uncertain"));
  v.criteria.push_back(judge(
      "k_n", o.normal_stiffness, relative(o.target_young / lattice(ratio).young_modulus, 1e-10, 1e-10), "N/m",
      "closed form, E over 4KG/(K + G) at unit stiffness; half of the relative error of k_t/k_n"));
}

void judge_fitted(const CalibrationOutcome& o, reports::Verdict& v) {
  const char* derivation =
      "target; moduli measured anew by the scene with the contacts found, as ddem moduli does: the search "
      "ends at 1e-11 of nu, sparse solves reach 1e-10";
  v.criteria.push_back(judge("Young's modulus, fitted packings", mean_young(o.fitted),
                             relative(o.target_young, 2e-10, 2e-10), "Pa", derivation));
  v.criteria.push_back(judge("Poisson's ratio, fitted packings", mean_poisson(o.fitted),
                             absolute(o.target_poisson, 2e-10), "", derivation));
}

void judge_unseen(const CalibrationOutcome& o, Model model, reports::Verdict& v) {
  const Scatter one = scatter_of(model);
  const double three = 3.0 * std::sqrt(1.0 / static_cast<double>(o.fitted.size()) +
                                       1.0 / static_cast<double>(o.unseen.size()));
  const std::string derivation = fmt::format(
      "target; packings scatter by {:g} % and {:g}: three standard deviations of the difference of two "
      "means, of {} fitted and {} others",
      100.0 * one.young, one.poisson, o.fitted.size(), o.unseen.size());
  v.criteria.push_back(judge("Young's modulus, other packings", mean_young(o.unseen),
                             relative(o.target_young, three * one.young, three * one.young), "Pa",
                             derivation));
  v.criteria.push_back(judge("Poisson's ratio, other packings", mean_poisson(o.unseen),
                             absolute(o.target_poisson, three * one.poisson), "", derivation));
}

/// Rigid discs in the lattice: nu is at most 1/3.
void judge_refusal(const CalibrationOutcome& o, reports::Verdict& v) {
  const char* rigid = "closed form, k_t = 0: (1 - 0)/(3 + 0)";
  v.criteria.push_back(judge("nearest Poisson's ratio", mean_poisson(o.fitted),
                             absolute(lattice(0.0).poisson_ratio, 2e-10), "", rigid));
  v.criteria.push_back(judge("highest within reach, rigid discs", o.highest_rigid,
                             absolute(lattice(0.0).poisson_ratio, 2e-10), "", rigid));
  v.criteria.push_back(judge("highest within reach, implicit strains", o.highest_implicit,
                             absolute(softest_lattice().poisson_ratio, 1e-9), "",
                             "closed form of F with k_t = 0 and the softest discs that are searched; sparse "
                             "solves reach 1e-10, with soft discs a digit less"));
}

bool is_within_reach(const CalibrationCase& c) {
  return c.packing == StripPacking::random || c.poisson_ratio <= lattice(0.0).poisson_ratio;
}

}  // namespace

std::vector<CalibrationCase> calibration_cases() {
  return {{StripPacking::hexagonal, Model::dem, 0.25, {}},
          {StripPacking::hexagonal, Model::dem, 0.40, {}},
          {StripPacking::random, Model::dem, 0.25, {}},
          {StripPacking::random, Model::implicit_full, 0.42, 0.2}};
}

std::string id_of(const CalibrationCase& c) {
  return fmt::format("calibration/{}/{}/nu{:.2f}",
                     c.packing == StripPacking::hexagonal ? "hexagonal" : "random",
                     c.model == Model::dem ? "dem" : "implicit-full", c.poisson_ratio);
}

CalibrationOutcome study_calibration(const StripCampaign& s, const CalibrationCase& c,
                                     const CampaignOptions& options) {
  const Scene scene = scene_of(text_of(s, c), id_of(c));
  const Shares shares = shares_of(s);
  CalibrationOptions calibration;
  calibration.seeds = narrow<int>(shares.fitted, "seeds");
  calibration.other_variants = !is_within_reach(c);
  if (c.stiffness_ratio) calibration.space.stiffness_ratio = {*c.stiffness_ratio, *c.stiffness_ratio};
  const Calibration found = calibrate(scene, target_of(c), calibration);
  CalibrationOutcome out;
  out.id = id_of(c);
  out.target_young = found.target.young_modulus;
  out.target_poisson = found.target.poisson_ratio;
  out.feasible = found.feasible;
  out.stiffness_ratio = found.found.point.stiffness_ratio;
  out.normal_stiffness = found.found.stiffness;
  if (scene.deformation) {
    out.softness = found.found.point.softness;
    out.particle_poisson_ratio = found.found.point.particle_poisson_ratio;
  }
  out.highest_rigid = highest(found, "DEM").value();
  if (!found.feasible) out.highest_implicit = highest(found, "implicit F");
  Scene calibrated = calibrated_scene(scene, found.found);
  if (options.disturb_scene) options.disturb_scene(calibrated);
  const bool random = c.packing == StripPacking::random;
  out.fitted = measured(calibrated, s.seeds.front(), random ? shares.fitted : 1);
  if (random) out.unseen = measured(calibrated, s.seeds.front() + shares.fitted, shares.unseen);
  return out;
}

reports::Verdict calibration_verdict(const CalibrationOutcome& o) {
  const auto cases = calibration_cases();
  const CalibrationCase& c =
      *std::find_if(cases.begin(), cases.end(), [&](const CalibrationCase& k) { return id_of(k) == o.id; });
  const bool random = c.packing == StripPacking::random, within = is_within_reach(c);
  reports::Verdict v{
      .case_id = o.id,
      .title = fmt::format("Calibration, {}, {}, nu = {:g}{}", random ? "random packings" : "the lattice",
                           name(c.model), c.poisson_ratio, within ? "" : ", which is out of reach"),
      .reason = o.failure};
  if (o.failure.empty()) {
    const double expected = within ? 1.0 : 0.0;
    v.criteria.push_back(
        judge("target reached (1: yes, 0: refused)", o.feasible ? 1.0 : 0.0, {expected, expected, expected},
              "", within ? "these discs reach it" : "rigid discs in the lattice have nu of 1/3 at most"));
    if (!random && within) judge_lattice(o, v);
    within ? judge_fitted(o, v) : judge_refusal(o, v);
    if (random) judge_unseen(o, c.model, v);
  }
  conclude_study(v);
  return v;
}

reports::Table calibration_table(const std::vector<CalibrationOutcome>& outcomes) {
  reports::Table t;
  t.caption =
      "Target E = 30 GPa and ν; what was found; static moduli of the packings with these contacts, less the "
      "target. Out of reach: the nearest.";
  t.columns = {{"case"},
               {"ν wanted", "", 2},
               {"found"},
               {"kₜ/kₙ", "", 4},
               {"kₙ", "N/m", 9},
               {"kₙ/Eₚ", "", 3},
               {"νₚ", "", 2},
               {"E, fitted", "%", 2},
               {"ν, fitted", "", 2},
               {"E, others", "%", 2},
               {"ν, others", "", 2}};
  for (const CalibrationOutcome& o : outcomes) {
    if (!o.failure.empty()) continue;
    const bool soft = o.softness > 0.0;
    std::vector<reports::Cell> row = {o.id.substr(o.id.find('/') + 1),
                                      o.target_poisson,
                                      o.feasible ? "yes" : "out of reach",
                                      o.stiffness_ratio,
                                      o.normal_stiffness,
                                      soft ? o.softness : reports::kNone,
                                      soft ? o.particle_poisson_ratio : reports::kNone};
    for (const auto* packings : {&o.fitted, &o.unseen}) {
      row.push_back(packings->empty() ? reports::kNone : 100.0 * (mean_young(*packings) / o.target_young - 1.0));
      row.push_back(packings->empty() ? reports::kNone : mean_poisson(*packings) - o.target_poisson);
    }
    t.rows.push_back(row);
  }
  return t;
}

}  // namespace ddem::harness
