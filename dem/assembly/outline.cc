#include "dem/assembly/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "dem/assembly/neighbour_grid.h"

namespace ddem {
namespace {

constexpr double kLeastSpacings = 4.0, kRampSpacings = 24.0;

double extent(const std::vector<double>& centre, const std::vector<double>& radius) {
  double lo = HUGE_VAL, hi = -HUGE_VAL;
  for (std::size_t d = 0; d < centre.size(); ++d) {
    lo = std::min(lo, centre[d] - radius[d]);
    hi = std::max(hi, centre[d] + radius[d]);
  }
  return hi - lo;
}

double wrapped(double angle, double from) {
  const double turn = 2.0 * std::numbers::pi, rest = std::fmod(angle - from, turn);
  return from + (rest < 0.0 ? rest + turn : rest);
}

/// A ball on the outside of the discs' centres, rolling around them counterclockwise.
class RollingBall {
 public:
  explicit RollingBall(const Packing& p)
      : p_(p), radius_(kBall * *std::max_element(p.radius.begin(), p.radius.end())), grid_(p, 2.0 * radius_) {}

  /// Centres that it touches one after the other, from the leftmost on, once around.
  std::vector<int> path() const {
    std::vector<int> path = {static_cast<int>(std::min_element(p_.x.begin(), p_.x.end()) - p_.x.begin())};
    double side = std::numbers::pi;  // where the ball lies, seen from the centre that it rolls over
    int second = -1;
    while (path.size() <= 4 * p_.size()) {
      const int at = path.back(), next = touched(at, side);
      if (next < 0) return path;
      if (at == path.front() && next == second) {
        path.pop_back();
        return path;
      }
      if (path.size() == 1) second = next;
      side = std::atan2(p_.y[at] + radius_ * std::sin(side) - p_.y[next], p_.x[at] + radius_ * std::cos(side) - p_.x[next]);
      path.push_back(next);
    }
    return {};
  }

 private:
  /// In diameters of the largest disc a little more than one: over no gap between neighbours does it fall in, and it touches no
  /// three discs of a lattice at once.
  static constexpr double kBall = 2.17;

  /// The first one that it meets as it rolls on; `side` becomes where it lies then.
  int touched(int at, double& side) const {
    int first = -1;
    double least = HUGE_VAL;
    grid_.for_each_candidate(p_.x[at], p_.y[at], [&](int d) {
      const double dx = p_.x[d] - p_.x[at], dy = p_.y[d] - p_.y[at], distance = std::hypot(dx, dy);
      if (d == at || distance >= 2.0 * radius_) return;
      // Less the angle that round-off of the last touch leaves.
      const double angle = wrapped(std::atan2(dy, dx) - std::acos(distance / (2.0 * radius_)), side - 1e-9);
      if (angle >= least) return;
      least = angle;
      first = d;
    });
    side = least;
    return first;
  }

  const Packing& p_;
  double radius_;
  NeighbourGrid grid_;
};

}  // namespace

std::optional<double> density_along(std::span<const double> coordinate, std::span<const double> weight, double spacing) {
  const auto [lo, hi] = std::minmax_element(coordinate.begin(), coordinate.end());
  const double span = *hi - *lo;
  if (!(span >= kLeastSpacings * spacing)) return std::nullopt;
  // Both ends are a step smoothed by a Gaussian of deviation ramp/(2 k), cut off at k deviations: what is cut off and the
  // Gaussian's own part of the period d are alike at k^2 = pi ramp/d.
  const double ramp = std::min(0.5 * span, kRampSpacings * spacing), k = std::sqrt(std::numbers::pi * ramp / spacing);
  const auto step = [&](double x) { return 0.5 * std::erfc(-std::numbers::sqrt2 * k * (x / ramp - 0.5)); };
  double sum = 0.0;
  for (std::size_t d = 0; d < coordinate.size(); ++d) sum += weight[d] * step(coordinate[d] - *lo) * step(*hi - coordinate[d]);
  return sum / (span - ramp);
}

std::optional<double> enclosed_fraction(const Packing& p) {
  if (p.size() < 3) return std::nullopt;
  const std::vector<int> path = RollingBall(p).path();
  const std::size_t n = path.size();
  if (n < 3) return std::nullopt;
  double area = 0.0, discs = 0.0;
  for (const double r : p.radius) discs += std::numbers::pi * r * r;
  std::vector<char> on_path(p.size(), 0);
  for (std::size_t k = 0; k < n; ++k) {
    const int before = path[(k + n - 1) % n], at = path[k], after = path[(k + 1) % n];
    const double ax = p.x[at] - p.x[before], ay = p.y[at] - p.y[before], bx = p.x[after] - p.x[at], by = p.y[after] - p.y[at];
    area += 0.5 * ((p.x[at] - p.x[path[0]]) * by - (p.y[at] - p.y[path[0]]) * bx);
    // At the tip of what sticks out it turns back, to the left.
    const double left = std::atan2(ax * by - ay * bx, ax * bx + ay * by);
    const double inner = std::numbers::pi - (left < 1e-9 - std::numbers::pi ? std::numbers::pi : left);
    discs += 0.5 * inner * p.radius[at] * p.radius[at];
    if (!on_path[at]) discs -= std::numbers::pi * p.radius[at] * p.radius[at];
    on_path[at] = 1;
  }
  if (!(area > 0.0) || discs > area) return std::nullopt;
  return discs / area;
}

Outline outline_of(const Packing& p, std::optional<double> length, std::optional<double> width) {
  std::vector<double> area;
  for (const double r : p.radius) area.push_back(std::numbers::pi * r * r);
  const double total = std::accumulate(area.begin(), area.end(), 0.0);
  if (!length) {
    const auto along = density_along(p.x, area, 2.0 * mean_radius(p));
    length = along ? total / *along : extent(p.x, p.radius);
  }
  if (!width) {
    const auto fraction = enclosed_fraction(p);
    width = fraction ? total / (*fraction * *length) : extent(p.y, p.radius);
  }
  return {*length, *width};
}

}  // namespace ddem
