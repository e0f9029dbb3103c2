#include "harness/calibrate/confidence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ddem::harness {
namespace {

/// Tables of the t distribution, three decimals.
TEST(StudentT, IsThatOfTheTables) {
  struct Row {
    int freedom;
    double t95, t99;
  };
  for (const Row& row : {Row{1, 12.706, 63.657}, Row{2, 4.303, 9.925}, Row{3, 3.182, 5.841},
                         Row{4, 2.776, 4.604}, Row{5, 2.571, 4.032}, Row{7, 2.365, 3.499},
                         Row{10, 2.228, 3.169}, Row{30, 2.042, 2.750}, Row{120, 1.980, 2.617}}) {
    EXPECT_NEAR(student_t(0.95, row.freedom), row.t95, 5.1e-4) << row.freedom;
    EXPECT_NEAR(student_t(0.99, row.freedom), row.t99, 5.1e-4) << row.freedom;
  }
}

TEST(MeanWithConfidence, OfAKnownSample) {
  // Mean 4, squares 4 + 0 + 4, s = 2, t_2 = 4.303: 4.303 * 2/sqrt(3) = 4.968.
  const MeanWithConfidence m = mean_with_confidence({2.0, 4.0, 6.0});
  EXPECT_DOUBLE_EQ(m.mean, 4.0);
  EXPECT_DOUBLE_EQ(m.stddev, 2.0);
  EXPECT_NEAR(m.half_width, 4.968, 1e-3);
  EXPECT_LT(mean_with_confidence({2.0}).half_width, 0.0);  // none
}

}  // namespace
}  // namespace ddem::harness
