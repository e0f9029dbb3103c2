#include "reports/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace ddem::reports {
namespace {

struct Step {
  long x = 0, y = 0;  // tenths of a pixel
};

std::string tenths(long n) {
  if (n % 10 == 0) return std::to_string(n / 10);
  return fmt::format("{}{}.{}", n < 0 ? "-" : "", std::labs(n) / 10, std::labs(n) % 10);
}

constexpr double kUnseen = 0.1;  // px

/// From p to the segment from a to b.
double distance(Point p, Point a, Point b) {
  const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
  const double part = square > 0.0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - part * x, p.y - a.y - part * y);
}

/// Without the points that are closer than that to what is left (Ramer 1972, Douglas and Peucker 1973): a smooth curve keeps a
/// third of those that a pixel's width has.
Polyline simplified(const Polyline& line, double tolerance) {
  std::vector<char> keep(line.size(), 0);
  keep.front() = keep.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    std::size_t furthest = begin;
    double largest = tolerance;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double d = distance(line[i], line[begin], line[end]);
      if (d > largest) furthest = i, largest = d;
    }
    if (furthest == begin) continue;
    keep[furthest] = 1;
    open.emplace_back(begin, furthest);
    open.emplace_back(furthest, end);
  }
  Polyline kept;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (keep[i] != 0) kept.push_back(line[i]);
  return kept;
}

bool same_direction(Step a, Step b) {
  return a.x * b.y == a.y * b.x && a.x * b.x + a.y * b.y > 0;
}

}  // namespace

std::string path_data(const Polyline& all, bool closed) {
  if (all.empty()) return {};
  const Polyline line = simplified(all, kUnseen);
  const auto rounded = [](Point p) { return Step{std::lround(p.x * 10.0), std::lround(p.y * 10.0)}; };
  const Step start = rounded(line.front());
  Step at = start;
  std::vector<Step> steps;
  for (const Point& p : line) {
    const Step to = rounded(p);
    const Step step{to.x - at.x, to.y - at.y};
    at = to;
    if (step.x == 0 && step.y == 0) continue;
    if (!steps.empty() && same_direction(steps.back(), step)) {
      steps.back().x += step.x;
      steps.back().y += step.y;
    } else {
      steps.push_back(step);
    }
  }
  std::string out = fmt::format("M{} {}", tenths(start.x), tenths(start.y));
  for (std::size_t i = 0; i < steps.size(); ++i)
    out.append(i == 0 ? "l" : " ").append(tenths(steps[i].x)).append(" ").append(tenths(steps[i].y));
  return closed ? out + "z" : out;
}

}  // namespace ddem::reports
