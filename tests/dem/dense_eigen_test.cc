#include "dem/spectra/dense_eigen.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ddem {
namespace {

constexpr double kRoundOff = 1e-13;

// Normal equations by hand: the line through (0, 1), (1, 3), (2, 4), (3, 4) is 1.5 + t.
TEST(LeastSquares, IsTheLineThroughPoints) {
  Eigen::MatrixXd a(4, 2), b(4, 2);
  a << 1, 0, 1, 1, 1, 2, 1, 3;
  b << 1, 2, 3, 6, 4, 8, 4, 8;
  const Eigen::MatrixXd x = least_squares(a, b);
  for (int column = 0; column < 2; ++column) {
    EXPECT_NEAR(x(0, column), 1.5 * (column + 1), kRoundOff);
    EXPECT_NEAR(x(1, column), 1.0 * (column + 1), kRoundOff);
  }
}

// x + 2 y = 5 twice over: of all solutions the nearest to the origin lies along (1, 2). And of no equation for y: y = 0.
TEST(LeastSquares, OfSeveralTheSmallest) {
  Eigen::MatrixXd a(2, 2), b(2, 1);
  a << 1, 2, 2, 4;
  b << 5, 10;
  EXPECT_LT((least_squares(a, b) - Eigen::Vector2d(1.0, 2.0)).norm(), kRoundOff);
  a << 3, 0, 4, 0;
  b << 6, 8;
  EXPECT_LT((least_squares(a, b) - Eigen::Vector2d(2.0, 0.0)).norm(), kRoundOff);
}

TEST(Hessenberg, IsTheMatrixInAnotherBasis) {
  Eigen::MatrixXd a(5, 5);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) a(i, j) = std::cos(1.0 + 3.0 * i + 7.0 * j * j);
  }
  const auto [form, basis] = hessenberg(a);
  EXPECT_LT((product(product(basis, form), basis.transpose()) - a).norm(), kRoundOff);
  EXPECT_LT((product(basis, basis.transpose()) - Eigen::MatrixXd::Identity(5, 5)).norm(), kRoundOff);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j + 1 < i; ++j) EXPECT_EQ(form(i, j), 0.0);
  }
}

}  // namespace
}  // namespace ddem
