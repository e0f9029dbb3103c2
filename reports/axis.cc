#include "reports/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "reports/number.h"
#include "reports/text.h"
#include "reports/ticks.h"

namespace ddem::reports {
namespace {

constexpr double kLargestValue = 1e300;

struct Unit {
  std::string text;
  int exponent = 0;  // tick labels are data / 10^exponent
};

std::string_view si_prefix(int exponent) {
  switch (exponent) {
    case -15:
      return "f";
    case -12:
      return "p";
    case -9:
      return "n";
    case -6:
      return "µ";
    case -3:
      return "m";
    case 3:
      return "k";
    case 6:
      return "M";
    case 9:
      return "G";
    case 12:
      return "T";
    default:
      return {};
  }
}

// The unit that keeps labels between 0.1 and 10^4 (SI units that take a prefix) or 10^-3 and 10^5 (all
// others).
Unit display_unit(const std::string& unit, double largest) {
  constexpr std::array<std::string_view, 11> prefixable = {"m", "s",   "Hz",  "Pa",  "N",  "J",
                                                           "W", "m/s", "N/m", "J/m", "rad"};
  if (!(largest > 0.0)) return {unit, 0};
  const bool takes_prefix = std::find(prefixable.begin(), prefixable.end(), unit) != prefixable.end();
  // A label such as 9.9999999 counts as 10.
  const double decade = std::floor(std::log10(largest) + 1e-9);
  if (takes_prefix) {
    if (largest >= 0.1 * (1 - 1e-9) && largest < 1e4) return {unit, 0};
    const int exponent = 3 * static_cast<int>(std::floor(decade / 3.0));
    if (const auto prefix = si_prefix(exponent); !prefix.empty())
      return {std::string(prefix) + unit, exponent};
  } else if (largest >= 1e-3 * (1 - 1e-9) && largest < 1e5) {
    return {unit, 0};
  }
  const int exponent = static_cast<int>(decade);
  if (exponent == 0) return {unit, 0};
  return {
      fmt::format("{}{}{}", unit.empty() ? "×" : "", power_of_ten(exponent), unit.empty() ? "" : " " + unit),
      exponent};
}

std::string axis_title(const std::string& label, const std::string& unit) {
  if (unit.empty()) return label;
  return label.empty() ? unit : label + " (" + unit + ")";
}

std::string log_label(double value) {
  const double exponent = std::round(std::log10(value));
  const bool power = std::abs(value / std::pow(10.0, exponent) - 1.0) < 1e-9;
  if (power && std::abs(exponent) > 2.0) return power_of_ten(static_cast<int>(exponent));
  return number_text(value, 12);
}

}  // namespace

bool drawable(double value, Scale scale) {
  if (!std::isfinite(value) || std::abs(value) > kLargestValue) return false;
  return scale == Scale::linear || value >= 1.0 / kLargestValue;
}

void Extent::add(double value) {
  if (!drawable(value, scale_)) return;
  if (!seen_) seen_ = Limits{value, value};
  seen_->lower = std::min(seen_->lower, value);
  seen_->upper = std::max(seen_->upper, value);
}

Limits Extent::padded(double padding) const {
  if (!seen_) return scale_ == Scale::log ? Limits{1.0, 10.0} : Limits{0.0, 1.0};
  if (scale_ == Scale::log) {
    const double lower = std::log10(seen_->lower), upper = std::log10(seen_->upper);
    const double pad = upper - lower > 1e-9 ? padding * (upper - lower) : 0.5;
    return {std::pow(10.0, std::max(lower - pad, -302.0)), std::pow(10.0, std::min(upper + pad, 302.0))};
  }
  const double span = seen_->upper - seen_->lower;
  const double largest = std::max(std::abs(seen_->lower), std::abs(seen_->upper));
  double pad = padding * span;
  // Below this, ticks could no longer be told apart in double precision.
  if (span <= 1e-12 * largest || largest < 1e-280) pad = largest < 1e-280 ? 1.0 : 0.05 * largest;
  return {seen_->lower - pad, seen_->upper + pad};
}

AxisScale::AxisScale(Scale scale, Limits limits, double from, double to)
    : scale_(scale), limits_(limits), from_(from), to_(to) {}

double AxisScale::pixel(double value) const {
  const auto fraction = [&] {
    if (scale_ == Scale::linear) return (value - limits_.lower) / (limits_.upper - limits_.lower);
    const double lower = std::log10(limits_.lower);
    return (std::log10(value) - lower) / (std::log10(limits_.upper) - lower);
  }();
  return std::clamp(from_ + fraction * (to_ - from_), -1e7, 1e7);
}

AxisMarks axis_marks(const Axis& axis, Limits limits, int max_count) {
  if (!(limits.lower < limits.upper) || !std::isfinite(limits.lower) || !std::isfinite(limits.upper)) {
    throw std::invalid_argument(fmt::format("an axis has the limits {} .. {}", limits.lower, limits.upper));
  }
  AxisMarks marks;
  if (axis.scale == Scale::log) {
    marks.title = axis_title(axis.label, axis.unit);
    for (const double v : log_ticks(limits, max_count).values) marks.ticks.push_back({v, log_label(v)});
  } else {
    const Ticks ticks = linear_ticks(limits, max_count);
    double largest = 0.0;
    for (const double v : ticks.values) largest = std::max(largest, std::abs(v));
    const Unit unit = display_unit(axis.unit, largest);
    marks.title = axis_title(axis.label, unit.text);
    marks.exponent = unit.exponent;
    const int decimals = std::max(0, unit.exponent - ticks.exponent);
    // Two steps, as 10^exponent alone may be subnormal.
    const double half = std::pow(10.0, -(unit.exponent / 2)),
                 rest = std::pow(10.0, unit.exponent / 2 - unit.exponent);
    for (const double v : ticks.values) marks.ticks.push_back({v, fixed_text(v * half * rest, decimals)});
  }
  for (const Tick& t : marks.ticks)
    marks.label_width = std::max(marks.label_width, text_width(t.label, kTickFont));
  return marks;
}

AxisMarks axis_marks_along(const Axis& axis, Limits limits, double width) {
  AxisMarks marks;
  for (int count = std::max(2, static_cast<int>(width / 46.0)); count >= 1;
       count = count > 1 ? count - 1 : 0) {
    marks = axis_marks(axis, limits, count);
    if ((marks.label_width + 14.0) * static_cast<double>(marks.ticks.size()) <= width) break;
  }
  return marks;
}

}  // namespace ddem::reports
