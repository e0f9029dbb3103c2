// Whole commands timed as programs of their own; growth of numbers that are known.

#include "harness/bench/scaling.h"

#include <gtest/gtest.h>

#include "harness/bench/scaling_figure.h"
#include "tests/support/sanitized.h"

namespace ddem::harness::bench {
namespace {

TEST(Scaling, EveryCommandIsMeasuredAtEverySize) {
  if (ddem::test::kSanitized) GTEST_SKIP() << "times and memory are those of the sanitizers";
  const ScalingPlan plan{{200, 800}, 60.0};
  std::size_t heard = 0;
  const std::vector<ScalingPoint> points = measure_scaling(plan, [&] { ++heard; });
  EXPECT_EQ(heard, scaling_work(plan));
  ASSERT_EQ(points.size(), scaling_work(plan));
  for (const ScalingPoint& p : points) {
    EXPECT_EQ(p.status, "ok") << p.task << " " << p.discs;
    EXPECT_GT(p.seconds, 1e-3) << p.task;
    EXPECT_TRUE(p.bytes > 4e6 && p.bytes < 1e9) << p.task << " " << p.bytes;
  }
  EXPECT_NO_THROW(reports::require_valid(scaling_figure(points)));
}

TEST(Scaling, LeavesOutWhatWouldTakeTooLong) {
  const std::vector<ScalingPoint> points = measure_scaling({{100, 200}, 1e-6}, [] {});
  for (const ScalingPoint& p : points) {
    if (p.discs == 200) {
      EXPECT_EQ(p.status, "would take more than 0 s") << p.task;
    }
  }
}

TEST(Scaling, GrowthIsThePowerOfTheDiscs) {
  const ScalingPoint a{"pack", Arrangement::random, 1000, 2.0, 3e7, "ok"}, b{"pack", Arrangement::random, 10000, 2.0 * 31.622776601683793, 3e8, "ok"};
  EXPECT_NEAR(growth(a, b, &ScalingPoint::seconds).value(), 1.5, 1e-12);
  EXPECT_NEAR(growth(a, b, &ScalingPoint::bytes).value(), 1.0, 1e-12);
  ScalingPoint failed = b;
  failed.status = "would take more than 120 s";
  EXPECT_FALSE(growth(a, failed, &ScalingPoint::seconds));
  EXPECT_FALSE(growth(failed, b, &ScalingPoint::seconds));

  const ScalingPoint other{"moduli", Arrangement::random, 10000, 1.0, 1e8, "ok"};
  const reports::Table table = scaling_table({a, other, b, failed});
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_NEAR(std::get<double>(table.rows[2][4].value), 1.5, 1e-12);
  const reports::Figure figure = scaling_figure({a, other, b, failed});
  const auto& time = std::get<reports::Plot>(figure.panels[0]);
  ASSERT_EQ(time.series.size(), 2u);
  EXPECT_EQ(time.series[0].y, (std::vector<double>{a.seconds, b.seconds}));
}

}  // namespace
}  // namespace ddem::harness::bench
