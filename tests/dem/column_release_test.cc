// The paper's trigger on a hexagonal lattice, rows along y, periodic in y, k_t = 0: exact until the reflection,
// u_j / A = J_2j(tau) + J_2j+2(tau) (theory section 5).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem/simulation/simulation.h"
#include "tests/support/assemblies.h"

namespace ddem {
namespace {

constexpr int kColumns = 40, kRows = 4;
constexpr double kAmplitude = 1e-9;

/// Largest error over columns 0..8 until tau = 24 (the front, 2 columns per unit of tau at most, has not come back
/// from the other end), relative to the amplitude.
double error(Direction direction, double step_fraction) {
  const Assembly a = test::hexagonal_assembly({.close_packed = packings::CloseRows::along_y,
                                               .columns = kColumns,
                                               .rows = kRows,
                                               .radius = 0.132e-3,
                                               .periodic_y = true});
  const double m = a.mass[0], k = test::kNormalStiffness;
  const double rate = std::sqrt((direction == Direction::x ? 6.0 : 2.0) * k / m);
  SimulationInput in;
  in.contact = {k, 0.0, Kinematics::linear};
  // theory section 3: 2/sqrt(6) sqrt(m/k_n) is critical.
  in.time_step = step_fraction * 2.0 / std::sqrt(6.0) * std::sqrt(m / k);
  in.steps = static_cast<long>(24.0 / (rate * in.time_step));
  auto& u0 = direction == Direction::x ? in.initial.ux : in.initial.uy;
  u0.assign(a.size(), 0.0);
  for (int row = 0; row < kRows; ++row) u0[row * kColumns] = kAmplitude;
  for (int j = 0; j <= 8; ++j) in.receivers.push_back({{kColumns + j}});

  const Signals s = simulate(a, in).signals;
  double largest = 0.0;
  for (std::size_t n = 0; n < s.time.size(); ++n) {
    const double tau = rate * s.time[n];
    for (int j = 0; j <= 8; ++j) {
      const double exact = std::cyl_bessel_j(2.0 * j, tau) + std::cyl_bessel_j(2.0 * j + 2.0, tau);
      const double ours = (direction == Direction::x ? s.ux : s.uy)[j][n] / kAmplitude;
      largest = std::max(largest, std::abs(ours - exact));
    }
  }
  return largest;
}

class ColumnRelease : public testing::TestWithParam<Direction> {};
INSTANTIATE_TEST_SUITE_P(Both, ColumnRelease, testing::Values(Direction::x, Direction::y));

TEST_P(ColumnRelease, SecondOrderInTheTimeStep) {
  const double coarse = error(GetParam(), 0.1), middle = error(GetParam(), 0.05), fine = error(GetParam(), 0.025);
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.1);
  EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.1);
  EXPECT_LT(fine, 3e-3);
  // Richardson: what second order leaves when it is taken out is fourth order.
  EXPECT_LT(std::abs(4.0 * fine - middle), 0.1 * middle);
}

}  // namespace
}  // namespace ddem
