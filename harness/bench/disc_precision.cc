#include "harness/bench/disc_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "dem/simulation/exact.h"
#include "dem/spectra/spectra.h"
#include "harness/bench/lattice_pulse.h"

namespace ddem::harness::bench {
namespace {

constexpr int kPaperColumns = 62;
constexpr double kPulseWidth = 1e-3;  // standard width, m: 7.6 radii of 62 columns, 30 of 248
constexpr int kReceivers = 10;
// At the critical step itself the fastest mode grows linearly in time, from the round-off of the start.
constexpr double kLargestFraction = 1.0 - 1e-4;

struct Errors {
  double lattice, continuum;
};

Errors compare(const Signals& s, const LatticePulse& pulse, const std::vector<double>& places) {
  double lattice2 = 0.0, continuum2 = 0.0, total2 = 0.0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    for (std::size_t n = 0; n < s.time.size(); ++n) {
      const double exact = pulse.lattice(places[p], s.time[n]), smooth = pulse.continuum(places[p], s.time[n]);
      lattice2 += std::pow(s.uy[p][n] - exact, 2);
      continuum2 += std::pow(s.uy[p][n] - smooth, 2);
      total2 += smooth * smooth;
    }
  }
  return {std::sqrt(lattice2 / total2), std::sqrt(continuum2 / total2)};
}

struct Subject {
  const ddem::Assembly& assembly;
  int columns, rows;
  double critical;  ///< s
};

/// Signals without an error of time stepping, as often as verlet's at 0.2 of the critical step.
Sampling exact_sampling(const Subject& subject, const LatticePulse& pulse) {
  const double interval = 0.2 * subject.critical;
  return {interval, static_cast<std::size_t>(std::ceil(pulse.passage() / interval)) + 1};
}

/// Without a fraction: exact in time.
PrecisionPoint measure(const Subject& subject, const Law& law, std::optional<double> fraction, double seconds) {
  const ddem::Assembly& a = subject.assembly;
  const LatticePulse pulse(law, subject.columns, a.packing.radius.front(), kPulseWidth);
  SimulationInput in;
  in.contact = law.contact;
  in.deformation = law.deformation;
  in.initial = pulse.start(a);
  in.energy_samples = 0;
  in.time_step = fraction ? std::min(*fraction, kLargestFraction) * subject.critical : exact_step(subject.critical, std::nullopt);
  in.steps = std::lround(std::ceil(pulse.passage() / in.time_step));
  std::vector<double> places;
  for (int k = 0; k < kReceivers; ++k) {
    const int disc = subject.columns * k / kReceivers;
    in.receivers.push_back({{disc}});
    places.push_back(a.packing.x[disc]);
  }
  PrecisionPoint point{law.deformation.active() ? "DDEM" : "DEM", (law.deformation.active() ? law.name : "rigid") + (fraction ? "" : ", exact"),
                       fmt::format("{} x {}", subject.columns, subject.rows), a.size(), fraction.value_or(in.time_step / subject.critical), in.steps,
                       std::numeric_limits<double>::infinity(), 0.0, 0.0, "ok"};
  double spent = 0.0;
  for (int run = 0; run == 0 || spent < seconds; ++run) {
    const SimulationResult r = fraction ? simulate(a, in) : simulate_exact(a, in, exact_sampling(subject, pulse));
    point.steps = r.steps_done;
    if (r.breakdown) {
      point.status = fmt::format("unstable: step {}", r.breakdown->step);
      point.seconds = r.wall_seconds;
      return point;
    }
    point.seconds = std::min(point.seconds, r.wall_seconds);
    spent += r.wall_seconds;
    if (run > 0) continue;
    const Errors e = compare(r.signals, pulse, places);
    point.error = e.lattice;
    point.error_to_continuum = e.continuum;
    if (e.lattice > 1.0) {  // not beyond the solver's own bound yet, but no signal any more
      point.status = "unstable: the signals are lost";
      return point;
    }
  }
  return point;
}

}  // namespace

DiscPlan disc_plan() { return {{62, 124, 248}, {1.0, 0.5, 0.2, 0.1, 0.05}, 0.05}; }

std::vector<PrecisionPoint> measure_discs(const DiscPlan& plan, const std::function<void()>& progress) {
  std::vector<PrecisionPoint> points;
  for (const int columns : plan.columns) {
    const int rows = 2 * std::max(1, static_cast<int>(std::lround(0.1 * columns)));
    const ddem::Assembly a = lattice(columns, rows, true, kRadius * kPaperColumns / columns);
    for (const Law& law : {rigid(true), deformable(Scheme::lagged), deformable(Scheme::implicit)}) {
      const Subject subject{a, columns, rows, 2.0 / largest_frequency(a, law.contact, {})};
      for (const double fraction : plan.step_fractions) points.push_back(measure(subject, law, fraction, plan.seconds_a_point));
      if (law.deformation.scheme != Scheme::lagged) points.push_back(measure(subject, law, std::nullopt, plan.seconds_a_point));
      progress();
    }
  }
  return points;
}

}  // namespace ddem::harness::bench
