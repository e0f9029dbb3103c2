// The roofline of numbers that are known.

#include "harness/bench/roofline.h"

#include <gtest/gtest.h>

namespace ddem::harness::bench {
namespace {

KernelTime timed(const char* law, int threads, double nanoseconds, double bytes) {
  KernelTime k;
  k.law = law;
  k.threads = threads;
  k.nanoseconds_per_bond_step = nanoseconds;
  k.bytes_per_bond = bytes;
  return k;
}

TEST(Roofline, HasALineForEachLawUnderThatOfTheMemory) {
  KernelTime per_bond = timed("DEM", 1, 3.0, 96.0);
  per_bond.per_bond_stiffness = true;  // not drawn
  KernelTime random = timed("DEM", 1, 3.0, 80.0);
  random.arrangement = Arrangement::random;
  const std::vector<KernelTime> kernels{timed("DEM", 1, 2.0, 64.0), timed("lagged", 1, 4.0, 100.0), timed("DEM", 1, 2.5, 64.0),
                                        timed("DEM", 2, 1.0, 64.0), per_bond, random};
  const reports::Figure figure = roofline_figure(kernels, {{1, 32.0}, {2, 40.0}, {4, 50.0}});
  EXPECT_NO_THROW(reports::require_valid(figure));
  ASSERT_EQ(figure.panels.size(), 3u);  // nothing was timed with four threads
  const auto& one = std::get<reports::Plot>(figure.panels[0]);
  ASSERT_EQ(one.series.size(), 3u);
  EXPECT_EQ(one.series[0].name, "DEM");
  EXPECT_EQ(one.series[0].x, (std::vector<double>{1.0 / 64.0, 1.0 / 64.0}));
  EXPECT_EQ(one.series[0].y, (std::vector<double>{0.5, 0.4}));
  EXPECT_EQ(one.series[1].y, std::vector<double>{0.25});
  const reports::Series& roof = one.series[2];
  ASSERT_EQ(roof.x.size(), 2u);
  EXPECT_LT(roof.x[0], 1.0 / 100.0);
  EXPECT_GT(roof.x[1], 1.0 / 64.0);
  // 32 GB/s of 64 bytes a bond: half a bond a nanosecond.
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(roof.y[k] / roof.x[k], 0.5 * 64.0, 1e-9);
  EXPECT_EQ(std::get<reports::Plot>(figure.panels[1]).series[0].y, std::vector<double>{1.0 / 3.0});
  EXPECT_EQ(std::get<reports::Plot>(figure.panels[2]).series[0].y, std::vector<double>{1.0});
}

}  // namespace
}  // namespace ddem::harness::bench
