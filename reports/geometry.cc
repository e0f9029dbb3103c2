#include "reports/geometry.h"

#include <algorithm>

namespace ddem::reports {
namespace {

Point between(Point a, Point b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

Point clamped(Point p, const Rect& r) {
  return {std::clamp(p.x, r.left, r.right()), std::clamp(p.y, r.top, r.bottom())};
}

}  // namespace

std::optional<Segment> clip_segment(const Segment& segment, const Rect& r) {
  const auto& [a, b] = segment;
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double direction[4] = {-dx, dx, -dy, dy};
  const double room[4] = {a.x - r.left, r.right() - a.x, a.y - r.top, r.bottom() - a.y};
  double enter = 0.0, leave = 1.0;
  for (int side = 0; side < 4; ++side) {
    if (direction[side] == 0.0) {
      if (room[side] < 0.0) return std::nullopt;
      continue;
    }
    const double t = room[side] / direction[side];
    if (direction[side] < 0.0)
      enter = std::max(enter, t);
    else
      leave = std::min(leave, t);
  }
  if (enter > leave) return std::nullopt;
  // The ends are kept bitwise when they are inside; computed ones may be off by round-off.
  return Segment{enter == 0.0 ? a : clamped(between(a, b, enter), r),
                 leave == 1.0 ? b : clamped(between(a, b, leave), r)};
}

std::vector<Polyline> clip_polyline(const Polyline& line, const Rect& r) {
  std::vector<Polyline> pieces;
  bool connected = false;
  if (line.size() == 1 && r.contains(line.front())) pieces.push_back(line);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto visible = clip_segment({line[i], line[i + 1]}, r);
    if (!visible) {
      connected = false;
      continue;
    }
    if (!connected) pieces.push_back({visible->first});
    pieces.back().push_back(visible->second);
    connected = r.contains(line[i + 1]);
  }
  return pieces;
}

Polyline clip_polygon(Polyline polygon, const Rect& r) {
  for (int side = 0; side < 4 && !polygon.empty(); ++side) {
    const auto depth = [&](Point p) {
      switch (side) {
        case 0:
          return p.x - r.left;
        case 1:
          return r.right() - p.x;
        case 2:
          return p.y - r.top;
        default:
          return r.bottom() - p.y;
      }
    };
    Polyline kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      const double da = depth(a), db = depth(b);
      if (da >= 0.0) kept.push_back(a);
      if ((da < 0.0) != (db < 0.0)) kept.push_back(between(a, b, da / (da - db)));
    }
    polygon = std::move(kept);
  }
  for (Point& p : polygon) p = clamped(p, r);
  return polygon;
}

}  // namespace ddem::reports
