#include "reports/path.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
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

bool same_direction(Step a, Step b) {
  return a.x * b.y == a.y * b.x && a.x * b.x + a.y * b.y > 0;
}

}  // namespace

std::string path_data(const Polyline& line, bool closed) {
  if (line.empty()) return {};
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
