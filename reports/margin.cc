#include "reports/margin.h"

#include <cmath>

namespace ddem::reports {

double half_width(const Criterion& c) {
  const bool lower = std::isfinite(c.lower), upper = std::isfinite(c.upper);
  const double middle = std::isfinite(c.target) ? c.target : 0.0;
  if (lower && upper) return 0.5 * (c.upper - c.lower);
  if (lower) return std::abs(middle - c.lower);
  if (upper) return std::abs(c.upper - middle);
  return 0.0;
}

Margin::Margin(const Criterion& c) : half_width_(half_width(c)) {
  if (std::isfinite(c.target))
    right_ = c.target;
  else if (std::isfinite(c.lower) && std::isfinite(c.upper))
    right_ = 0.5 * (c.lower + c.upper);
  above_ = scale(c.upper - right_);
  below_ = scale(right_ - c.lower);
}

double Margin::scale(double width) const { return std::isfinite(width) && width > 0.0 ? width : half_width_; }

std::optional<double> share_of_limit(const Criterion& c) {
  const Margin margin(c);
  const bool lower = std::isfinite(c.lower), upper = std::isfinite(c.upper), has_right = std::isfinite(c.target) || (lower && upper);
  if (!std::isfinite(c.actual) || !margin.has_scale()) return std::nullopt;
  if (!has_right && !(upper && c.upper > 0.0)) return std::nullopt;
  const double way = margin.of(c.actual);
  // To where no limit is, nothing is on its way.
  return way > 0.0 ? (upper ? way : 0.0) : has_right && lower ? -way : 0.0;
}

}  // namespace ddem::reports
