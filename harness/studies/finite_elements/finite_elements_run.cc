#include "harness/studies/finite_elements/finite_elements_run.h"

#include "harness/studies/waves/waves_run.h"
#include "harness/run/fem_plan.h"

namespace ddem::harness {
namespace {

FemPlan plan_outcome(const StripCampaign& s, const FemOutcome& f, StripStatics& shared,
                     const StaticOutcome& statics) {
  const StripCase c = case_of(f.key, f.wave);
  Scene scene = scene_of(scene_text(s, c, statics.speeds.of(f.wave)), id_of(c));
  scene.continuum = Continuum{};
  scene.continuum->degree = s.fem_degree;
  scene.continuum->elements = s.fem_elements;
  FemPlan plan =
      plan_fem(scene, statics.moduli, &shared.strip(f.key.packing, f.key.seed, f.wave != StripWave::bar));
  if (f.uniaxial) plan.fem.material.poisson_ratio = 0.0;
  return plan;
}

void take_result(FemOutcome& f, const FemPlan& plan, const FemResult& result) {
  f.dofs = result.dofs;
  f.steps = result.steps;
  f.solve_seconds = result.solve_seconds;
  if (result.status != "ok") {
    f.failure = result.status;
    return;
  }
  const Wave wave = f.wave == StripWave::shear ? Wave::shear : Wave::longitudinal;
  const auto& signals = receiver_signals(plan, result, wave);
  const auto measurement = measure_fem(plan, result, wave);
  std::optional<double> unused;
  take_speed(measurement, f.speed, unused, f.failure);
  f.recording = thinned(record(signals, result.sample_interval, plan.layout, plan.context, measurement));
}

}  // namespace

std::vector<FemOutcome> fem_outcomes(const StripCampaign& s) {
  std::vector<FemOutcome> out;
  for (const Model model : s.models) {
    if (continuum_model(s, model) != model) continue;
    for (const double ratio : s.stiffness_ratios) {
      for (const StripWave wave : {StripWave::bar, StripWave::shear, StripWave::p}) {
        FemOutcome f;
        f.key = {StripPacking::random, s.seeds.front(), model, ratio};
        f.wave = wave;
        out.push_back(f);
      }
    }
  }
  FemOutcome uniaxial;
  uniaxial.key = {StripPacking::random, s.seeds.front(), s.models.front(), s.stiffness_ratios.front()};
  uniaxial.wave = StripWave::bar;
  uniaxial.uniaxial = true;
  out.push_back(uniaxial);
  return out;
}

std::vector<FemOutcome> run_strip_fem(const StripCampaign& s, StripStatics& shared,
                                      const CampaignOptions& options) {
  const auto disturb = [&](std::size_t, ContinuumMaterial& m) {
    if (options.disturb_continuum) options.disturb_continuum(m);
  };
  return run_fem_outcomes(s, shared, fem_outcomes(s), disturb, [&] {
    if (options.on_progress) options.on_progress(kWorkOfFemCase);
  });
}

std::vector<FemOutcome> run_fem_outcomes(const StripCampaign& s, StripStatics& shared,
                                         std::vector<FemOutcome> outcomes,
                                         const std::function<void(std::size_t, ContinuumMaterial&)>& disturb,
                                         const std::function<void()>& on_case) {
  std::vector<FemPlan> plans;
  std::vector<FemCase> cases;
  std::vector<FemOutcome*> planned;
  for (FemOutcome& f : outcomes) {
    const StaticOutcome statics = shared.of(f.key);
    if (!statics.failure.empty()) {
      f.failure = "no static reference: " + statics.failure;
      continue;
    }
    try {
      plans.push_back(plan_outcome(s, f, shared, statics));
      disturb(static_cast<std::size_t>(&f - outcomes.data()), plans.back().fem.material);
    } catch (const std::exception& e) {
      f.failure = e.what();
      continue;
    }
    f.analytical_speed = statics.speeds.of(f.wave);
    plans.back().fem.id = std::to_string(cases.size());
    cases.push_back(plans.back().fem);
    planned.push_back(&f);
  }
  const auto results = run_fem(cases, on_case);
  for (std::size_t n = 0; n < results.size(); ++n) take_result(*planned[n], plans[n], results[n]);
  return outcomes;
}

}  // namespace ddem::harness
