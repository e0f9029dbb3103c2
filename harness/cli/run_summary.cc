#include "harness/cli/run_summary.h"

#include <fmt/format.h>

#include "harness/scene/units.h"

namespace ddem::harness {

void print_steps(const DemRun& run, const Scene& scene) {
  const SimulationResult& r = run.result;
  fmt::print("{} discs, {} bonds; {} steps of {} ({:.3g} of the critical {}) in {:.3g} s\n", run.assembly.size(),
             run.assembly.bonds.size(), r.steps_done, format_quantity(run.time_step, "s"), run.time_step / run.critical_time_step,
             format_quantity(run.critical_time_step, "s"), r.wall_seconds);
  if (r.energy_drift) fmt::print("energy drift {:.3g}{}\n", *r.energy_drift, scene.deformation && scene.deformation->scheme == Scheme::lagged ? " (strains that lag a step lose energy)" : "");
}

void print_speeds(const WaveMeasurement& measurement, const ProbeLayout& layout) {
  for (const PairSpeed& p : measurement.speed.pairs) {
    const std::string pair = fmt::format("{} to {}, {:.4g} mm", layout.probes[p.from].name, layout.probes[p.to].name, p.distance * 1e3);
    if (p.speed.ok()) {
      fmt::print("  {}: {:.5g} us, {:.5g} m/s\n", pair, p.delay.value() * 1e6, p.speed.value());
    } else {
      fmt::print("  {}: no velocity: {}\n", pair, p.speed.error().reason);
    }
  }
  const auto& speed = measurement.speed.speed;
  if (speed.ok()) {
    fmt::print("wave speed {:.5g} m/s, standard deviation {:.2g} m/s over {} pairs\n", speed.value().mean,
               speed.value().stddev.value_or(0.0), measurement.speed.good_pairs);
  } else {
    fmt::print("no wave speed: {}\n", speed.error().reason);
  }
}

}  // namespace ddem::harness
