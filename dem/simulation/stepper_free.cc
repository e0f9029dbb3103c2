// Runs that watch for new contacts take several steps a sweep, too, where nothing can close in them unless all goes much faster than
// before. Whether it did is known when the sweep is done: then the discs are put back to where they were, and go on step by step.

#include <algorithm>
#include <cmath>

#include "dem/simulation/stepper.h"

namespace ddem {

/// What steps change, where a sweep may take more than one of their stages. Nonlinear kinematics has a history of every bond to keep,
/// and pairs that depend on when they are searched for: there it takes one.
void Stepper::size_kept() {
  kept_.clear();
  if (gradients_ || !bonds_.length.empty() || !(one_sweep_pays_ || (strain_stages_ == 0 && steps_at_once_ > 1))) return;
  const auto add = [this](AlignedVector<double>& array) {
    if (!array.empty()) kept_.push_back({&array, AlignedVector<double>(array.size())});
  };
  for (auto* array : {&motion_, &vx_, &vy_, &omega_}) add(*array);
  if (!implicit_) add(strain_);
}

bool Stepper::finds_free_steps() {
  free_steps_ = 0;
  if (kept_.empty() || !assumed_.empty() || !drifts_with_kick() || (strain_stages_ > 0 && !strains_fit_a_sweep())) return false;
  free_steps_ = watch_->free_steps(motion_.data(), largest_strain_);
  return free_steps_ > 0;
}

bool Stepper::was_free() {
  const double strain = std::sqrt(2.0 * take_largest(most_strained_)), speed = std::sqrt(take_largest(fastest_));
  watch_->moved(std::max(data_.dt * speed, furthest_driven(steps_due_)), steps_due_);
  if (!watch_->is_free(std::max(strain, largest_strain_))) return false;
  largest_strain_ = strain;
  return true;
}

/// Of the slices [begin, end), before a sweep changes them.
void Stepper::keep(int begin, int end) {
  for (Kept& k : kept_) {
    const auto [first, last] = extent(k, begin, end);
    std::copy(k.array->begin() + first, k.array->begin() + last, k.before.begin() + first);
  }
}

/// To the start of the sweep, and on by one step.
void Stepper::take_back() {
  const int end = range_begin_.back();
  for (Kept& k : kept_) {
    const auto [first, last] = extent(k, 0, end);
    std::copy(k.before.begin() + first, k.before.begin() + last, k.array->begin() + first);
  }
  if (kernels_.pull) {
    StepData d = data_;
    d.strain_next = strain_.data();  // which pulls
    kernels_.pull(d, 0, end);
  }
  steps_due_ = 1;
  begin_step(false);
}

/// Of an array, the part of the slices [begin, end).
std::pair<std::ptrdiff_t, std::ptrdiff_t> Stepper::extent(const Kept& kept, int begin, int end) const {
  const auto of_slice = static_cast<std::ptrdiff_t>(kept.array->size() / static_cast<std::size_t>(bonds_.slices));
  return {of_slice * begin, of_slice * end};
}

}  // namespace ddem
