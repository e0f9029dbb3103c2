#include "reports/plot_limits.h"

#include "reports/axis.h"
#include "reports/heat_map.h"

namespace ddem::reports {

Limits x_limits(const Plot& plot) {
  if (plot.x.limits) return *plot.x.limits;
  if (plot.map) return map_extent(plot.map->x, plot.x.scale);
  Extent extent(plot.x.scale);
  bool markers = false;
  for (const Series& s : plot.series) {
    markers = markers || s.kind != SeriesKind::line;
    for (std::size_t i = 0; i < s.x.size(); ++i)
      if (drawable(s.y[i], plot.y.scale)) extent.add(s.x[i]);
  }
  for (const Band& b : plot.bands)
    for (const double x : b.x) extent.add(x);
  for (const ReferenceLine& r : plot.references)
    if (r.direction == Direction::vertical) extent.add(r.value);
  for (const Pick& p : plot.picks) extent.add(p.x);
  return extent.padded(markers ? 0.04 : 0.02);
}

Limits y_limits(const Plot& plot) {
  if (plot.y.limits) return *plot.y.limits;
  if (plot.map) return map_extent(plot.map->y, plot.y.scale);
  Extent extent(plot.y.scale);
  for (const Series& s : plot.series)
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      if (!drawable(s.x[i], plot.x.scale)) continue;
      extent.add(s.y[i]);
      if (s.error.empty() || !drawable(s.y[i], plot.y.scale)) continue;
      extent.add(s.y[i] - s.error[i]);
      extent.add(s.y[i] + s.error[i]);
    }
  for (const Band& b : plot.bands)
    for (std::size_t i = 0; i < b.x.size(); ++i) {
      extent.add(b.lower[i]);
      extent.add(b.upper[i]);
    }
  for (const ReferenceLine& r : plot.references)
    if (r.direction == Direction::horizontal) extent.add(r.value);
  for (const Pick& p : plot.picks)
    if (p.y) extent.add(*p.y);
  return extent.padded(0.06);
}

}  // namespace ddem::reports
