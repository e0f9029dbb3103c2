// What a stepper tells of its discs, in the order that they had.
#include <algorithm>
#include <cmath>

#include "dem/simulation/stepper.h"

namespace ddem {

std::optional<Breakdown> Stepper::breakdown() const {
  if (undecided_) {
    const auto disc = std::find(position_.begin(), position_.end(), assumed_.empty() ? 0 : assumed_.front().i);
    return Breakdown{Breakdown::Cause::contacts_undecided, step_number_, static_cast<int>(disc - position_.begin())};
  }
  if (!gradients_ || !gradients_->breakdown()) return std::nullopt;
  const StrainBreakdown& b = *gradients_->breakdown();
  const auto disc = std::find(position_.begin(), position_.end(), b.place);
  return Breakdown{b.cause == StrainBreakdown::Cause::indefinite ? Breakdown::Cause::strains_indefinite : Breakdown::Cause::strains_not_converged,
                   step_number_, disc == position_.end() ? 0 : static_cast<int>(disc - position_.begin())};
}

int Stepper::diverged_disc(double bound) const {
  const MotionView u{motion_.data()};
  for (std::size_t d = 0; d < discs_; ++d) {
    const int p = position_[d];
    if (!(std::abs(u.ux(p)) <= bound && std::abs(u.uy(p)) <= bound)) return static_cast<int>(d);
  }
  return -1;
}

std::vector<double> Stepper::in_order(const double* values, int stride) const {
  std::vector<double> ordered(discs_, 0.0);
  if (values == nullptr) return ordered;
  for (std::size_t d = 0; d < discs_; ++d) ordered[d] = values[stride * position_[d]];
  return ordered;
}

std::vector<double> Stepper::over_radius(const double* values, int stride) const {
  std::vector<double> ordered = in_order(values, stride);
  for (std::size_t d = 0; d < discs_; ++d) ordered[d] /= radius(static_cast<int>(d));
  return ordered;
}

InitialState Stepper::state_of(const double* motion) const {
  return {in_order(motion, kQuad), in_order(motion + 1, kQuad), over_radius(motion + 2, kQuad),
          in_order(vx_.data()),    in_order(vy_.data()),        over_radius(omega_.data())};
}

}  // namespace ddem
