#pragma once
// Points and rectangles in pixels (y downwards), and clipping, so that nothing is ever drawn outside its
// panel.

#include <optional>
#include <utility>
#include <vector>

namespace ddem::reports {

struct Point {
  double x = 0.0;
  double y = 0.0;
};
using Polyline = std::vector<Point>;
using Segment = std::pair<Point, Point>;

struct Rect {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
  bool contains(Point p) const { return p.x >= left && p.x <= right() && p.y >= top && p.y <= bottom(); }
  bool overlaps(const Rect& o) const {
    return left < o.right() && o.left < right() && top < o.bottom() && o.top < bottom();
  }
};

/// The part of a segment inside `r` (Liang and Barsky 1984), or none.
std::optional<Segment> clip_segment(const Segment& segment, const Rect& r);

/// The part of a polyline inside `r`: as many pieces as it enters `r`.
std::vector<Polyline> clip_polyline(const Polyline& line, const Rect& r);

/// A closed polygon cut to `r` (Sutherland and Hodgman 1974); empty if it is outside.
Polyline clip_polygon(Polyline polygon, const Rect& r);

}  // namespace ddem::reports
