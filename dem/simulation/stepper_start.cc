// The start of a run: the state at t = 0, and the velocities half a step before.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/simulation/stepper.h"

namespace ddem {
namespace {

/// Up to here the kernels' asin to the fifth power is right to the last bit.
constexpr double kSmallTurn = 5e-3;

}  // namespace

void Stepper::load(const InitialState& s) {
  const auto copy = [&](const std::vector<double>& from, AlignedVector<double>& to, int stride, int offset) {
    if (to.empty()) return;
    for (std::size_t d = 0; d < from.size(); ++d) to[static_cast<std::size_t>(stride * position_[d] + offset)] = from[d];
  };
  const auto times_radius = [this](std::vector<double> values) {
    for (std::size_t d = 0; d < values.size(); ++d) values[d] *= radius(static_cast<int>(d));
    return values;
  };
  copy(s.ux, motion_, kQuad, 0), copy(s.uy, motion_, kQuad, 1);
  if (rotation_) copy(times_radius(s.theta), motion_, kQuad, 2);
  copy(s.vx, vx_, 1, 0), copy(s.vy, vy_, 1, 0), copy(times_radius(s.omega), omega_, 1, 0);
  if (!drive_) return;
  impose(0.0, motion_);
  for (const int place : driven_places_) (drive_->direction == Direction::x ? vx_ : vy_)[place] = 0.0;  // prescribed
}

/// The kernels sum slip from step to step, by a series for the small turn of one step. Where the start itself turns a bond
/// further, what they remember of the step before becomes the start, with the whole angle: that of the bond, and of its
/// turns the one nearest to the rotations of its discs, which count theirs. From either end the same bits.
void Stepper::turn_bonds() {
  for (int slice = 0; slice < bonds_.slices; ++slice) {
    for (int k = bonds_.row_begin[slice] * kLanes; k < bonds_.row_begin[slice + 1] * kLanes; ++k) {
      const double *own = motion_.data() + static_cast<std::ptrdiff_t>(kQuad) * (slice * kLanes + k % kLanes),
                   *other = motion_.data() + static_cast<std::ptrdiff_t>(kQuad) * bonds_.neighbour[k];
      const double dx = other[0] - own[0], dy = other[1] - own[1], length = bonds_.length[k];
      const double x0 = length * bonds_.nx[k], y0 = length * bonds_.ny[k], x = x0 + dx, y = y0 + dy;
      const double rotation = bonds_.stretch[k] * (own[2] + other[2]) / length;
      const double angle = std::atan2(x0 * y - y0 * x, x0 * x + y0 * y);
      const double turn = angle + 2.0 * std::numbers::pi * std::round((rotation - angle) / (2.0 * std::numbers::pi));
      if (std::abs(turn) < kSmallTurn) continue;
      slip_[k] = 0.5 * (length + std::sqrt(x * x + y * y)) * (turn - rotation);
      previous_dx_[k] = dx, previous_dy_[k] = dy, previous_rotation_[k] = rotation;
    }
  }
}

/// The step kernel takes v_{n-1/2} to v_{n+1/2}. From v_0 it needs v_{-1/2} = v_0 - dt a_0 / 2; a_0 comes from one step
/// of the kernel itself from rest, with all its strain stages, whose results are then forgotten. (Conjugate gradients may
/// keep the strains that they found.)
void Stepper::start_leapfrog() {
  AlignedVector<double> vx(padded_, 0.0), vy(padded_, 0.0), omega(omega_.size(), 0.0);
  for (begin_step(); stage_ != Stage::motion;) {
    due_(data_, 0, bonds_.slices);
    finish_strain_stage();
  }
  StepData d = data_;
  d.vx = vx.data(), d.vy = vy.data(), d.omega = omega.data();
  move_(d, 0, bonds_.slices);
  if (watch_) push_from_rest(vx.data(), vy.data());
  for (std::size_t p = 0; p < padded_; ++p) {
    vx_[p] -= 0.5 * vx[p];
    vy_[p] -= 0.5 * vy[p];
    if (rotation_) omega_[p] -= 0.5 * omega[p];
  }
  if (implicit_) return;
  for (auto* strains : {&strain_, &strain_next_}) std::fill(strains->begin(), strains->end(), 0.0);
  largest_strain_ = 0.0;
  sweep_ = 0;
}

void Stepper::impose(double time, AlignedVector<double>& motion) const {
  const double value = drive_->displacement(time);
  for (const int place : driven_places_) motion[driven_component(place)] = value;
}

}  // namespace ddem
