#include "harness/campaign/run_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "dem/spectra/spectra.h"
#include "harness/bench/bench.h"
#include "harness/campaign/worker_pool.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/run/bar_reference.h"
#include "harness/run/dem_run.h"
#include "harness/run/fem_plan.h"
#include "harness/run/section_speeds.h"

namespace ddem::harness {
namespace {

std::vector<StripMaterial> materials_of(const StripCampaign& s) {
  std::vector<StripMaterial> keys;
  for (const Model model : s.models) {
    for (const double ratio : s.stiffness_ratios) {
      keys.push_back({StripPacking::hexagonal, 0, model, ratio});
      for (const std::int64_t seed : s.seeds) keys.push_back({StripPacking::random, seed, model, ratio});
    }
  }
  return keys;
}

StripCase case_of(const StripMaterial& m, StripWave wave, Protocol protocol = Protocol::long_wave) {
  return {m.packing, m.seed, m.model, m.stiffness_ratio, protocol, wave};
}

/// Figures show the first random packing.
bool keeps_recording(const StripCampaign& s, const StripCase& c) {
  return c.packing == StripPacking::random && c.seed == s.seeds.front();
}

/// P and shear waves share their strip.
Speeds static_section_speeds(const StripCampaign& s, const StripMaterial& key, const ddem::Assembly& closed) {
  const auto between = [&](StripWave wave, const ddem::Assembly* assembly) {
    const Scene scene = scene_of(scene_text(s, case_of(key, wave), 1.0), "sections");
    const ddem::Assembly& a = assembly != nullptr ? *assembly : build_assembly(scene);
    return section_speeds(scene, a, lay_probes(scene, a));
  };
  const auto free = between(StripWave::bar, nullptr), periodic = between(StripWave::p, &closed);
  return {free.bar, periodic.s, periodic.p};
}

StaticOutcome solve_statics(const StripCampaign& s, const StripMaterial& key, const CampaignOptions& options) {
  StaticOutcome out;
  out.key = key;
  try {
    const Scene scene = scene_of(assembly_text(s, case_of(key, StripWave::bar), false), "statics");
    out.moduli = scene_moduli(scene);
    const DirectionalSpeeds speeds = out.moduli.speeds().value();
    out.speeds = {speeds.bar, speeds.s, speeds.p};
    const ddem::Assembly closed = build_laterally_closed(scene).value();
    out.critical_time_step = 2.0 / largest_frequency(closed, contact_parameters(scene), {});
    // A lattice's cell has all its bonds; a strip's ends have not.
    if (key.packing == StripPacking::hexagonal) {
      StripCampaign small = s;
      small.columns = small.rows = 8;
      Scene cell = scene_of(assembly_text(small, case_of(key, StripWave::p), true), "cell");
      out.kinematic = kinematic_moduli(cell, build_assembly(cell));
      if (options.disturb_scene) options.disturb_scene(cell);
      out.cell = scene_moduli(cell).isotropic();
    } else {
      out.kinematic = kinematic_moduli(scene, closed);
      out.sections = static_section_speeds(s, key, closed);
    }
    const auto k = references::bulk_wave_speeds(out.kinematic, out.moduli.bulk_density);
    out.kinematic_speeds = {k.bar, k.shear, k.p};
  } catch (const std::exception& e) {
    out.failure = e.what();
  }
  return out;
}

Recording record(const std::vector<std::vector<double>>& signals, double dt, const ProbeLayout& layout, const WaveContext& context,
                 const std::optional<WaveMeasurement>& measurement) {
  Recording r;
  r.sample_interval = dt;
  for (std::size_t p = 0; p < layout.probes.size(); ++p) {
    const double x = layout.probes[p].x;
    PickedSignal s{layout.probes[p].name, x - context.left_end, signals[p], causal_window(context, x).end, {}, {}, ""};
    if (measurement && measurement->picks[p].pick.ok()) {
      s.pick_time = measurement->picks[p].pick.value().time;
      s.pick_amplitude = measurement->picks[p].pick.value().amplitude;
    } else if (measurement) {
      s.pick_failure = measurement->picks[p].pick.error().reason;
    }
    r.signals.push_back(std::move(s));
  }
  return r;
}

void take_speed(const WaveMeasurement& m, std::optional<double>& speed, std::optional<double>& stddev, std::string& failure) {
  if (m.speed.speed.ok()) {
    speed = m.speed.speed.value().mean;
    stddev = m.speed.speed.value().stddev;
  } else {
    failure = m.speed.speed.error().reason;
  }
}

void take_driven_speeds(const DemRun& run, const StaticOutcome& statics, WaveOutcome& out) {
  const PickedSpeeds picked = picked_speeds(*run.measurement);
  out.centroid_speed = picked.centroid;
  out.correlation_speed = picked.correlation;
  out.section_speed = statics.sections.of(out.c.wave);
  if (out.c.wave != StripWave::bar) return;
  const references::FreeStrip strip{out.static_speed, run.assembly.packing.width, statics.moduli.strip.value().lateral_contraction};
  out.s0 = picked_speeds(s0_measurement(strip, run.layout, run.context));
}

WaveOutcome simulate_case(const StripCampaign& s, const StripCase& c, const StaticOutcome& statics,
                          const CampaignOptions& options, StripPicture* picture) {
  WaveOutcome out;
  out.c = c;
  out.static_speed = statics.speeds.of(c.wave);
  out.kinematic_speed = statics.kinematic_speeds.of(c.wave);
  if (!statics.failure.empty()) {
    out.failure = "no static reference: " + statics.failure;
    return out;
  }
  out.scene = scene_text(s, c, out.static_speed);
  try {
    Scene scene = scene_of(out.scene, id_of(c));
    if (options.disturb_scene) options.disturb_scene(scene);
    RunOptions run_options;
    run_options.expected_speed = out.static_speed;
    run_options.warn = false;
    if (!options.disturb_scene) run_options.critical_time_step = statics.critical_time_step;
    run_options.snapshots = picture != nullptr ? 2 : 0;  // half-way, where the wave is under way, and at the end
    const DemRun run = run_scene(scene, run_options);
    out.time_step = run.time_step;
    out.critical_time_step = run.critical_time_step;
    out.steps = run.result.steps_done;
    out.energy_drift = run.result.energy_drift;
    if (run.result.breakdown) {
      out.diverged = true;
      out.diverged_step = run.result.breakdown->step;
      out.diverged_disc = run.result.breakdown->disc;
      out.failure = fmt::format("diverged at step {}, disc {}", out.diverged_step, out.diverged_disc);
      return out;
    }
    take_speed(*run.measurement, out.speed, out.speed_stddev, out.failure);
    out.good_pairs = static_cast<int>(run.measurement->speed.good_pairs);
    if (c.protocol == Protocol::long_wave) take_driven_speeds(run, statics, out);
    if (keeps_recording(s, c)) {
      out.recording = record(wave_component(run.result.signals, *run.wave), run.time_step, run.layout, run.context,
                             run.measurement);
    }
    if (picture != nullptr) {
      picture->packing = run.assembly.packing;
      picture->time = run.result.snapshots.front().time;
      picture->displacement = run.result.snapshots.front().state.ux;
    }
  } catch (const std::exception& e) {
    out.failure = e.what();
  }
  return out;
}

// The noise run: half the critical step, where the growth of N is fastest, on a patch small enough to be quick.
constexpr double kNoiseStepFraction = 0.5;
constexpr long kNoiseSteps = 20000;
constexpr long kImplicitNoiseSteps = 4000;  // several passes a step, and an invariant that would show growth at once
constexpr std::int64_t kNoiseColumns = 20, kNoiseRows = 20;

/// Noise that is the same everywhere: no library's random numbers, whose distributions differ.
std::vector<double> noise(std::size_t n, std::uint64_t state) {
  std::vector<double> values(n);
  for (double& v : values) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    v = 1e-9 * (static_cast<double>(state >> 11) * 0x1.0p-52 - 1.0);
  }
  return values;
}

StabilityOutcome release_noise(const StripCampaign& s, const StripMaterial& key, const CampaignOptions& options) {
  StabilityOutcome out;
  out.key = key;
  out.expected_unstable = expected_unstable(s, key);
  out.steps = key.model == Model::implicit_full ? kImplicitNoiseSteps : kNoiseSteps;
  try {
    StripCampaign small = s;
    small.columns = kNoiseColumns;
    small.rows = kNoiseRows;
    Scene scene = scene_of(assembly_text(small, case_of(key, StripWave::p), true), "noise");
    if (options.disturb_scene) options.disturb_scene(scene);
    const ddem::Assembly assembly = build_assembly(scene);
    SimulationInput in;
    in.contact = contact_parameters(scene);
    in.deformation = deformation_parameters(scene);
    in.initial.ux = noise(assembly.size(), 1);
    in.initial.uy = noise(assembly.size(), 2);
    in.time_step = kNoiseStepFraction * 2.0 / largest_frequency(assembly, in.contact, {});
    in.steps = out.steps;
    const SimulationResult result = simulate(assembly, in);
    if (result.breakdown) out.diverged_step = result.breakdown->step;
  } catch (const std::exception& e) {
    out.failure = e.what();
  }
  return out;
}

std::vector<StripMaterial> lattices_with_strain(const StripCampaign& s) {
  std::vector<StripMaterial> keys;
  for (const StripMaterial& key : materials_of(s)) {
    if (key.packing == StripPacking::hexagonal && key.model != Model::dem) keys.push_back(key);
  }
  return keys;
}

/// The continuum with the static moduli of the first random strip, all models and ratios, and one bar with nu = 0.
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

FemPlan plan_outcome(const StripCampaign& s, const FemOutcome& f, const StaticOutcome& statics, const CampaignOptions& options) {
  const StripCase c = case_of(f.key, f.wave);
  Scene scene = scene_of(scene_text(s, c, statics.speeds.of(f.wave)), id_of(c));
  scene.continuum = Continuum{};
  scene.continuum->degree = s.fem_degree;
  scene.continuum->elements = s.fem_elements;
  FemPlan plan = plan_fem(scene, statics.moduli);
  if (f.uniaxial) plan.fem.material.poisson_ratio = 0.0;
  if (options.disturb_continuum) options.disturb_continuum(plan.fem.material);
  return plan;
}

void run_all_fem(const StripCampaign& s, CampaignResults& results, const CampaignOptions& options) {
  std::vector<FemPlan> plans;
  std::vector<FemCase> cases;
  std::vector<std::size_t> planned;
  for (std::size_t k = 0; k < results.fem.size(); ++k) {
    FemOutcome& f = results.fem[k];
    const StaticOutcome* statics = results.find(f.key);
    if (statics == nullptr || !statics->failure.empty()) {
      f.failure = "no static reference";
      continue;
    }
    try {
      plans.push_back(plan_outcome(s, f, *statics, options));
    } catch (const std::exception& e) {
      f.failure = e.what();
      continue;
    }
    f.analytical_speed = statics->speeds.of(f.wave);
    plans.back().fem.id = std::to_string(k);
    cases.push_back(plans.back().fem);
    planned.push_back(k);
  }
  try {
    const auto fem = run_fem(cases, [&] { if (options.on_progress) options.on_progress(1); });
    for (std::size_t n = 0; n < fem.size(); ++n) {
      FemOutcome& f = results.fem[planned[n]];
      f.dofs = fem[n].dofs;
      f.steps = fem[n].steps;
      f.solve_seconds = fem[n].solve_seconds;
      if (fem[n].status != "ok") {
        f.failure = fem[n].status;
        continue;
      }
      const auto& signals = receiver_signals(plans[n], fem[n], f.wave == StripWave::shear ? Wave::shear : Wave::longitudinal);
      const auto measurement = measure_wave(signals, fem[n].sample_interval, plans[n].layout, plans[n].context);
      std::optional<double> unused;
      take_speed(measurement, f.speed, unused, f.failure);
      f.recording = record(signals, fem[n].sample_interval, plans[n].layout, plans[n].context, measurement);
    }
  } catch (const std::exception& e) {
    results.fem_failure = e.what();
  }
}

void place_probes(const StripCampaign& s, StripPicture& picture) {
  StripCase c{StripPacking::random, s.seeds.front(), Model::dem, s.stiffness_ratios.front(), Protocol::paper, StripWave::bar};
  const Scene scene = scene_of(scene_text(s, c, 1.0), "picture");
  const ProbeLayout layout = lay_probes(scene, build_assembly(scene));
  for (std::size_t p = 0; p < layout.probes.size(); ++p) {
    picture.probe_x.push_back(layout.probes[p].x);
    picture.probe_y.push_back(layout.probes[p].y);
    picture.probe_labels.push_back(fmt::format("{}{}", static_cast<char>('A' + static_cast<int>(p / 2) % 26), p % 2 + 1));
  }
}

/// Those that are one job together.
void run_studies(const StripCampaign& s, CampaignResults& results, const CampaignOptions& options, const std::function<void(std::size_t)>& progress) {
  results.schemes = study_schemes(s, [&] { progress(1); });
  results.range = study_range(s);
  results.film = film_strip(s);
  results.work_precision = bench::measure_briefly();
  progress(1);
  results.dispersion = study_dispersion(s, options.with_fem);
  progress(1);
}

}  // namespace

std::size_t campaign_work(const StripCampaign& s, const CampaignOptions& options) {
  const std::size_t studies = kSchemeStudyWork + 2 + stability_grid(s.full_stability).maps.size() + plan_sizes(s).strips.size();
  return 4 * materials_of(s).size() + cases_of(s).size() + 4 * lattices_with_strain(s).size() + (options.with_studies ? studies : 0) +
         (options.with_fem ? fem_outcomes(s).size() : 0);
}

CampaignResults run_campaign(const StripCampaign& s, const CampaignOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const auto progress = [&](std::size_t done) {
    if (options.on_progress) options.on_progress(done);
  };
  CampaignResults results;
  results.campaign = s;
  const auto keys = materials_of(s);
  for (const StripMaterial& key : keys) results.statics.emplace_back().key = key;
  run_jobs(keys.size(), options.jobs, [&](std::size_t k) {
    if (continuum_model(s, keys[k].model) == keys[k].model) results.statics[k] = solve_statics(s, keys[k], options);
    progress(4);
  });
  for (std::size_t k = 0; k < keys.size(); ++k) {  // lagged and implicit strains have the same equilibrium
    StripMaterial solved = keys[k];
    solved.model = continuum_model(s, solved.model);
    if (solved == keys[k]) continue;
    results.statics[k] = *results.find(solved);
    results.statics[k].key = keys[k];
  }

  const auto cases = cases_of(s);
  const auto lattices = lattices_with_strain(s);
  results.waves.resize(cases.size());
  results.stability.resize(lattices.size());
  if (options.with_fem) results.fem = fem_outcomes(s);
  const StripCase shown{StripPacking::random, s.seeds.front(), s.models.front(), s.stiffness_ratios.front(), Protocol::paper, StripWave::bar};
  if (options.with_studies) results.sizes = plan_sizes(s);
  if (results.sizes && results.sizes->strips.empty()) results.sizes.reset();
  const StabilityGrid grid = stability_grid(s.full_stability);
  results.stability_maps.resize(options.with_studies ? grid.maps.size() : 0);

  // The longest first.
  std::vector<std::function<void()>> jobs;
  if (options.with_fem) jobs.push_back([&] { run_all_fem(s, results, options); });
  for (std::size_t k = 0; results.sizes && k < results.sizes->strips.size(); ++k) {
    jobs.push_back([&, k] { measure_strip(s, *results.sizes, k), progress(1); });
  }
  if (options.with_studies) jobs.push_back([&] { run_studies(s, results, options, progress); });
  for (std::size_t k = 0; k < results.stability_maps.size(); ++k) {
    jobs.push_back([&, k] { results.stability_maps[k] = map_stability(s, grid, grid.maps[k]), progress(1); });
  }
  for (std::size_t k = 0; k < lattices.size(); ++k) {
    jobs.push_back([&, k] { results.stability[k] = release_noise(s, lattices[k], options), progress(4); });
  }
  for (std::size_t k = 0; k < cases.size(); ++k) {
    jobs.push_back([&, k] {
      const StripCase& c = cases[k];
      const StaticOutcome* statics = results.find(StripMaterial{c.packing, c.seed, c.model, c.stiffness_ratio});
      StripPicture* picture = id_of(c) == id_of(shown) ? &results.picture : nullptr;
      results.waves[k] = simulate_case(s, c, *statics, options, picture);
      progress(1);
    });
  }
  run_jobs(jobs.size(), options.jobs, [&](std::size_t job) { jobs[job](); });
  place_probes(s, results.picture);
  results.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return results;
}

}  // namespace ddem::harness
