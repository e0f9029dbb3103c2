#include "harness/run/dem_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "dem/assembly/rattlers.h"
#include "dem/simulation/exact.h"
#include "dem/spectra/spectra.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/model/load.h"
#include "harness/model/packing_report.h"
#include "harness/run/scene_moduli.h"
#include "harness/scene/place.h"

namespace ddem::harness {
namespace {

constexpr long kMostSteps = 2'000'000'000;
constexpr double kMostSignalBytes = 4e9;
constexpr double kMostFilterWork = 1e12;  // multiplications: minutes

double choose_step(const Scene& scene, double critical) {
  const Time& time = scene.time;
  const auto* seconds = std::get_if<StepSeconds>(&time.step);
  const double step = seconds != nullptr ? seconds->seconds : std::get<StepFraction>(time.step).of_critical * critical;
  if (step > critical && !time.allow_above_critical) {
    throw InputError(scene_problem(scene, seconds != nullptr ? "time.step" : "time.step_fraction",
                                   fmt::format("the time step {:.6g} s is above the critical one, {:.6g} s", step, critical),
                                   "lower it, or set time.allow_above_critical = true for a stability study"));
  }
  return step;
}

/// Signals are kept in memory: three values a probe and sample.
void check_signal_size(const Scene& scene, const DemRun& run, double steps) {
  const double samples = steps / static_cast<double>(scene.time.sample_every);
  const double bytes = 24.0 * samples * static_cast<double>(std::max<std::size_t>(1, run.layout.probes.size()));
  if (bytes > kMostSignalBytes) {
    throw InputError(scene_problem(scene, "time.sample_every",
                                   fmt::format("{:.3g} samples of {} probes take {:.3g} GB", samples, run.layout.probes.size(), bytes * 1e-9),
                                   fmt::format("raise it or end earlier: at most {:.3g} GB", kMostSignalBytes * 1e-9)));
  }
}

/// Of `step`, which verlet marches with.
long choose_steps(const Scene& scene, const DemRun& run, double step) {
  double seconds = 0.0;
  if (const auto* steps = std::get_if<EndSteps>(&scene.time.end)) return static_cast<long>(steps->steps);
  if (const auto* end = std::get_if<EndTime>(&scene.time.end)) {
    seconds = end->seconds;
  } else {
    if (!run.wave || run.layout.pairs.empty()) {
      throw InputError(scene_problem(scene, "time.end", "without pairs of probes and a pulse there is no last peak to wait for",
                                     "give time.end or time.steps"));
    }
    // The kinematic estimate is up to 25 % too fast. After the last window no probe is looked at.
    double windows = 0.0;
    for (const Probe& p : run.layout.probes) {
      seconds = std::max(seconds, time_of_passage(run.context, p.x, 0.45));
      windows = std::max(windows, causal_window(run.context, p.x).end);
    }
    seconds = std::min(seconds, windows);
  }
  const double steps = std::ceil(seconds / step);
  if (!(steps <= static_cast<double>(kMostSteps))) {
    throw InputError(scene_problem(
        scene, "time.end", fmt::format("{:.6g} s take {:.3g} steps of {:.3g} s", seconds, steps, step),
        fmt::format("at most {} steps are allowed", kMostSteps)));
  }
  return static_cast<long>(steps);
}

WaveContext wave_context(const Scene& scene, const ddem::Assembly& a, Wave wave, std::optional<double> speed) {
  WaveContext c;
  const auto [left, right] = std::minmax_element(a.packing.x.begin(), a.packing.x.end());
  c.left_end = *left;
  c.length = *right - *left;
  c.speed = speed.value_or(0.0);
  if (!speed) c.speed = kinematic_speed(scene, a, wave);
  c.source_centre = source_centre(scene);
  c.source_duration = source_duration(scene);
  c.source_amplitude = source_amplitude(scene);
  c.smallest_arrival = smallest_arrival(scene);
  c.pulse_half_width = pulse_half_width(scene, c.speed);
  return c;
}

/// Bonds that a file lists may be meant to leave pieces apart, or not.
void warn_of_pieces(const Scene& scene, DemRun& run) {
  if (!std::holds_alternative<BondFile>(scene.assembly.bonding)) return;
  const std::size_t networks = connected_components(run.assembly.size(), run.assembly.bonds, run.assembly.rattlers).size();
  if (networks + run.assembly.rattlers.size() == 1) return;
  run.warnings.push_back(fmt::format("the listed bonds make {} networks and leave {} discs without a bond: these act on each other by "
                                     "new contacts only; name the missing bonds if they belong together",
                                     networks, run.assembly.rattlers.size()));
}

/// Lagged DDEM beyond its limits runs, with a warning (theory section 3).
void warn_of_instability(const Scene& scene, DemRun& run) {
  const DeformationParameters d = deformation_parameters(scene);
  if (d.scheme != Scheme::lagged) return;
  if (d.evaluations % 2 == 0 && d.relaxation == 1.0) {
    run.warnings.push_back(fmt::format("deformation.evaluations = {}: an even number of evaluations without relaxation adds energy "
                                       "to the waves; use an odd number, or relaxation below 1",
                                       d.evaluations));
  }
  // A share w of the new strain stretches the limit of the fixed point to 2/w - 1.
  const double radius = fixed_point_radius(run.assembly, contact_parameters(scene), d) / (2.0 / d.relaxation - 1.0);
  if (radius >= 1.0) {
    run.warnings.push_back(fmt::format("the lagged scheme is unstable here: the spectral radius of K B is {:.4g} times what it may "
                                       "be; stiffen the discs (young_modulus) by that factor, or use scheme = \"implicit\"",
                                       radius));
  } else if (d.evaluations == 1 && d.relaxation == 1.0 && (d.correction != Correction::normal || scene.contact->stiffness_ratio == 0.0)) {
    DeformationParameters symmetric = d;
    if (scene.contact->stiffness_ratio == 0.0) symmetric.correction = Correction::normal_only_stress;
    const double limit = flip_limit_step(run.assembly, contact_parameters(scene), symmetric, held_dofs(scene, run.assembly));
    if (run.time_step > limit) {
      run.warnings.push_back(fmt::format("the lagged scheme is unstable at this step: its limit is {:.4g} s, {:.3g} of the "
                                         "critical step of DEM; lower step_fraction below that",
                                         limit, limit / run.critical_time_step));
    }
  }
}

/// `in` as for verlet with the step from one sample to the next; its time step is that of the march.
SimulationResult run_exact(const Scene& scene, const DemRun& run, const SimulationInput& in) {
  if (in.snapshots > 0) {
    throw InputError(
        scene_problem(scene, "time.integrator",
                      "snapshots of all discs are not exact in time: the probes' signals alone are",
                      "leave --snapshots out, or use integrator = \"verlet\""));
  }
  const Sampling sampling{run.sample_interval, static_cast<std::size_t>(in.steps / in.sample_every + 1)};
  if (const double work = filter_work(in, sampling); !(work <= kMostFilterWork)) {
    throw InputError(scene_problem(
        scene, "time.integrator",
        fmt::format("{:.3g} exact samples take {:.3g} multiplications", static_cast<double>(sampling.samples),
                    work),
        fmt::format("raise time.sample_every or end earlier (at most {:.3g}), or use integrator = \"verlet\"",
                    kMostFilterWork)));
  }
  SimulationResult result = simulate_exact(run.assembly, in, sampling);
  if (const auto& c = result.new_contacts) {
    throw InputError(scene_problem(
        scene, "time.integrator",
        fmt::format("discs that are not bonded come to touch, first at {:.6g} s: the motion is not linear",
                    static_cast<double>(c->first_step) * run.time_step),
        "use integrator = \"verlet\", lower the amplitude, or set contact.new_contacts = \"off\""));
  }
  return result;
}

}  // namespace

BreakdownText describe(const Breakdown& b, const Scene& scene) {
  switch (b.cause) {
    case Breakdown::Cause::diverged:
      return {"the run diverged", scene.deformation ? "lower the time step, stiffen the discs, or use scheme = \"implicit\"" : "lower the time step"};
    case Breakdown::Cause::strains_not_converged:
      return {"the implicit strains did not converge", "raise deformation.tolerance, stiffen the discs (young_modulus), or use solver = \"polynomial\""};
    case Breakdown::Cause::strains_indefinite:
      return {"the system of the implicit strains is not positive definite", "lower the time step: the motion is not finite any more, or close to it"};
    case Breakdown::Cause::contacts_undecided:
      return {"new contacts and implicit strains found no agreement", "use solver = \"polynomial\", lower the amplitude, or set contact.new_contacts = \"off\""};
  }
  return {};
}

const std::vector<std::vector<double>>& wave_component(const Signals& s, Wave wave) {
  return wave == Wave::longitudinal ? s.ux : s.uy;
}

DemRun run_scene(const Scene& scene, const RunOptions& options) { return run_assembly(scene, build_assembly(scene), options); }

DemRun run_assembly(const Scene& scene, ddem::Assembly assembly, const RunOptions& options) {
  DemRun run;
  run.assembly = std::move(assembly);
  run.layout = lay_probes(scene, run.assembly);
  run.wave = wave_of(scene);

  SimulationInput in;
  in.contact = contact_parameters(scene);
  in.deformation = deformation_parameters(scene);
  in.relaxations = options.relaxations;
  in.held = held_dofs(scene, run.assembly);
  in.initial = initial_state(scene, run.assembly);
  in.drive = edge_drive(scene, run.assembly);
  in.sample_every = static_cast<int>(scene.time.sample_every);
  in.threads = worthwhile_threads(static_cast<int>(scene.run.threads), run.assembly.size());
  if (scene.contact.value().new_contacts == NewContacts::automatic) in.new_contacts = ContactWatch::bound;
  in.on_progress = options.on_progress;
  in.energy_samples = options.energy_samples;
  in.snapshots = options.snapshots;
  for (const Probe& p : run.layout.probes) in.receivers.push_back(p.receiver);

  run.critical_time_step =
      options.critical_time_step ? *options.critical_time_step : 2.0 / largest_frequency(run.assembly, in.contact, in.held);
  const double step = choose_step(scene, run.critical_time_step);
  const bool exact = scene.time.integrator == Integrator::exact;
  run.time_step = in.time_step = exact ? exact_step(run.critical_time_step, in.drive) : step;
  run.sample_interval = step * static_cast<double>(in.sample_every);
  if (run.wave) run.context = wave_context(scene, run.assembly, *run.wave, options.expected_speed);
  in.steps = choose_steps(scene, run, step);
  check_signal_size(scene, run, static_cast<double>(in.steps));
  if (options.warn) {
    if (const auto crystal = crystal_warning(scene)) run.warnings.push_back(*crystal);
    warn_of_pieces(scene, run);
    warn_of_instability(scene, run);
  }

  run.result = exact ? run_exact(scene, run, in) : simulate(run.assembly, in);
  if (const auto& c = run.result.new_contacts; c && options.warn && !run.result.breakdown && run.time_step > c->critical_time_step) {
    run.warnings.push_back(fmt::format("new contacts have closed, and were all that are near to close, the critical step would be "
                                       "{:.4g} s; this step is {:.4g} s: lower step_fraction by {:.3g} to be sure",
                                       c->critical_time_step, run.time_step, c->critical_time_step / run.time_step));
  }
  if (!run.result.breakdown && run.wave && !run.layout.pairs.empty()) {
    run.measurement = measure_wave(wave_component(run.result.signals, *run.wave), run.sample_interval,
                                   run.layout, run.context);
  }
  return run;
}

}  // namespace ddem::harness
