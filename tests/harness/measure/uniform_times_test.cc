// Times of recordings: uniform, nearly, resampled, or refused.

#include "harness/measure/uniform_times.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "synthetic.h"

namespace ddem::harness {
namespace {

TEST(UniformTimes, MayBeRounded) {
  std::vector<double> times;
  for (int n = 0; n < 1000; ++n) times.push_back(2e-6 + std::round(n * 1e-7 * 1e9) / 1e9);
  const CheckedTimes checked = uniform_times(times);
  ASSERT_FALSE(checked.problem);
  EXPECT_FALSE(checked.uniform.resampled);
  EXPECT_NEAR(checked.uniform.dt, 1e-7, 1e-15);
  EXPECT_EQ(checked.uniform.t0, 2e-6);
  EXPECT_EQ(checked.uniform.samples, 1000u);
}

TEST(UniformTimes, AreMadeOfOthersByCubics) {
  // Steps that grow by a half over the recording, as an adaptive program takes them.
  std::vector<double> times, values;
  for (int n = 0; n < 1000; ++n) {
    times.push_back(n + 2.5e-4 * n * n);
    values.push_back(synthetic::gaussian(times.back(), 600.0, 20.0));
  }
  const CheckedTimes checked = uniform_times(times);
  ASSERT_FALSE(checked.problem);
  EXPECT_TRUE(checked.uniform.resampled);
  EXPECT_NEAR(checked.uniform.widest_gap, 1.5, 0.01);
  const std::vector<double> out = at_uniform_times(times, values, checked.uniform);
  ASSERT_EQ(out.size(), checked.uniform.samples);
  // The cubic's error: 9/16 h^4/24 times the fourth derivative, at most 3/20^4: 4e-7 at h = 1.5.
  for (std::size_t n = 0; n < out.size(); ++n) {
    EXPECT_NEAR(out[n], synthetic::gaussian(checked.uniform.t0 + static_cast<double>(n) * checked.uniform.dt, 600.0, 20.0), 2.4e-6);
  }
}

TEST(UniformTimes, RefuseGapsAndDisorder) {
  std::vector<double> times;
  for (int n = 0; n < 100; ++n) times.push_back(n < 60 ? n : n + 10);
  EXPECT_EQ(uniform_times(times).problem->index, 60u);
  times = {0.0, 1.0, 1.0, 2.0};
  EXPECT_EQ(uniform_times(times).problem->index, 2u);
  times = {0.0, 1.0, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(uniform_times(times).problem->index, 2u);
  EXPECT_TRUE(uniform_times(std::vector<double>{1.0}).problem);
}

}  // namespace
}  // namespace ddem::harness
