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
  const bool two_sided = std::isfinite(c.target) || (std::isfinite(c.lower) && std::isfinite(c.upper));
  if (!std::isfinite(c.actual) || !margin.has_scale() || (!two_sided && !std::isfinite(c.upper))) return std::nullopt;
  return two_sided ? std::abs(margin.of(c.actual)) : margin.of(c.actual);
}

}  // namespace ddem::reports
