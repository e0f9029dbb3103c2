#include "harness/io/errors.h"
#include "harness/studies/waves/waves_run.h"

#include <fmt/format.h>

#include "dem/core/narrow.h"
#include "harness/run/bar_reference.h"
#include "harness/run/dem_run.h"

namespace ddem::harness {
namespace {

/// Figures show the first random packing.
bool keeps_recording(const StripCampaign& s, const StripCase& c) {
  return c.packing == StripPacking::random && c.seed == s.seeds.front();
}

void take_driven_speeds(const DemRun& run, const StaticOutcome& statics, WaveOutcome& out) {
  const PickedSpeeds picked = picked_speeds(*run.measurement);
  out.centroid_speed = picked.centroid;
  out.correlation_speed = picked.correlation;
  out.section_speed = statics.sections.of(out.c.wave);
  if (out.c.wave != StripWave::bar) return;
  const references::FreeStrip strip{out.static_speed, run.assembly.packing.width,
                                    statics.moduli.strip.value().lateral_contraction.value()};
  out.s0 = picked_speeds(s0_measurement(strip, run.layout, run.context));
}

void place_probes(const ProbeLayout& layout, StripPicture& picture) {
  for (std::size_t p = 0; p < layout.probes.size(); ++p) {
    picture.probe_x.push_back(layout.probes[p].x);
    picture.probe_y.push_back(layout.probes[p].y);
    picture.probe_labels.push_back(
        fmt::format("{}{}", static_cast<char>('A' + static_cast<int>(p / 2) % 26), p % 2 + 1));
  }
}

WaveOutcome simulate_case(const StripCampaign& s, const StripCase& c, const StaticOutcome& statics,
                          StripStatics& shared, const CampaignOptions& options) {
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
    run_options.solver = options.solver;
    run_options.expected_speed = out.static_speed;
    run_options.warn = false;
    run_options.energy_samples = 0;  // the studies of schemes and stability look at energies
    if (!options.disturb_scene) {
      run_options.critical_time_step = statics.critical_time_step;
      run_options.relaxations = shared.relaxations({c.packing, c.seed, c.model, c.stiffness_ratio}, c.wave != StripWave::bar);
    }
    // A disturbed scene has an assembly of its own.
    const DemRun run =
        options.disturb_scene
            ? run_scene(scene, run_options)
            : run_assembly(scene, shared.strip(c.packing, c.seed, c.wave != StripWave::bar), run_options);
    out.time_step = run.time_step;
    out.critical_time_step = run.critical_time_step;
    out.steps = run.result.steps_done;
    if (run.result.breakdown) {
      out.diverged = true;
      out.diverged_step = run.result.breakdown->step;
      out.diverged_disc = run.result.breakdown->disc;
      out.failure = fmt::format("diverged at step {}, disc {}", out.diverged_step, out.diverged_disc);
      return out;
    }
    take_speed(*run.measurement, out.speed, out.speed_stddev, out.failure);
    out.good_pairs = narrow<int>(run.measurement->speed.good_pairs, "pairs");
    if (c.protocol == Protocol::long_wave) take_driven_speeds(run, statics, out);
    if (keeps_recording(s, c)) {
      out.recording = record(wave_component(run.result.signals, *run.wave), run.sample_interval, run.layout,
                             run.context, run.measurement);
    }
  } catch (const UnsupportedError&) {  // no failure, but what a solver cannot do
    throw;
  } catch (const std::exception& e) {
    out.failure = e.what();
  }
  return out;
}

/// Half-way of the paper's bar wave. All discs are seen, so that it is marched step by step.
StripPicture take_picture(const StripCampaign& s, const StripMaterial& m, const StaticOutcome& statics,
                          StripStatics& shared) {
  StripPicture picture;
  if (!statics.failure.empty()) return picture;
  Scene scene = scene_of(scene_text(s, case_of(m, StripWave::bar, Protocol::paper), statics.speeds.bar), "picture");
  scene.time.integrator = Integrator::verlet;
  RunOptions options;
  options.expected_speed = statics.speeds.bar;
  options.critical_time_step = statics.critical_time_step;
  options.warn = false;
  options.snapshots = 2;
  const DemRun run = run_assembly(scene, shared.strip(m.packing, m.seed, false), options);
  if (run.result.snapshots.empty()) return picture;
  place_probes(run.layout, picture);
  picture.packing = run.assembly.packing;
  picture.time = run.result.snapshots.front().time;
  picture.displacement = run.result.snapshots.front().state.ux;
  return picture;
}

}  // namespace

Recording record(const std::vector<std::vector<double>>& signals, double dt, const ProbeLayout& layout,
                 const WaveContext& context, const std::optional<WaveMeasurement>& measurement) {
  Recording r;
  r.sample_interval = dt;
  for (std::size_t p = 0; p < layout.probes.size(); ++p) {
    const double x = layout.probes[p].x;
    PickedSignal s{
        layout.probes[p].name, x - context.left_end, signals[p], causal_window(context, x).end, {}, {}, ""};
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

void take_speed(const WaveMeasurement& m, std::optional<double>& speed, std::optional<double>& stddev,
                std::string& failure) {
  if (m.speed.speed.ok()) {
    speed = m.speed.speed.value().mean;
    stddev = m.speed.speed.value().stddev;
  } else {
    failure = m.speed.speed.error().reason;
  }
}

bool shows_strip(const StripCampaign& s, const StripMaterial& m) {
  return m ==
         StripMaterial{StripPacking::random, s.seeds.front(), s.models.front(), s.stiffness_ratios.front()};
}

WaveSet send_waves(const StripCampaign& s, const StripMaterial& m, Protocol protocol, StripStatics& shared, const CampaignOptions& options) {
  WaveSet out;
  const StaticOutcome statics = shared.of(m);
  if (protocol == Protocol::long_wave && shows_strip(s, m)) out.picture = take_picture(s, m, statics, shared);
  for (const StripCase& c : cases_of(m, protocol)) out.waves.push_back(simulate_case(s, c, statics, shared, options));
  return out;
}

}  // namespace ddem::harness
