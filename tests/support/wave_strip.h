#pragma once
// The paper's wave run: a column released at the left end of the random strip of 682 discs, plain DEM, recorded at five
// pairs of discs until the last has seen its peak.

#include <algorithm>
#include <cmath>

#include "dem/simulation/exact.h"
#include "dem/spectra/spectra.h"
#include "tests/support/assemblies.h"

namespace ddem::test {

struct WaveStrip {
  explicit WaveStrip(double stiffness_ratio) : assembly(random_free_strip()) {
    const Packing& p = assembly.packing;
    input.contact = {kNormalStiffness, stiffness_ratio, Kinematics::linear};
    input.held.x.assign(assembly.size(), 0);
    const double band = 1.2 * mean_radius(p);
    for (const int d : edge_discs(p, Edge::right, band)) input.held.x[d] = 1;
    input.initial.ux.assign(assembly.size(), 0.0);
    for (const int d : edge_discs(p, Edge::left, band)) input.initial.ux[d] = 1e-8;
    for (int pair = 0; pair < 5; ++pair) {
      const double y = 2e-3 * (pair + 0.5) / 5.0;
      for (const double x : {0.25 * 16.5e-3, (0.6 + 0.02 * pair) * 16.5e-3}) input.receivers.push_back({{nearest(x, y)}});
    }
    critical_time_step = 2.0 / largest_frequency(assembly, input.contact, input.held);
    input.time_step = exact_step(critical_time_step, std::nullopt);
    // The bar's wave takes 4.6 us to the furthest receiver (0.68 of the length at 0.977e10/0.85/2000 in m2/s2, squared speed).
    const double end = 7e-6;
    sampling.interval = 0.2 * critical_time_step;
    sampling.samples = static_cast<std::size_t>(end / sampling.interval) + 1;
  }

  Assembly assembly;
  SimulationInput input;
  double critical_time_step = 0.0;
  Sampling sampling;

 private:
  int nearest(double x, double y) const {
    const Packing& p = assembly.packing;
    int best = 0;
    const auto distance = [&](int d) { return std::hypot(p.x[d] - x, p.y[d] - y); };
    for (int d = 1; d < static_cast<int>(p.size()); ++d) best = distance(d) < distance(best) ? d : best;
    return best;
  }
};

}  // namespace ddem::test
