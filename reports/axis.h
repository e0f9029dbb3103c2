#pragma once
// From data to pixels: the limits of an axis, its transform, its tick labels and its title.

#include <optional>
#include <string>
#include <vector>

#include "reports/figure.h"

namespace ddem::reports {

/// Whether a value has a place on such an axis. Beyond 1e300 even differences overflow, so that counts as
/// infinite.
bool drawable(double value, Scale scale);

/// The smallest interval that holds all drawable values seen.
class Extent {
 public:
  explicit Extent(Scale scale) : scale_(scale) {}
  void add(double value);
  /// With `padding` (fraction of the span, of decades on a log axis) on both sides. Never degenerate:
  /// all-equal values are in the middle, and no values at all give 0 .. 1 (1 .. 10 on a log axis).
  Limits padded(double padding) const;

 private:
  Scale scale_;
  std::optional<Limits> seen_ = {};
};

class AxisScale {
 public:
  /// `from` and `to`: pixels of limits.lower and limits.upper.
  AxisScale(Scale scale, Limits limits, double from, double to);
  /// Pixels of a drawable value; far outside the limits it is held at 1e7, which is as good as infinite.
  double pixel(double value) const;
  bool drawable(double value) const { return reports::drawable(value, scale_); }
  const Limits& limits() const { return limits_; }

 private:
  Scale scale_;
  Limits limits_;
  double from_, to_;
};

struct Tick {
  double value = 0.0;
  std::string label = {};
};

struct AxisMarks {
  std::vector<Tick> ticks = {};
  std::string title = {};  ///< label with unit: "time (µs)", "energy (10⁻⁷ J m)"
  int exponent = 0;        ///< tick labels are data / 10^exponent
  double label_width = 0.0;
};

/// Ticks labelled with short numbers: an SI prefix, or a power of ten, goes to the title.
AxisMarks axis_marks(const Axis& axis, Limits limits, int max_count);

/// The same, with as many ticks as fit side by side into `width` pixels.
AxisMarks axis_marks_along(const Axis& axis, Limits limits, double width);

constexpr double kTickFont = 12.0;

}  // namespace ddem::reports
