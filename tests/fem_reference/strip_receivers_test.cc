// Receivers between the nodes: exact for the polynomials that they interpolate, averages for sections.

#include "fem_reference/strip_receivers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "fem_reference/kernel/gauss_lobatto.h"

namespace ddem::fem {
namespace {

using std::numbers::pi;

double value(const StripGrid& grid, const NodeWeights& weights, const std::function<double(double, double)>& f) {
  const GaussLobatto rule = gauss_lobatto(grid.degree);
  const unsigned p = static_cast<unsigned>(grid.degree), rows = grid.ny * p + (grid.periodic ? 0 : 1);
  double sum = 0.0;
  for (const auto& [node, weight] : weights) {
    const unsigned column = node / rows, row = node % rows;
    sum += weight * f(column / p + rule.points[column % p], row / p + rule.points[row % p]);
  }
  return sum;
}

class StripReceivers : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Degrees, StripReceivers, testing::Range(1, max_degree + 1));

TEST_P(StripReceivers, AreExactForPolynomials) {
  const int p = GetParam(), beyond = (p + 1) / 2;
  const StripGrid grid{5, 4, p, false};
  for (const double x : {0.0, 0.4, 1.0, 1.3, 2.77, 3.999, 4.2, 5.0}) {
    // Of the element's degree at the ends, of that of its neighbours' nodes in addition inside; the power's slope
    // times round-off.
    const int power = x >= 1.0 && x < 4.0 ? p + 2 * beyond : p;
    const auto f = [&](double s, double y) { return std::pow((s - 2.5) / 2.5, power) * (1.0 + std::pow(y / 4.0, p)); };
    for (const double y : {0.0, 0.9, 1.0, 2.2, 4.0}) {
      EXPECT_NEAR(value(grid, at_point(grid, x, y), f), f(x, y), 1e-13) << x << " " << y;
    }
    const double average = std::pow((x - 2.5) / 2.5, power) * (1.0 + 1.0 / (p + 1));
    EXPECT_NEAR(value(grid, at_section(grid, x), f), average, 1e-13) << x;
  }
}

TEST_P(StripReceivers, SeeANodeAlone) {
  const StripGrid grid{6, 3, GetParam(), false};
  for (const double x : {0.0, 3.0, 6.0}) {
    const NodeWeights weights = at_point(grid, x, 2.0);
    ASSERT_EQ(weights.size(), 1u);
    EXPECT_EQ(weights[0].second, 1.0);
  }
}

TEST_P(StripReceivers, WrapAroundPeriodicEdges) {
  const StripGrid grid{4, 6, GetParam(), true};
  const auto f = [](double, double y) { return std::cos(2.0 * pi * y / 6.0); };
  for (const double y : {0.1, 3.3, 5.9}) {
    // Interpolation of degree p + 2 m over a sixth of a wave and its surroundings; at p = 1 four points.
    const double tolerance = GetParam() == 1 ? 0.05 : GetParam() == 2 ? 3e-3 : 3e-4;
    EXPECT_NEAR(value(grid, at_point(grid, 1.6, y), f), f(0.0, y), tolerance) << y;
  }
  EXPECT_NEAR(value(grid, at_section(grid, 1.6), [](double, double) { return 1.0; }), 1.0, 1e-14);
}

}  // namespace
}  // namespace ddem::fem
