#include "dem/assembly/packing_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "dem/assembly/neighbour_grid.h"

namespace ddem {
namespace {

constexpr std::size_t kListed = 10;

/// Problems of one kind: keeps the first few, and knows when further search is useless.
class Listing {
 public:
  bool full() const { return problems_.size() >= kListed; }
  void add(std::string problem) {
    if (!full()) problems_.push_back(std::move(problem));
  }
  void append_to(std::vector<std::string>& all) const {
    all.insert(all.end(), problems_.begin(), problems_.end());
    if (full()) all.emplace_back("... and more");
  }

 private:
  std::vector<std::string> problems_;
};

std::vector<std::string> bad_periods(const Packing& packing) {
  std::vector<std::string> problems;
  for (const auto& [period, direction] : {std::pair(packing.period.x, "x"), std::pair(packing.period.y, "y")})
    if (!std::isfinite(period) || period < 0.0)
      problems.push_back(
          fmt::format("the period in {} must be positive (0: not periodic), but is {} m", direction, period));
  return problems;
}

/// Periods that leave room for a second image of a pair that touches.
std::vector<std::string> short_periods(const Packing& packing) {
  const double largest = *std::max_element(packing.radius.begin(), packing.radius.end());
  std::vector<std::string> problems;
  for (const auto& [period, direction] : {std::pair(packing.period.x, "x"), std::pair(packing.period.y, "y")})
    if (period > 0.0 && period <= 4.0 * largest)
      problems.push_back(
          fmt::format("the period in {}, {:.6g} m, must be longer than two diameters of the largest disc, "
                      "{:.6g} m: discs could "
                      "touch through two images",
                      direction, period, 4.0 * largest));
  return problems;
}

/// Allowed distance from the origin, so that the nearest image keeps its digits.
bool usable(double centre, double period) {
  return std::isfinite(centre) && !(period > 0.0 && std::abs(centre) > 1e12 * period);
}

Listing bad_discs(const Packing& packing) {
  Listing bad;
  for (std::size_t i = 0; i < packing.size() && !bad.full(); ++i) {
    const double x = packing.x[i], y = packing.y[i], radius = packing.radius[i];
    if (!usable(x, packing.period.x) || !usable(y, packing.period.y))
      bad.add(fmt::format("disc {}: its centre ({}, {}) is not a usable position", i, x, y));
    if (!std::isfinite(radius) || radius <= 0.0)
      bad.add(fmt::format("disc {}: its radius must be positive and finite, but is {} m", i, radius));
  }
  return bad;
}

Listing heavy_overlaps(const Packing& packing) {
  const double largest = *std::max_element(packing.radius.begin(), packing.radius.end());
  const NeighbourGrid grid(packing, 2.0 * largest);
  Listing overlaps;
  for (int i = 0; i < static_cast<int>(packing.size()) && !overlaps.full(); ++i)
    grid.for_each_candidate(packing.x[i], packing.y[i], [&](int j) {
      if (j <= i) return;
      const double dx = nearest_image(packing.x[j] - packing.x[i], packing.period.x);
      const double dy = nearest_image(packing.y[j] - packing.y[i], packing.period.y);
      const double overlap = packing.radius[i] + packing.radius[j] - std::hypot(dx, dy);
      const double smaller = std::min(packing.radius[i], packing.radius[j]);
      if (overlap > kLargestRelativeOverlap * smaller)
        overlaps.add(
            fmt::format("discs {} and {} overlap by {:.4g} m, {:.3g} % of the smaller radius: at most "
                        "{:g} % is allowed",
                        i, j, overlap, 100.0 * overlap / smaller, 100.0 * kLargestRelativeOverlap));
    });
  return overlaps;
}

}  // namespace

std::vector<std::string> packing_problems(const Packing& packing) {
  const std::size_t n = packing.size();
  if (packing.y.size() != n || packing.radius.size() != n)
    return {fmt::format("a packing needs as many x as y and radii, but has {}, {} and {}", n,
                        packing.y.size(), packing.radius.size())};
  std::vector<std::string> problems = bad_periods(packing);
  if (n < 2) problems.push_back(fmt::format("a packing needs at least two discs, but has {}", n));
  bad_discs(packing).append_to(problems);
  // Images and overlaps are meaningless among discs that are not there.
  if (problems.empty()) problems = short_periods(packing);
  if (problems.empty()) heavy_overlaps(packing).append_to(problems);
  return problems;
}

}  // namespace ddem
