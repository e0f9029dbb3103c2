#include "harness/io/errors.h"
#include "harness/studies/discrimination/discrimination_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "harness/studies/finite_elements/finite_elements_run.h"
#include "harness/studies/finite_elements/finite_elements_verdicts.h"
#include "harness/studies/stability/stability_figures.h"
#include "harness/studies/statics/statics_verdicts.h"
#include "harness/studies/waves/waves_run.h"
#include "harness/studies/waves/waves_verdicts.h"

namespace ddem::harness {
namespace {

constexpr double kDiscriminationRatio = 0.3;
constexpr double kShares[] = {0.01, 0.05};

/// What is looked at for one wrong parameter.
struct Named {
  const char* parameter;
  const char* case_id;
  const char* metric;
};

struct SceneDefect {
  Named named;
  Model model;
  std::function<void(Scene&, double)> disturb;
};

std::vector<SceneDefect> scene_defects() {
  const auto k_n = [](Scene& s, double by) {
    std::get<NormalStiffness>(s.contact.value().stiffness).k_n *= by;
  };
  const auto k_t = [](Scene& s, double by) { s.contact.value().stiffness_ratio *= by; };
  const auto density = [](Scene& s, double by) { s.material.value().density *= by; };
  const auto e_p = [](Scene& s, double by) { s.deformation.value().young_modulus *= by; };
  const auto nu_p = [](Scene& s, double by) { s.deformation.value().poisson_ratio *= by; };
  return {{{"k_n", "static/hexagonal/dem/kt0.30", "Young's modulus"}, Model::dem, k_n},
          {{"k_t", "static/hexagonal/dem/kt0.30", "shear modulus"}, Model::dem, k_t},
          {{"density of the discs", "long-wave/hexagonal/dem/kt0.30", "shear velocity"}, Model::dem, density},
          {{"E_p", "static/hexagonal/lagged-full/kt0.30", "Young's modulus"}, Model::lagged_full, e_p},
          {{"nu_p", "static/hexagonal/lagged-full/kt0.30", "Poisson's ratio"}, Model::lagged_full, nu_p}};
}

struct ContinuumDefect {
  Named named;
  std::function<void(ContinuumMaterial&, double)> disturb;
};

std::vector<ContinuumDefect> continuum_defects() {
  return {{{"E of the continuum", "fem/shear/dem/kt0.30", "shear velocity"},
           [](ContinuumMaterial& m, double by) { m.young_modulus *= by; }},
          {{"nu of the continuum", "fem/p/dem/kt0.30", "P velocity"},
           [](ContinuumMaterial& m, double by) { m.poisson_ratio *= by; }},
          {{"density of the continuum", "fem/shear/dem/kt0.30", "shear velocity"},
           [](ContinuumMaterial& m, double by) { m.density *= by; }}};
}

/// One material and ratio, whose lattice alone is run.
StripCampaign narrowed(StripCampaign s, Model model) {
  s.models = {model};
  s.stiffness_ratios = {kDiscriminationRatio};
  return s;
}

double tolerances_off(const reports::Verdict& v, const Named& named) {
  for (const reports::Criterion& c : v.criteria) {
    if (v.case_id == named.case_id && c.metric == named.metric && std::isfinite(c.actual))
      return std::abs(c.actual - 0.5 * (c.lower + c.upper)) / (0.5 * (c.upper - c.lower));
  }
  throw std::runtime_error("not measured");
}

double off_with(const StripCampaign& campaign, const SceneDefect& defect, double by) {
  const StripCampaign s = narrowed(campaign, defect.model);
  const StripMaterial lattice{StripPacking::hexagonal, 0, defect.model, kDiscriminationRatio};
  CampaignOptions options;
  options.disturb_scene = [&](Scene& scene) { defect.disturb(scene, by); };
  StripStatics statics(s, options);
  if (std::string_view(defect.named.case_id).starts_with("static/")) return tolerances_off(static_verdict(statics.of(lattice)), defect.named);
  StripResults r;
  r.campaign = s;
  std::ranges::move(send_waves(s, lattice, Protocol::long_wave, statics, options).waves, std::back_inserter(r.waves));
  return tolerances_off(lattice_verdict(r, statics.of(lattice)), defect.named);
}

/// The step of the runs alone: growth over a step is predicted for another one.
double off_with_step(const StripCampaign& s, double by) {
  StabilityGrid grid;
  grid.softness = {0.1, 0.3};
  grid.step_fraction = {0.3, 0.6};
  grid.disturb = [by](SimulationInput& in) { in.time_step *= by; };
  const StabilityMap map =
      map_stability(s, grid, {StripPacking::hexagonal, Scheme::lagged, Correction::full, kDiscriminationRatio, 0.3});
  if (!map.failure.empty()) throw std::runtime_error(map.failure);
  for (const reports::Criterion& c : stability_map_verdict(map).criteria) {
    if (c.metric == "largest disagreement of growth") return c.actual / c.upper;
  }
  throw std::runtime_error("not measured");
}

void add(DiscriminationStudy& study, const Named& named, const std::function<double(double)>& off) {
  for (const double share : kShares) {
    Discrimination d{named.parameter, share, named.case_id, named.metric, "", 0.0};
    try {
      d.tolerances = off(1.0 + share);
    } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
      throw;
    } catch (const std::exception& e) {
      d.failure = e.what();
    }
    study.defects.push_back(d);
  }
}

/// All in one process of ddem-fem.
void add_continuum(const StripCampaign& campaign, DiscriminationStudy& study) {
  const StripCampaign s = narrowed(campaign, Model::dem);
  const std::vector<ContinuumDefect> defects = continuum_defects();
  std::vector<FemOutcome> outcomes;
  for (const ContinuumDefect& d : defects) {
    for (const double share : kShares) {
      study.defects.push_back({d.named.parameter, share, d.named.case_id, d.named.metric, "", 0.0});
      outcomes.emplace_back().key = {StripPacking::random, s.seeds.front(), Model::dem, kDiscriminationRatio};
      outcomes.back().wave =
          std::string(d.named.case_id).starts_with("fem/p/") ? StripWave::p : StripWave::shear;
    }
  }
  const std::size_t first = study.defects.size() - outcomes.size();
  std::string failure;
  try {
    StripStatics statics(s, {});
    outcomes = run_fem_outcomes(s, statics, outcomes, [&](std::size_t k, ContinuumMaterial& m) {
      defects[k / std::size(kShares)].disturb(m, 1.0 + kShares[k % std::size(kShares)]);
    });
  } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
    throw;
  } catch (const std::exception& e) {
    failure = e.what();
  }
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    Discrimination& d = study.defects[first + k];
    try {
      if (!failure.empty()) throw std::runtime_error(failure);
      d.tolerances = tolerances_off(fem_verdict({}, outcomes[k]), defects[k / std::size(kShares)].named);
    } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
      throw;
    } catch (const std::exception& e) {
      d.failure = e.what();
    }
  }
}

}  // namespace

DiscriminationStudy study_discrimination(const StripCampaign& s, bool with_fem) {
  DiscriminationStudy study;
  for (const SceneDefect& defect : scene_defects())
    add(study, defect.named, [&](double by) { return off_with(s, defect, by); });
  add(study,
      {"time step of the discs", "stability-map/hexagonal/lagged-full/kt0.30/nu0.30",
       "largest disagreement of growth"},
      [&](double by) { return off_with_step(s, by); });
  if (with_fem) add_continuum(s, study);
  return study;
}

reports::Table discrimination_table(const DiscriminationStudy& study) {
  reports::Table t;
  t.caption =
      "A parameter is made wrong in what the solver is given: how far the criterion that is there for it is "
      "then off, in its tolerances. Above 1 the case fails.";
  t.columns = {{"parameter"}, {"too large by", "%", 2},    {"case"},
               {"criterion"}, {"off by", "tolerances", 3}, {"found"}};
  for (const Discrimination& d : study.defects) {
    const bool found = d.failure.empty() && d.tolerances > 1.0;
    t.rows.push_back({d.parameter, 100.0 * d.share, d.case_id, d.metric, d.tolerances,
                      found               ? "yes"
                      : d.failure.empty() ? "no"
                                          : d.failure});
  }
  return t;
}

reports::Verdict discrimination_verdict(const DiscriminationStudy& study) {
  reports::Verdict v{.case_id = "discrimination",
                     .title = "Wrong parameters are found by the cases that are there for them",
                     .state = reports::State::pass};
  for (const Discrimination& d : study.defects) {
    reports::Criterion c{
        .metric = fmt::format("{} + {:g} %: {} of {}", d.parameter, 100.0 * d.share, d.metric, d.case_id),
        .lower = 1.0,
        .unit = "tolerances",
        .derivation = "off by more than its tolerance, or nobody would notice"};
    if (d.failure.empty()) {
      c.actual = d.tolerances;
      c.state = d.tolerances > 1.0 ? reports::State::pass : reports::State::fail;
    } else {
      v.reason += d.failure + ". ";
    }
    v.state = std::min(v.state, c.state);
    v.criteria.push_back(c);
  }
  if (v.criteria.empty()) v.state = reports::State::error;
  return v;
}

}  // namespace ddem::harness
