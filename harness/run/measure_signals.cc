#include "harness/run/measure_signals.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/io/errors.h"
#include "harness/model/assemble.h"
#include "harness/scene/place.h"
#include "harness/solvers/exchange.h"

namespace ddem::harness {
namespace {

constexpr double kSameTime = 1e-6;  // of an interval

/// The interval of the table's times, s.
double interval_of(const SignalTable& table, const std::string& path) {
  const std::vector<double>& t = table.time;
  if (t.size() < 3) throw InputError(fmt::format("{}: {} samples are no signals", path, t.size()));
  const double dt = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  for (std::size_t n = 0; n < t.size(); ++n) {
    const double expected = static_cast<double>(n) * dt;
    if (std::abs(t[n] - expected) > kSameTime * dt) {
      throw InputError(fmt::format("{}:{}: time {:.9g} s: equal steps from 0 on are needed, and would have {:.9g} s here; resample the signals", path, n + 2,
                                   t[n], expected));
    }
  }
  return dt;
}

/// What is known of the march that made the signals: the scene's where the interval is its own, else nothing.
void take_interval(DemRun& run, double dt) {
  if (std::abs(dt - run.sample_interval) <= kSameTime * dt) return;
  run.sample_interval = dt;
  run.context.march_step = run.context.sample_step = 0.0;
}

}  // namespace

MeasuredSignals measure_signals(const Scene& scene, const SignalTable& table, const std::string& path) {
  PreparedRun prepared = prepare_run(scene, build_assembly(scene));
  DemRun& run = prepared.run;
  if (!run.wave || run.layout.pairs.empty()) {
    throw InputError(scene_problem(scene, "probes.pairs", "there is no wave to measure: the scene has no pairs of probes, or no pulse or drive",
                                   "give probes.pairs, and [initial] wave or [drive]"));
  }
  take_interval(run, interval_of(table, path));
  std::vector<std::string> names;
  for (const Probe& p : run.layout.probes) names.push_back(p.name);
  SimulationResult result;
  result.signals = signals_of(table, names, false, path);
  MeasuredSignals m;
  m.run = finish_run(scene, std::move(prepared), std::move(result));
  m.moduli = scene_moduli(scene);
  m.static_speed = m.moduli.speed_of(*m.run.wave, m.run.assembly.packing.period.y > 0.0);
  m.phase_velocities = phase_velocities(wave_component(m.run.result.signals, *m.run.wave), m.run.sample_interval, m.run.layout, m.run.context);
  return m;
}

}  // namespace ddem::harness
