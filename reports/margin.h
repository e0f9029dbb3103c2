#pragma once
// How much of what a criterion accepts a value takes.

#include <optional>

#include "reports/verdict.h"

namespace ddem::reports {

/// Half the accuracy band; a one-sided band reaches from the target, or 0, to its bound. 0: no bounds, or bounds that meet.
double half_width(const Criterion& criterion);

/// From values to an axis on which 0 is right (the target, else the middle of the band, else 0) and a limit is at -1 or 1, also where
/// right is not in the middle. Where a side has no limit the scale is that of the other.
class Margin {
 public:
  explicit Margin(const Criterion& criterion);
  bool has_scale() const { return half_width_ > 0.0; }
  double of(double value) const { return (value - right_) / (value > right_ ? above_ : below_); }

 private:
  double scale(double width) const;

  double right_ = 0.0, half_width_ = 0.0, above_ = 0.0, below_ = 0.0;
};

/// 0: right, or on the side that has no limit; 1: at the limit, more: beyond it. None of what was not measured, of bounds that meet, and
/// of what has neither a target nor two bounds, but for an upper bound above 0: there 0 is right.
std::optional<double> share_of_limit(const Criterion& criterion);

}  // namespace ddem::reports
