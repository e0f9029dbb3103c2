#include "harness/run/dem_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <variant>

#include "dem/assembly/rattlers.h"
#include "dem/core/narrow.h"
#include "dem/simulation/exact.h"
#include "dem/spectra/spectra.h"
#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/model/load.h"
#include "harness/model/memory_need.h"
#include "harness/model/packing_report.h"
#include "harness/run/instability_warnings.h"
#include "harness/run/load_limits.h"
#include "harness/run/pulse_dispersion.h"
#include "harness/run/scene_moduli.h"
#include "harness/scene/limits.h"
#include "harness/scene/place.h"

namespace ddem::harness {
namespace {

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

MemoryPart part_of_snapshots(double discs, int snapshots) {
  return {fmt::format("{} snapshots of {:.3g} discs", snapshots, discs), memory_of_snapshots(discs, snapshots), "--snapshots", "ask for fewer"};
}

/// What the run keeps until its end, of `in` as for verlet. Exact signals are made of the states of a march.
void check_memory(const Scene& scene, const DemRun& run, const SimulationInput& in, bool as_text) {
  const double probes = static_cast<double>(std::max<std::size_t>(1, run.layout.probes.size())), discs = static_cast<double>(run.assembly.size());
  const double samples = static_cast<double>(in.steps / in.sample_every) + 1.0;
  const double states = scene.time.integrator == Integrator::exact ? (samples - 1.0) * run.sample_interval / run.time_step : 0.0;
  if (!(states <= static_cast<double>(kMostSteps))) {
    throw InputError(scene_problem(scene, "time.integrator", fmt::format("exact signals until then take {:.3g} steps of {:.3g} s", states, run.time_step),
                                   fmt::format("end earlier: at most {} steps are allowed", kMostSteps)));
  }
  const MemoryPart parts[] = {
      memory_of_discs(scene, discs, DiscWork::simulation),
      {fmt::format("{:.3g} samples of {} probes", samples + states, run.layout.probes.size()), memory_of_samples(samples + states, probes, as_text), "time.sample_every",
       "raise it, or end earlier"},
      part_of_snapshots(discs, in.snapshots)};
  require_memory(scene, parts);
}

/// Of `step`, which verlet marches with.
long choose_steps(const Scene& scene, const DemRun& run, double step) {
  double seconds = 0.0;
  if (const auto* steps = std::get_if<EndSteps>(&scene.time.end)) return narrow<long>(steps->steps, "time.steps");
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
  return narrow<long>(steps, "time.end");
}

/// `march_step` is 0 where the signals are exact in time.
WaveContext context_of(const Scene& scene, const ddem::Assembly& a, Wave wave, std::optional<double> speed, double march_step, double sample_step) {
  const auto [left, right] = network_ends(a);
  WaveContext c = wave_context(scene, {left, right - left, a.packing.period.x, edge_band(scene, a)},
                               speed ? *speed : kinematic_speed(scene, a, wave));
  c.march_step = march_step;
  c.sample_step = sample_step;
  return c;
}

bool is_exact(const Scene& scene, const Solver& solver) { return scene.time.integrator == Integrator::exact && solver.abilities().exact_in_time; }

void enter_stage(const RunOptions& options, const char* stage) {
  if (options.on_stage) options.on_stage(stage);
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

/// `in` as for verlet with the step from one sample to the next; its time step is that of the march.
SimulationResult run_exact(const Scene& scene, const DemRun& run, const SimulationInput& in, const Solver& solver) {
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
  SimulationResult result = solver.solve_exact(run.assembly, in, sampling);
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

DemRun run_scene(const Scene& scene, const RunOptions& options) {
  if (const auto discs = planned_discs(scene)) {
    const MemoryPart parts[] = {memory_of_discs(scene, *discs, DiscWork::simulation), part_of_snapshots(*discs, options.snapshots)};
    require_memory(scene, parts);
  }
  enter_stage(options, "packing");
  return run_assembly(scene, build_assembly(scene), options);
}

PreparedRun prepare_run(const Scene& scene, ddem::Assembly assembly, const RunOptions& options) {
  enter_stage(options, "limits");
  PreparedRun prepared;
  DemRun& run = prepared.run;
  run.assembly = std::move(assembly);
  run.layout = lay_probes(scene, run.assembly);
  run.wave = wave_of(scene);

  SimulationInput& in = prepared.input;
  in.contact = contact_parameters(scene);
  in.deformation = deformation_parameters(scene);
  in.relaxations = options.relaxations;
  in.held = held_dofs(scene, run.assembly);
  in.initial = initial_state(scene, run.assembly);
  in.drive = edge_drive(scene, run.assembly);
  in.sample_every = narrow<long>(scene.time.sample_every, "time.sample_every");
  in.threads = worthwhile_threads(narrow<int>(scene.run.threads, "run.threads"), run.assembly.size());
  if (scene.contact.value().new_contacts == NewContacts::automatic) in.new_contacts = ContactWatch::bound;
  in.on_progress = options.on_progress;
  const Abilities can = options.solver->abilities();
  in.energy_samples = can.energies ? options.energy_samples : 0;
  in.snapshots = options.snapshots;
  for (const Probe& p : run.layout.probes) in.receivers.push_back(p.receiver);

  run.critical_time_step =
      options.critical_time_step ? *options.critical_time_step : 2.0 / largest_frequency(run.assembly, in.contact, in.held);
  const double step = choose_step(scene, run.critical_time_step);
  const bool exact = is_exact(scene, *options.solver);
  run.time_step = in.time_step = exact ? exact_step(run.critical_time_step, in.drive) : step;
  run.sample_interval = step * static_cast<double>(in.sample_every);
  if (run.wave) run.context = context_of(scene, run.assembly, *run.wave, options.expected_speed, exact ? 0.0 : step, step);
  in.steps = choose_steps(scene, run, step);
  if (in.snapshots > in.steps) {
    throw InputError(scene_problem(scene, "--snapshots", fmt::format("{} are more than the {} steps of the run", in.snapshots, in.steps), "ask for fewer"));
  }
  check_memory(scene, run, in, options.as_text);
  auto of_load = load_warnings(scene, run.assembly, in.initial, run.critical_time_step, run.context.march_step);
  prepared.load_is_doubtful = !of_load.empty();
  if (options.warn) {
    run.warnings = std::move(of_load);
    if (scene.time.integrator == Integrator::exact && !exact) {
      run.warnings.push_back(fmt::format("time.integrator: {} is not exact in time; it takes steps of {:.4g} s, {:.3g} of the critical one", options.solver->name(), step,
                                         step / run.critical_time_step));
    }
    if (const auto short_pulse = dispersion_warning(scene, run.assembly, run.context)) run.warnings.push_back(*short_pulse);
    if (const auto crystal = crystal_warning(scene)) run.warnings.push_back(*crystal);
    warn_of_pieces(scene, run);
    const MarchedScheme march{run.time_step, run.critical_time_step, in.steps};
    if (!exact) std::ranges::move(instability_warnings(scene, run.assembly, in.held, march), std::back_inserter(run.warnings));
  }
  return prepared;
}

DemRun finish_run(const Scene& scene, PreparedRun prepared, SimulationResult result, bool warn) {
  DemRun run = std::move(prepared.run);
  run.result = std::move(result);
  if (const auto& c = run.result.new_contacts; c && warn && !run.result.breakdown && run.time_step > c->critical_time_step) {
    run.warnings.push_back(fmt::format("new contacts have closed, and were all that are near to close, the critical step would be "
                                       "{:.4g} s; this step is {:.4g} s: lower step_fraction by {:.3g} to be sure",
                                       c->critical_time_step, run.time_step, c->critical_time_step / run.time_step));
  }
  if (run.result.breakdown) return run;
  const auto of_end = run.result.final_state.ux.empty() ? std::nullopt : end_warning(scene, run.assembly, run.result.final_state);
  if (of_end && !prepared.load_is_doubtful && warn) run.warnings.push_back(*of_end);
  run.context.obstacle = growth_of(run.result.energy, run.context.source_duration);
  if (run.context.obstacle && warn) run.warnings.push_back(run.context.obstacle->reason);
  if (run.wave && !run.layout.pairs.empty()) {
    run.measurement = measure_wave(wave_component(run.result.signals, *run.wave), run.sample_interval,
                                   run.layout, run.context);
  }
  return run;
}

DemRun run_assembly(const Scene& scene, ddem::Assembly assembly, const RunOptions& options) {
  PreparedRun prepared = prepare_run(scene, std::move(assembly), options);
  const auto& [run, in, doubtful] = prepared;
  if (const std::string reason = refusal(*options.solver, run.assembly, in); !reason.empty()) throw UnsupportedError(scene_problem(scene, "--solver", reason, "use another solver"));
  enter_stage(options, "simulating");
  SimulationResult result;
  try {
    result = is_exact(scene, *options.solver) ? run_exact(scene, run, in, *options.solver) : options.solver->solve(run.assembly, in);
  } catch (const std::invalid_argument& e) {  // strains that the scheme does not find; with its own remedy
    throw InputError(scene_problem(scene, "deformation.solver", e.what(), ""));
  }
  return finish_run(scene, std::move(prepared), std::move(result), options.warn);
}

}  // namespace ddem::harness
