// The paper's wave run to the last peak against dense modal analysis of the whole strip: 2046 degrees of
// freedom.

#include <gtest/gtest.h>

#include <cmath>

#include "dem/simulation/exact.h"
#include "tests/support/dense_modes.h"
#include "tests/support/wave_strip.h"

namespace ddem {
namespace {

TEST(ExactStrip, ReleasedColumnIsThatOfTheDenseModes) {
  test::WaveStrip strip(0.25);
  strip.sampling = {4.17 * strip.critical_time_step,
                    static_cast<std::size_t>(7e-6 / (4.17 * strip.critical_time_step)) + 1};
  const SimulationResult r = simulate_exact(strip.assembly, strip.input, strip.sampling);
  const test::DenseModes modes(strip.assembly, strip.input.contact, {}, strip.input.held);
  EXPECT_NEAR(modes.largest_frequency() * strip.critical_time_step, 2.0, 1e-5);
  const Eigen::VectorXd start = modes.unknowns(strip.input.initial.ux, {}, {});
  double size = 0.0, worst = 0.0;
  for (std::size_t n = 0; n < strip.sampling.samples; ++n) {
    const double t = r.signals.time[n];
    const Eigen::VectorXd q = modes.apply([t](double w) { return std::cos(w * t); }, start);
    for (std::size_t k = 0; k < strip.input.receivers.size(); ++k) {
      const int d = strip.input.receivers[k].discs[0];
      size = std::max(size, std::abs(modes.displacement(q, d, 0)));
      worst = std::max({worst, std::abs(r.signals.ux[k][n] - modes.displacement(q, d, 0)),
                        std::abs(r.signals.uy[k][n] - modes.displacement(q, d, 1))});
    }
  }
  EXPECT_GT(size, 1e-9);  // a tenth of the amplitude has arrived
  // As in exact_test.cc.
  EXPECT_LT(worst, 1e-10 * size);
}

}  // namespace
}  // namespace ddem
