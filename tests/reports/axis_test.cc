// Limits, transforms, ticks and their labels, against values worked out by hand.
#include "reports/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reports/ticks.h"

namespace ddem::reports {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::vector<std::string> labels(const AxisMarks& marks) {
  std::vector<std::string> out;
  for (const Tick& t : marks.ticks) out.push_back(t.label);
  return out;
}

using Strings = std::vector<std::string>;

TEST(Ticks, AreMultiplesOfOneTwoOrFive) {
  // Equal, not near: a tick at 0.30000000000000004 would print so in the data.
  EXPECT_EQ(linear_ticks({0.0, 1.0}, 10).values,
            (std::vector<double>{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}));
  EXPECT_EQ(linear_ticks({0.0, 1.0}, 5).values, (std::vector<double>{0.0, 0.2, 0.4, 0.6, 0.8, 1.0}));
  EXPECT_EQ(linear_ticks({-3.0, 12.0}, 4).values, (std::vector<double>{0.0, 5.0, 10.0}));
  EXPECT_EQ(linear_ticks({1.3e-6, 8.7e-6}, 4).values, (std::vector<double>{2e-6, 4e-6, 6e-6, 8e-6}));
}

TEST(Ticks, AreWithinTheLimitsAndFewForAnyRange) {
  for (const Limits limits : {Limits{-1e300, 1e300}, Limits{1e-290, 3e-290}, Limits{1e9, 1e9 + 1.0},
                              Limits{-0.037, 0.0021}, Limits{1e300, 1.0000001e300}}) {
    for (const int count : {1, 3, 8, 15}) {
      const std::vector<double> ticks = linear_ticks(limits, count).values;
      EXPECT_LE(ticks.size(), static_cast<std::size_t>(count) + 1) << limits.lower << " " << count;
      for (const double t : ticks) EXPECT_TRUE(t >= limits.lower && t <= limits.upper) << t;
    }
  }
}

TEST(Ticks, LogarithmicOnesAreDecadesOrWithinOne) {
  EXPECT_EQ(log_ticks({1e-3, 1e3}, 7).values.size(), 7u);
  EXPECT_NEAR(log_ticks({1e-3, 1e3}, 7).values[1], 1e-2, 1e-17);
  EXPECT_EQ(log_ticks({1e-12, 1.0}, 5).values.size(), 5u);  // 13 decades, every third
  EXPECT_EQ(log_ticks({0.9, 60.0}, 5).values, (std::vector<double>{1, 2, 5, 10, 20, 50}));
  EXPECT_EQ(log_ticks({0.95, 1.35}, 4).values, (std::vector<double>{1.0, 1.1, 1.2, 1.3}));
}

TEST(Axis, LabelsUseSiPrefixes) {
  const AxisMarks time = axis_marks({.label = "time", .unit = "s"}, {0.0, 2e-5}, 4);
  EXPECT_EQ(labels(time), (Strings{"0", "5", "10", "15", "20"}));
  EXPECT_EQ(time.title, "time (µs)");
  EXPECT_EQ(axis_marks({.unit = "Pa"}, {0.0, 4e10}, 4).title, "GPa");
  EXPECT_EQ(axis_marks({.label = "c", .unit = "m/s"}, {0.0, 2500.0}, 5).title, "c (m/s)");
  const AxisMarks length = axis_marks({.label = "x", .unit = "m"}, {0.0, 0.0165}, 4);
  EXPECT_EQ(labels(length), (Strings{"0", "5", "10", "15"}));
  EXPECT_EQ(length.title, "x (mm)");
}

TEST(Axis, LabelsOfOtherUnitsUsePowersOfTen) {
  const AxisMarks drift = axis_marks({.label = "drift"}, {0.0, 5e-14}, 5);
  EXPECT_EQ(drift.title, "drift (×10⁻¹⁴)");
  EXPECT_EQ(labels(drift), (Strings{"0", "1", "2", "3", "4", "5"}));
  EXPECT_EQ(axis_marks({.label = "rho", .unit = "kg/m3"}, {0.0, 2e6}, 4).title, "rho (10⁶ kg/m3)");
}

TEST(Axis, LabelsHaveTheDigitsOfTheStepAndATrueMinus) {
  EXPECT_EQ(labels(axis_marks({}, {-0.1, 0.1}, 4)), (Strings{"−0.10", "−0.05", "0.00", "0.05", "0.10"}));
  const Strings close = labels(axis_marks({}, {1.0, 1.0004}, 4));
  EXPECT_EQ(close, (Strings{"1.0000", "1.0001", "1.0002", "1.0003", "1.0004"}));
  EXPECT_EQ(labels(axis_marks({.scale = Scale::log}, {1e-6, 1.0}, 7)),
            (Strings{"10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "0.01", "0.1", "1"}));
}

TEST(Axis, LabelsAlongNarrowAxesDoNotTouch) {
  for (const double width : {40.0, 90.0, 200.0, 700.0}) {
    const AxisMarks marks = axis_marks_along({.label = "x"}, {1234567.1, 1234567.9}, width);
    EXPECT_TRUE(marks.ticks.size() <= 2 ||
                marks.label_width * static_cast<double>(marks.ticks.size()) <= width)
        << width;
  }
}

TEST(Axis, TransformsLinearAndLogarithmic) {
  const AxisScale linear(Scale::linear, {-1.0, 3.0}, 100.0, 500.0);
  EXPECT_DOUBLE_EQ(linear.pixel(-1.0), 100.0);
  EXPECT_DOUBLE_EQ(linear.pixel(0.0), 200.0);
  EXPECT_DOUBLE_EQ(linear.pixel(3.0), 500.0);
  const AxisScale log(Scale::log, {1e-2, 1e2}, 400.0, 0.0);  // upwards: pixels fall
  EXPECT_DOUBLE_EQ(log.pixel(1.0), 200.0);
  EXPECT_DOUBLE_EQ(log.pixel(10.0), 100.0);
  EXPECT_FALSE(log.drawable(0.0));
  EXPECT_FALSE(log.drawable(-1.0));
  EXPECT_FALSE(linear.drawable(kNan));
  EXPECT_FALSE(linear.drawable(-kInf));
  EXPECT_TRUE(std::isfinite(linear.pixel(1e300)));
}

Limits limits_of(std::vector<double> values, Scale scale, double padding) {
  Extent extent(scale);
  for (const double v : values) extent.add(v);
  return extent.padded(padding);
}

TEST(Extent, HoldsWhatIsDrawableAndIsNeverDegenerate) {
  const Limits plain = limits_of({2.0, kNan, -1.0, kInf, 1.0}, Scale::linear, 0.1);
  EXPECT_DOUBLE_EQ(plain.lower, -1.3);
  EXPECT_DOUBLE_EQ(plain.upper, 2.3);
  const Limits log = limits_of({0.0, 1.0, 100.0, -5.0}, Scale::log, 0.5);
  EXPECT_NEAR(log.lower, 0.1, 1e-14);
  EXPECT_NEAR(log.upper, 1000.0, 1e-10);
  for (const Scale scale : {Scale::linear, Scale::log})
    for (const std::vector<double>& values : {std::vector<double>{},
                                              {7.0},
                                              {0.0, 0.0},
                                              {-4.0, -4.0},
                                              {kNan},
                                              {1e300, -1e300},
                                              {1e-300, 1e300},
                                              {1.0, 1.0 + 1e-15},
                                              {5e-324, 0.0},
                                              {1.7e308}}) {
      const Limits l = limits_of(values, scale, 0.05);
      EXPECT_TRUE(std::isfinite(l.lower) && std::isfinite(l.upper) && l.lower < l.upper);
      EXPECT_TRUE(scale == Scale::linear || l.lower > 0.0);
      EXPECT_FALSE(axis_marks({.scale = scale}, l, 5).ticks.empty());
    }
}

}  // namespace
}  // namespace ddem::reports
