#include "reports/label_placer.h"

#include <algorithm>
#include <cmath>

namespace ddem::reports {
namespace {

double covered_area(const Rect& a, const Rect& b) {
  if (!a.overlaps(b)) return 0.0;
  return (std::min(a.right(), b.right()) - std::max(a.left, b.left)) *
         (std::min(a.bottom(), b.bottom()) - std::max(a.top, b.top));
}

}  // namespace

double LabelPlacer::cost(const Rect& r) const {
  // A line is as bad as the area that its stroke of about three pixels covers; other labels are far worse.
  constexpr double stroke = 3.0, label_weight = 1000.0;
  double total = 0.0;
  for (const Rect& t : taken_) total += label_weight * covered_area(r, t);
  for (const Polyline& line : obstacles_) {
    if (line.size() == 1 && r.contains(line.front())) total += stroke * stroke;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      if (const auto inside = clip_segment({line[i], line[i + 1]}, r))
        total += stroke * std::hypot(inside->second.x - inside->first.x, inside->second.y - inside->first.y);
  }
  return total;
}

Rect LabelPlacer::place(const std::vector<Rect>& candidates) {
  const Rect* best = &candidates.front();
  double best_cost = cost(*best);
  for (const Rect& candidate : candidates) {
    const double c = cost(candidate);
    if (c < best_cost) {
      best_cost = c;
      best = &candidate;
    }
  }
  reserve(*best);
  return *best;
}

}  // namespace ddem::reports
