#include "harness/studies/solvers/solvers_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/run/dem_run.h"
#include "harness/run/scene_moduli.h"
#include "harness/scene/read_scene.h"

namespace ddem::harness {
namespace {

constexpr double kSolverAmplitude = 1e-6;       // mean radii, of what is judged
constexpr double kSolverStepFraction = 0.2;     // likewise
constexpr double kRoundOff = 1e-9;        // relative changes below which no order is to be seen
constexpr double kMeanRadius = 1e-4;      // m, about, of both strips
constexpr int kMiddle = 100;              // the disc whose signal is shown

std::string deformation_text(const std::string& law) {
  const std::size_t dash = law.find('-');
  if (dash == std::string::npos) return "";
  std::string correction = law.substr(dash + 1);
  std::ranges::replace(correction, '-', '_');
  return fmt::format("[deformation]\nscheme = \"{}\"\ncorrection = \"{}\"\nyoung_modulus = 4e10\npoisson_ratio = 0.3\n", law.substr(0, dash), correction);
}

/// `probes` and `time`: lines of those tables.
Scene scene_of(const SolverTask& task, double amplitude, double step_fraction, int sample_every, const std::string& probes, const std::string& end) {
  const bool random = task.packing == "random";
  const std::string text =
      fmt::format("[assembly]\n{}[material]\ndensity = 2000\n[contact]\nnormal_stiffness = 1e10\nstiffness_ratio = {}\n{}[boundary]\n{}[drive]\nwave = \"{}\"\n"
                  "duration = {}\namplitude = {}\n[time]\nstep_fraction = {}\nsample_every = {}\n{}[probes]\n{}\n",
                  random ? "packing = \"random\"\nlength = \"7 mm\"\nwidth = \"1.1 mm\"\ndiscs = 200\nseed = 1\n"
                         : "packing = \"hexagonal\"\ncolumns = 30\nrows = 8\nradius = \"0.1 mm\"\n",
                  task.stiffness_ratio, deformation_text(task.law), random ? "top_bottom = \"periodic\"\n" : "top_bottom = \"free\"\n",
                  random ? "shear" : "longitudinal", random ? "1.5e-6" : "1e-6", amplitude * kMeanRadius, step_fraction, sample_every, end, probes);
  const SceneResult scene = parse_scene(text, "a strip for solvers", ".");
  if (!scene) throw std::logic_error(to_string(scene.violations));
  return *scene;
}

std::string all_discs(const SolverTask& task) {
  std::string list = "discs = [0";
  for (int d = 1; d < (task.packing == "random" ? 200 : 240); ++d) list += fmt::format(", {}", d);
  return list + "]";
}

DemRun run_by(const Solver& solver, const Scene& scene) {
  RunOptions options;
  options.solver = &solver;
  options.warn = false;
  DemRun run = run_scene(scene, options);
  if (run.result.breakdown) throw SolverError(describe(*run.result.breakdown, scene).what);
  return run;
}

using Motion = std::vector<std::vector<double>>;

double largest(const Motion& motion) {
  double most = 0.0;
  for (const auto& disc : motion) {
    for (const double u : disc) most = std::max(most, std::abs(u));
  }
  return most;
}

/// Of the larger motion; 0 where nothing moves.
double difference(const Motion& a, const Motion& b, double scale) {
  double most = 0.0;
  for (std::size_t d = 0; d < a.size(); ++d) {
    for (std::size_t n = 0; n < std::min(a[d].size(), b[d].size()); ++n) most = std::max(most, std::abs(a[d][n] - b[d][n]));
  }
  return scale > 0.0 ? most / scale : most;
}

double displacement_difference(const Signals& a, const Signals& b) {
  const double scale = std::max(largest(a.ux), largest(a.uy));
  return std::max(difference(a.ux, b.ux, scale), difference(a.uy, b.uy, scale));
}

/// All discs for some crossings of the strip's width.
Signals motion_by(const Solver& solver, const SolverTask& task, double amplitude, double step_fraction, int sample_every, DemRun* run = nullptr) {
  const Scene scene = scene_of(task, amplitude, step_fraction, sample_every, all_discs(task), "end = 2.5e-6\n");
  DemRun found = run_by(solver, scene);
  Signals signals = std::move(found.result.signals);
  if (run != nullptr) *run = std::move(found);
  return signals;
}

double nanoseconds_of(const DemRun& run) {
  const double work = static_cast<double>(run.assembly.bonds.size()) * static_cast<double>(run.result.steps_done);
  return work > 0.0 ? 1e9 * run.result.wall_seconds / work : 0.0;
}

void compare_motions(const SolverTask& task, const Solver& solver, SolverResult& r) {
  DemRun theirs, ours;
  const Signals a = motion_by(builtin_solver(), task, kSolverAmplitude, kSolverStepFraction, 1, &ours), b = motion_by(solver, task, kSolverAmplitude, kSolverStepFraction, 1, &theirs);
  r.displacement_error = displacement_difference(a, b);
  r.rotation_error = task.stiffness_ratio > 0.0 ? difference(a.theta, b.theta, largest(a.theta)) : 0.0;
  r.energy_drift = theirs.result.energy_drift;
  r.nanoseconds = nanoseconds_of(theirs), r.builtin_nanoseconds = nanoseconds_of(ours);
  const bool shear = task.packing == "random";
  r.time = a.time, r.builtin_signal = (shear ? a.uy : a.ux)[kMiddle], r.signal = (shear ? b.uy : b.ux)[kMiddle];
  for (const double amplitude : {1e-4, 1e-3, 2e-3}) {
    r.amplitude.push_back(amplitude);
    r.amplitude_error.push_back(displacement_difference(motion_by(builtin_solver(), task, amplitude, kSolverStepFraction, 1), motion_by(solver, task, amplitude, kSolverStepFraction, 1)));
  }
}

void halve_steps(const SolverTask& task, const Solver& solver, SolverResult& r) {
  Signals before = motion_by(solver, task, kSolverAmplitude, 0.4, 1);
  for (const auto& [fraction, every] : {std::pair{0.2, 2}, {0.1, 4}}) {
    Signals now = motion_by(solver, task, kSolverAmplitude, fraction, every);
    r.step.push_back(fraction);
    r.step_change.push_back(displacement_difference(now, before));
    before = std::move(now);
  }
}

double speed_of(const DemRun& run, std::string& reason) {
  const auto& speed = run.measurement->speed.speed;
  if (!speed.ok()) reason = speed.error().reason;
  return speed.ok() ? speed.value().mean : 0.0;
}

void measure_speeds(const SolverTask& task, const Solver& solver, SolverResult& r) {
  const Scene scene = scene_of(task, kSolverAmplitude, kSolverStepFraction, 1, "pairs = 3\nsection = true", "");
  r.builtin_speed = speed_of(run_by(builtin_solver(), scene), r.speed_reason);
  r.speed = speed_of(run_by(solver, scene), r.speed_reason);
  const bool shear = task.packing == "random";
  r.static_speed = scene_moduli(scene).speed_of(shear ? Wave::shear : Wave::longitudinal, shear).value_or(0.0);
}

std::optional<double> order_of(double coarse, double fine, double ratio) {
  if (!(fine > kRoundOff) || !(coarse > 0.0)) return std::nullopt;
  return std::log(coarse / fine) / std::log(ratio);
}

}  // namespace

std::string SolverTask::id() const { return fmt::format("solvers/{}/{}/{}/kt{:.2f}", label, packing, law, stiffness_ratio); }

std::optional<double> SolverResult::order() const {
  return step_change.size() < 2 ? std::nullopt : order_of(step_change[0], step_change[1], 2.0);
}

std::optional<double> SolverResult::amplitude_order() const {
  return amplitude_error.size() < 3 ? std::nullopt : order_of(amplitude_error[2], amplitude_error[1], 2.0);
}

std::vector<SolverTask> solver_tasks(const std::string& solver, const std::string& label) {
  std::vector<SolverTask> tasks;
  for (const char* packing : {"random", "hexagonal"}) {
    tasks.push_back({solver, label, packing, "dem", 0.0});
    for (const char* law : {"dem", "lagged-normal", "lagged-full", "lagged-normal-only-stress", "implicit-full"}) tasks.push_back({solver, label, packing, law, 0.5});
  }
  return tasks;
}

SolverResult measure_solver(const SolverTask& task, const Solver& solver) {
  SolverResult r;
  r.failure = "";
  r.name = solver.name(), r.version = solver.version();
  compare_motions(task, solver, r);
  halve_steps(task, solver, r);
  measure_speeds(task, solver, r);
  return r;
}

}  // namespace ddem::harness
