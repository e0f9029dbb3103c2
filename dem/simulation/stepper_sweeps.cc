// Kick and drift in one sweep. A disc may drift once every disc that reads it has been kicked, and no neighbour is farther
// than `reach` slices: the drift follows the kick at that distance, over what is still in cache. The next step may follow
// the drift at the same distance again, so that one sweep over the memory takes several steps, the same operations on the
// same numbers in another order.

#include <algorithm>

#include "dem/simulation/stepper.h"

namespace ddem {
namespace {

constexpr int kBlock = 64;  // slices that are kicked before others drift
// Measured at 1e6 discs: the steps may fill a good part of the cache that cores share; arrays that fit in a core's own gain
// nothing by more than one.
constexpr std::size_t kOwnCache = 2 << 20, kSharedCache = 8 << 20;  // bytes
constexpr std::size_t kMostSteps = 16;

}  // namespace

std::size_t Stepper::array_bytes() const {
  const auto bytes = [](const auto&... arrays) { return (... + (arrays.size() * sizeof(arrays[0]))); };
  return bytes(bonds_.row_begin, bonds_.neighbour, bonds_.nx, bonds_.ny, bonds_.stretch, bonds_.length, bonds_.stiffness, position_,
               motion_, strain_, strain_next_, source_, vx_, vy_, omega_, kick_x_, kick_y_, kick_theta_, rigid_fx_, rigid_fy_,
               rigid_moment_, previous_dx_, previous_dy_, previous_rotation_, slip_);
}

int Stepper::worthwhile_steps() const {
  const std::size_t all = array_bytes();
  if (all < kOwnCache) return 1;
  const std::size_t behind = 2 * static_cast<std::size_t>(reach_) * all / static_cast<std::size_t>(bonds_.slices);  // bytes a step
  return static_cast<int>(std::clamp<std::size_t>(kSharedCache / std::max<std::size_t>(behind, 1), 1, kMostSteps));
}

int Stepper::steps_at_once() const {
  const bool one_stage = strain_stages_ == 0 && !gradients_, everywhere = range_begin_.back() == bonds_.slices;
  return threads() == 1 && one_stage && !watch_ && everywhere ? steps_at_once_ : 1;
}

void Stepper::advance(int thread) {
  const int begin = range_begin_[thread], end = range_begin_[thread + 1];
  if (begin >= end) return;
  switch (stage_) {
    case Stage::motion: return threads() == 1 && !watch_ ? sweep(end) : kick_and_drift(begin, end);
    case Stage::drift: return drift_rest(begin, end);
    default: due_(data_, begin, end);
  }
}

/// The slices before `end`, for as many steps as are due.
void Stepper::sweep(int end) {
  if (steps_due_ > 1) {
    taps_.begin(steps_due_);
    driven_.assign(static_cast<std::size_t>(steps_due_), 0);
  }
  StepData even = data_, odd = data_;
  odd.strain = data_.strain_next, odd.strain_next = strain_.data();
  const int last = 2 * steps_due_ - 1;  // the last drift follows the first kick at so many reaches
  const auto clipped = [end](int slice) { return std::clamp(slice, 0, end); };
  for (int front = kBlock; front - kBlock < end + last * reach_; front += kBlock) {
    for (int level = 0; level < steps_due_; ++level) {
      const StepData& d = level % 2 == 0 ? even : odd;
      const int kicked = front - 2 * level * reach_, drifted = kicked - reach_;
      if (kicked <= 0) break;
      if (kicked - kBlock < end) move_(d, clipped(kicked - kBlock), clipped(kicked));
      if (drifted <= 0 || drifted - kBlock >= end) continue;
      kernels_.drift(d, clipped(drifted - kBlock), clipped(drifted));
      if (steps_due_ > 1) pass(level, clipped(drifted) * kLanes);
    }
  }
}

/// What happens to discs below the place `end` after step `level` of a sweep.
void Stepper::pass(int level, int end) {
  if (drive_) {
    const double value = drive_->displacement(static_cast<double>(step_number_ + level + 1) * data_.dt);
    std::size_t& k = driven_[level];
    for (; k < driven_places_.size() && driven_places_[k] < end; ++k) motion_[driven_component(driven_places_[k])] = value;
  }
  taps_.keep(motion_.data(), level, end);
}

/// A thread's share. What discs of other shares read drifts later.
void Stepper::kick_and_drift(int begin, int end) {
  const int block = watch_ ? end - begin : kBlock;  // who watches looks at the first slice of a share
  int drifted = begin + reach_;
  for (int from = begin; from < end; from += block) {
    const int to = std::min(from + block, end), ready = to - reach_;
    move_(data_, from, to);
    if (ready <= drifted) continue;
    kernels_.drift(data_, drifted, ready);
    drifted = ready;
  }
}

void Stepper::drift_rest(int begin, int end) {
  const int lower = std::min(begin + reach_, end), upper = std::max(lower, end - reach_);
  if (begin < lower) kernels_.drift(data_, begin, lower);
  if (upper < end) kernels_.drift(data_, upper, end);
}

AlignedVector<double> Stepper::motion_before() const {
  AlignedVector<double> before = motion_;
  for (std::size_t p = 0; p < padded_; ++p) {
    before[kQuad * p] -= data_.dt * vx_[p];
    before[kQuad * p + 1] -= data_.dt * vy_[p];
    if (rotation_) before[kQuad * p + 2] -= data_.dt * omega_[p];
  }
  if (drive_) impose(static_cast<double>(step_number_ - 1) * data_.dt, before);
  return before;
}

}  // namespace ddem
