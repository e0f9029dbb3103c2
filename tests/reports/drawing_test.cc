// Clipping, decimation, path data, colours, placement of labels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "reports/color.h"
#include "reports/decimate.h"
#include "reports/geometry.h"
#include "reports/label_placer.h"
#include "reports/path.h"

namespace ddem::reports {
namespace {

constexpr Rect kBox{10, 20, 100, 50};

TEST(Clip, SegmentThroughTheBoxKeepsItsLine) {
  const auto s = clip_segment({{0, 20}, {120, 80}}, kBox);  // y = 20 + x/2
  ASSERT_TRUE(s);
  EXPECT_DOUBLE_EQ(s->first.x, 10);
  EXPECT_DOUBLE_EQ(s->first.y, 25);
  EXPECT_DOUBLE_EQ(s->second.x, 100);
  EXPECT_DOUBLE_EQ(s->second.y, 70);
  EXPECT_FALSE(clip_segment({{0, 0}, {200, 10}}, kBox));
  EXPECT_FALSE(clip_segment({{5, 0}, {5, 100}}, kBox));
}

TEST(Clip, PolylineThatLeavesAndReturnsIsTwoPieces) {
  const auto pieces = clip_polyline({{20, 30}, {30, 100}, {50, 100}, {60, 30}}, kBox);
  ASSERT_EQ(pieces.size(), 2u);
  for (const Polyline& piece : pieces)
    for (const Point& p : piece) EXPECT_TRUE(kBox.contains(p));
  EXPECT_DOUBLE_EQ(pieces[0].back().y, 70);
}

TEST(Clip, PolygonAroundTheBoxBecomesTheBox) {
  const Polyline cut = clip_polygon({{-1000, -1000}, {1000, -1000}, {1000, 1000}, {-1000, 1000}}, kBox);
  double twice_area = 0.0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const Point a = cut[i], b = cut[(i + 1) % cut.size()];
    twice_area += a.x * b.y - b.x * a.y;
  }
  EXPECT_DOUBLE_EQ(std::abs(twice_area) / 2, kBox.width * kBox.height);
  EXPECT_TRUE(clip_polygon({{0, 0}, {5, 0}, {5, 5}}, kBox).empty());
}

TEST(Decimate, KeepsTheExtremaOfEveryColumnExactly) {
  Polyline line;
  for (int i = 0; i < 100000; ++i) line.push_back({i * 0.005, std::sin(i * 0.37) * std::cos(i * 1e-4)});
  line[54321].y = 7.0;   // a peak of a single sample
  line[77777].y = -5.0;  // and a trough
  const Polyline kept = decimate(line, 1.0);
  EXPECT_LE(kept.size(), 4u * 500u);
  const auto by_y = [](Point a, Point b) { return a.y < b.y; };
  for (int column = 0; column < 500; ++column) {
    const auto in_column = [&](Point p) { return std::floor(p.x) == column; };
    Polyline all, few;
    std::copy_if(line.begin(), line.end(), std::back_inserter(all), in_column);
    std::copy_if(kept.begin(), kept.end(), std::back_inserter(few), in_column);
    ASSERT_FALSE(few.empty());
    EXPECT_EQ(std::max_element(all.begin(), all.end(), by_y)->y,
              std::max_element(few.begin(), few.end(), by_y)->y);
    EXPECT_EQ(std::min_element(all.begin(), all.end(), by_y)->y,
              std::min_element(few.begin(), few.end(), by_y)->y);
  }
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end(), [](Point a, Point b) { return a.x < b.x; }));
}

TEST(Decimate, LeavesSparseLinesAlone) {
  const Polyline line = {{0.5, 3}, {4, 1}, {9, 2}};
  EXPECT_EQ(decimate(line, 1.0).size(), 3u);
  EXPECT_TRUE(decimate({}, 1.0).empty());
}

/// A sine of 100 px height and 80 px length: curvature (2 pi / 80)^2 100 = 0.62 / px at its crests, where chords of c px miss it
/// by 0.62 c^2 / 8. A tenth of a pixel allows 1.1 px there, and more elsewhere: of five samples a pixel less than one is left.
TEST(Path, LeavesOutWhatNobodySees) {
  Polyline wave;
  for (int i = 0; i <= 2000; ++i) wave.push_back({0.2 * i, 200.0 - 100.0 * std::sin(0.2 * i * 2.0 * std::numbers::pi / 80.0)});
  std::string text = path_data(wave);
  std::replace_if(text.begin(), text.end(), [](char c) { return c == 'M' || c == 'l'; }, ' ');
  std::istringstream numbers(text);
  Polyline line;
  Point at;
  for (double x = 0.0, y = 0.0; numbers >> x >> y;) {
    at = {at.x + x, at.y + y};
    line.push_back(at);
  }
  EXPECT_LT(line.size(), 450u);
  std::size_t k = 0;
  for (const Point& p : wave) {
    while (k + 2 < line.size() && line[k + 1].x < p.x) ++k;
    const Point a = line[k], b = line[k + 1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    // 0.1, and both ends rounded to tenths.
    EXPECT_LT(std::abs((p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x)) / length, 0.1 + 0.05 * std::sqrt(2.0));
  }
}

TEST(Path, IsRelativeRoundedAndShort) {
  EXPECT_EQ(path_data({{1, 2}, {2.04, 2}, {2.04, 1.5}}), "M1 2l1 0 0 -0.5");
  EXPECT_EQ(path_data({{0, 0}, {1, 1}, {2, 2}, {3, 3}}), "M0 0l3 3");  // straight
  EXPECT_EQ(path_data({{0, 0}, {2, 0}, {1, 0}}), "M0 0l2 0 -1 0");     // turns back: kept
  EXPECT_EQ(path_data({{0, 0}, {1, 0}, {0, 1}}, true), "M0 0l1 0 -1 1z");
  EXPECT_EQ(path_data({}), "");
}

TEST(Path, RoundingDoesNotAddUp) {
  Polyline line;
  for (int i = 0; i <= 1000; ++i) line.push_back({i * 0.333, i % 2 * 0.26});
  const std::string data = path_data(line);
  double x = 0.0, dx = 0.0, dy = 0.0;
  const char* at = data.c_str() + data.find('l') + 1;
  for (int used = 0; std::sscanf(at, "%lf %lf%n", &dx, &dy, &used) == 2; at += used) x += dx;
  EXPECT_NEAR(x, 333.0, 0.05 + 1e-9);
}

// CIE 1976 lightness of an sRGB colour.
double lightness(Rgb c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y =
      0.2126 * linear(c[0] / 255.0) + 0.7152 * linear(c[1] / 255.0) + 0.0722 * linear(c[2] / 255.0);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(Viridis, LightnessRisesEvenly) {
  const double first = lightness(viridis(0.0)), last = lightness(viridis(1.0));
  EXPECT_GT(last - first, 70.0);
  for (int i = 1; i <= 16; ++i) {
    const double step = lightness(viridis(i / 16.0)) - lightness(viridis((i - 1) / 16.0));
    // The published map is uniform in CAM02-UCS; in L* its steps differ from the mean by less than a third.
    EXPECT_NEAR(step, (last - first) / 16.0, (last - first) / 16.0 / 3.0) << i;
  }
}

TEST(Viridis, ClampsItsArgument) {
  EXPECT_EQ(hex(viridis(-1.0)), "#440154");
  EXPECT_EQ(hex(viridis(2.0)), "#fde725");
  EXPECT_EQ(hex(viridis(std::numeric_limits<double>::quiet_NaN())), "#440154");
}

TEST(LabelPlacer, AvoidsLinesAndOtherLabels) {
  LabelPlacer placer;
  placer.add_obstacle({{0, 5}, {200, 5}});
  const std::vector<Rect> candidates = {{0, 0, 50, 10}, {0, 20, 50, 10}, {100, 20, 50, 10}};
  EXPECT_EQ(placer.place(candidates).top, 20);
  EXPECT_EQ(placer.place(candidates).left, 100);
  EXPECT_EQ(placer.place(candidates).top, 0);  // a line is better than another label
}

}  // namespace
}  // namespace ddem::reports
