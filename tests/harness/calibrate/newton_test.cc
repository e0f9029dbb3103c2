#include "harness/calibrate/newton.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ddem::harness {
namespace {

TEST(BracketedNewton, FindsRootsWhereNewtonAloneIsLost) {
  int evaluations = 0;
  // The tangents of atan lead away beyond 1.39, those of a cube root from everywhere.
  const auto arctangent = [&](double x) {
    return ++evaluations, ValueAndSlope{std::atan(x - 0.3), 1.0 / (1.0 + (x - 0.3) * (x - 0.3))};
  };
  const BracketedRoot a =
      bracketed_newton(arctangent, {-1000.0, std::atan(-1000.3)}, {3.0, std::atan(2.7)}, 1e-14);
  EXPECT_NEAR(a.x, 0.3, 1e-13);
  EXPECT_LT(evaluations, 30);  // bisection of 1003 down to 1e-13 takes 53
  const auto cube_root = [](double x) {
    return ValueAndSlope{std::cbrt(x - 0.3), 1.0 / (3.0 * std::pow(std::cbrt(x - 0.3), 2))};
  };
  EXPECT_NEAR(bracketed_newton(cube_root, {-1.0, std::cbrt(-1.3)}, {5.0, std::cbrt(4.7)}, 1e-9).x, 0.3,
              1e-15);
}

TEST(BracketedNewton, IsQuadraticNearARoot) {
  int evaluations = 0;
  const auto square = [&](double x) { return ++evaluations, ValueAndSlope{x * x - 2.0, 2.0 * x}; };
  EXPECT_NEAR(bracketed_newton(square, {1.0, -1.0}, {2.0, 2.0}, 1e-13).x, std::sqrt(2.0), 1e-13);
  EXPECT_LE(evaluations, 5);  // first guess 4/3 is off by 0.08: errors of 2e-3, 2e-6, 1e-12, 0
}

TEST(BracketedNewton, TakesAnEndThatIsARoot) {
  const auto never = [](double) -> ValueAndSlope { throw std::logic_error("evaluated"); };
  EXPECT_EQ(bracketed_newton(never, {1.0, 0.0}, {2.0, 5.0}, 1e-12).x, 1.0);
  EXPECT_EQ(bracketed_newton(never, {1.0, -1.0}, {2.0, 1e-13}, 1e-12).x, 2.0);
  EXPECT_THROW(bracketed_newton(never, {1.0, 1.0}, {2.0, 2.0}, 1e-12), std::invalid_argument);
}

}  // namespace
}  // namespace ddem::harness
