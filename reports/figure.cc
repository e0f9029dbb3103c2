#include "reports/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reports/axis.h"

namespace ddem::reports {
namespace {

class Checker {
 public:
  explicit Checker(const Figure& figure) : figure_(figure) {}

  void operator()(const Plot& plot) const {
    check_axis(plot.x, "x axis");
    check_axis(plot.y, "y axis");
    for (const Series& s : plot.series) {
      check_length("series", s.name, "y", s.y.size(), s.x.size());
      if (!s.error.empty()) check_length("series", s.name, "error", s.error.size(), s.x.size());
    }
    for (const Band& b : plot.bands) {
      check_length("band", b.name, "lower", b.lower.size(), b.x.size());
      check_length("band", b.name, "upper", b.upper.size(), b.x.size());
    }
    if (plot.map) check_map(*plot.map, plot);
  }

  void operator()(const Strip& strip) const {
    const std::size_t n = strip.x.size();
    check_length("strip", strip.title, "y", strip.y.size(), n);
    check_length("strip", strip.title, "radius", strip.radius.size(), n);
    if (!strip.value.empty()) check_length("strip", strip.title, "value", strip.value.size(), n);
    if (strip.value_axis.scale != Scale::linear) fail("the colour bar of a strip is linear");
    check_axis(strip.value_axis, "colour bar");
    for (std::size_t i = 0; i < n; ++i)
      if (!std::isfinite(strip.x[i]) || !std::isfinite(strip.y[i]) || !std::isfinite(strip.radius[i]) ||
          strip.radius[i] <= 0.0)
        fail(fmt::format("disc {} has centre ({}, {}) and radius {}", i, strip.x[i], strip.y[i],
                         strip.radius[i]));
    for (const Probe& p : strip.probes)
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        fail(fmt::format("probe '{}' is at ({}, {})", p.label, p.x, p.y));
    check_frames(strip);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw std::invalid_argument(fmt::format("figure '{}': {}", figure_.id, problem));
  }

  void check_length(std::string_view kind, std::string_view name, std::string_view what, std::size_t actual,
                    std::size_t expected) const {
    if (actual == expected) return;
    fail(fmt::format("{} '{}' has {} values of {} for {} of x", kind, name, actual, what, expected));
  }

  void check_frames(const Strip& strip) const {
    for (const double t : strip.times)
      if (!std::isfinite(t)) fail("a frame's time is not finite");
    for (const StripField& f : strip.fields) {
      if (f.values.size() != strip.times.size() * strip.x.size())
        fail(fmt::format("field '{}' has {} values for {} frames of {} discs", f.axis.label, f.values.size(),
                         strip.times.size(), strip.x.size()));
      if (!f.axis.limits || f.axis.scale != Scale::linear) fail("a field over time needs linear limits of its colours");
      check_axis(f.axis, "field over time");
    }
  }

  void check_map(const HeatMap& map, const Plot& plot) const {
    check_centres(map.x, plot.x.scale, "columns");
    check_centres(map.y, plot.y.scale, "rows");
    if (map.value.size() != map.x.size() * map.y.size())
      fail(fmt::format("a heat map of {} x {} cells has {} values", map.x.size(), map.y.size(), map.value.size()));
    if (!map.value_axis.limits) fail("a heat map needs the limits of its colours");
    Axis axis = map.value_axis;
    axis.scale = map.scale == ColorScale::linear ? Scale::linear : Scale::log;
    check_axis(axis, "colour bar");
  }

  void check_centres(const std::vector<double>& centres, Scale scale, std::string_view which) const {
    bool ascending = centres.size() >= 2;
    for (std::size_t i = 0; i < centres.size(); ++i)
      ascending = ascending && drawable(centres[i], scale) && (i == 0 || centres[i] > centres[i - 1]);
    if (!ascending) fail(fmt::format("the {} of a heat map are not two or more in ascending order", which));
  }

  void check_axis(const Axis& axis, std::string_view which) const {
    if (!axis.limits) return;
    const auto [lower, upper] = *axis.limits;
    // Closer than that, ticks could not be told apart in double precision.
    const bool apart = upper - lower > 1e-12 * std::max(std::abs(lower), std::abs(upper));
    if (!drawable(lower, axis.scale) || !drawable(upper, axis.scale) || !apart || upper - lower < 1e-290)
      fail(fmt::format("{} has the limits {} .. {}; lower < upper{}, and finite, is needed", which, lower,
                       upper, axis.scale == Scale::log ? ", both positive" : ""));
  }

  const Figure& figure_;
};

}  // namespace

void require_valid(const Figure& figure) {
  for (const Panel& panel : figure.panels) std::visit(Checker(figure), panel);
}

}  // namespace ddem::reports
