// Kick and drift in one sweep. A disc may drift once every disc that reads it has been kicked, and no neighbour is farther
// than `reach` slices: the drift follows the kick at that distance, over what is still in cache. The next step may follow
// the drift at the same distance again, so that one sweep over the memory takes several steps, the same operations on the
// same numbers in another order. So may implicit strains, stage by stage, before the kick: a step is a row of passes, each a
// reach behind the one before. Where the shares of two threads meet, each leaves out what the other can have reached by then,
// a reach more with every pass; when all have come to their ends, these seams are closed.

#include <algorithm>

#include "dem/simulation/stepper.h"

namespace ddem {
namespace {

constexpr int kBlock = 64;  // slices of a pass before the next one
// Measured at 1e6 discs: the steps may fill a good part of the cache that cores share; arrays that fit in a core's own gain
// nothing by more than one.
constexpr std::size_t kOwnCache = 2 << 20, kSharedCache = 8 << 20;  // bytes
// As long as that cache holds all arrays, implicit strains are 3 % faster one stage after the other.
constexpr std::size_t kSpilled = 16 << 20;
constexpr std::size_t kMostSteps = 16;
constexpr std::size_t kPressCache = 1 << 20;

}  // namespace

std::size_t Stepper::array_bytes() const {
  const auto bytes = [](const auto&... arrays) { return (... + (arrays.size() * sizeof(arrays[0]))); };
  return bytes(bonds_.row_begin, bonds_.neighbour, bonds_.nx, bonds_.ny, bonds_.stretch, bonds_.length, bonds_.stiffness, position_,
               motion_, strain_, strain_next_, source_, vx_, vy_, omega_, kick_x_, kick_y_, kick_theta_, rigid_fx_, rigid_fy_,
               rigid_moment_, previous_dx_, previous_dy_, previous_rotation_, slip_, pull_, press_, press_next_, dyad_xx_,
               dyad_yy_, dyad_xy_, other_end_);
}

/// Implicit strains take three sweeps a step and more over what the discs pull and press: faster only from a core's own cache.
bool Stepper::worth_pulling(const SimulationInput& in) const {
  if (rotation_ || !deformable_ || in.contact.kinematics == Kinematics::nonlinear || in.deformation.evaluations > 1) return false;
  constexpr std::size_t kBytes = 8 * sizeof(double) + sizeof(std::int32_t);  // a half-bond
  return !implicit_ || (in.deformation.solver == StrainSolver::polynomial && bonds_.neighbour.size() * kBytes < kPressCache);
}

void Stepper::size_pulls() {
  other_end_ = other_ends(assembly_.bonds, position_, bonds_);
  pull_.assign(other_end_.size(), 0.0);
  if (!implicit_) return;
  for (auto* array : {&press_, &press_next_, &dyad_xx_, &dyad_yy_, &dyad_xy_}) array->assign(other_end_.size(), 0.0);
  for (std::size_t k = 0; k < other_end_.size(); ++k) {
    const double s = bonds_.stretch.empty() ? 1.0 : bonds_.stretch[k], nx = bonds_.nx[k], ny = bonds_.ny[k];
    dyad_xx_[k] = s * (nx * nx), dyad_yy_[k] = s * (ny * ny), dyad_xy_[k] = s * (nx * ny);
  }
}

void Stepper::plan_sweeps(const SimulationInput& input) {
  automatic_steps_ = input.steps_a_sweep == 0;
  one_sweep_pays_ = implicit_ && !gradients_ && (automatic_steps_ ? array_bytes() >= kSpilled : input.steps_a_sweep > 1);
  steps_at_once_ = automatic_steps_ ? worthwhile_steps() : input.steps_a_sweep;
}

/// Two seams at the ends of a share must not meet.
bool Stepper::strains_fit_a_sweep() const {
  if (!one_sweep_pays_) return false;
  return threads() == 1 || 2 * (strain_stages_ + 1) * reach_ <= front_after(1) / threads();
}

int Stepper::worthwhile_steps() const {
  const std::size_t all = array_bytes(), slices = static_cast<std::size_t>(bonds_.slices), reach = static_cast<std::size_t>(reach_);
  if (all < kOwnCache || reach == 0) return 1;
  const std::size_t passes = one_sweep_pays_ ? static_cast<std::size_t>(strain_stages_) + 2 : 2;
  const std::size_t bytes_a_step = passes * reach * all / slices * static_cast<std::size_t>(threads());
  return static_cast<int>(std::clamp<std::size_t>(kSharedCache / bytes_a_step, 1, kMostSteps));
}

int Stepper::steps_at_once() const {
  if ((strain_stages_ > 0 && !in_one_sweep_) || gradients_ || (watch_ && !free_)) return 1;
  const int most = watch_ ? std::min(steps_at_once_, free_steps_) : steps_at_once_;
  if (threads() == 1 || reach_ == 0) return most;
  // Two seams at the ends of a share do not meet: 2 (passes - 1) reach <= share.
  return std::clamp((range_begin_.back() / threads() / reach_ + 2) / (2 * passes_a_step()), 1, most);
}

bool Stepper::drifts_with_kick() const { return threads() == 1 || 2 * reach_ <= range_begin_.back() / threads(); }

void Stepper::advance(int thread) {
  const int begin = range_begin_[thread], end = range_begin_[thread + 1];
  if (begin >= end) return;
  if (stage_ == Stage::seams) {
    if (!drifts_with_kick()) return drift(0, begin, end);
    if (thread + 1 < threads()) close_seam(thread, end);
  } else if (stage_ != Stage::motion) {
    due_(noted_by(thread, data_), begin, end);
  } else if (drifts_with_kick()) {
    sweep(thread);
  } else {
    move_(noted_by(thread, data_), begin, end);
  }
}

/// With the places where a thread notes its largest.
StepData Stepper::noted_by(int thread, StepData d) {
  if (!watch_) return d;
  const std::ptrdiff_t own = std::ptrdiff_t{kLanes} * thread;
  d.fastest = fastest_.data() + own, d.most_strained = most_strained_.data() + own;
  return d;
}

/// For step `level` of a sweep: lagged strains change their places with every step.
StepData Stepper::data_of(int level) {
  StepData d = data_;
  if (!implicit_ && level % 2 == 1) d.strain = strain_next_.data(), d.strain_next = strain_.data();
  return d;
}

/// For a stage of implicit strains in the sweep of the motion: they change their places with every stage, so that the last
/// one leaves them where the motion reads them.
StepData Stepper::data_of_strains(int stage) {
  const bool back = (strain_stages_ - stage) % 2 == 1;
  auto &from = back ? strain_next_ : strain_, &to = back ? strain_ : strain_next_;
  auto &press_from = back ? press_next_ : press_, &press_to = back ? press_ : press_next_;
  StepData d = data_;
  d.strain = from.data(), d.strain_next = to.data();
  d.press = (stage == 0 ? press_to : press_from).data(), d.press_next = press_to.data();  // the source stage writes its own press
  return stage == 0 ? d : relaxed(d, stage);
}

/// Of a sweep, whose steps are so many passes each: the strains of implicit runs, the kick, the drift.
void Stepper::pass(int thread, int index, int begin, int end) {
  const int level = index / passes_a_step(), stage = index % passes_a_step(), strain_stages = passes_a_step() - 2;
  if (stage < strain_stages) {
    (stage == 0 ? kernels_.source : iteration(stage))(noted_by(thread, data_of_strains(stage)), begin, end);
  } else if (stage == strain_stages) {
    move_(noted_by(thread, data_of(level)), begin, end);
  } else {
    drift(level, begin, end);
  }
}

/// The slices of a thread, as many steps as are due. A disc of theirs that discs of another share can have reached by then is
/// left to the seam.
void Stepper::sweep(int thread) {
  const int begin = range_begin_[thread], end = range_begin_[thread + 1];
  const bool seam_before = thread > 0, seam_after = thread + 1 < threads();
  const int passes = passes_a_step() * steps_due_;
  for (int front = begin + kBlock; front - kBlock < end + (passes - 1) * reach_; front += kBlock) {
    for (int index = 0; index < passes; ++index) {
      const int lag = index * reach_, at = front - lag;
      if (at <= begin) break;
      const int from = std::max(at - kBlock, seam_before ? begin + lag : begin), to = std::min(at, seam_after ? end - lag : end);
      if (from >= to) continue;
      if (free_ && index == 0) keep(from, to);
      pass(thread, index, from, to);
    }
  }
}

/// What the sweeps on both sides of a slice have left, which grows with every pass.
void Stepper::close_seam(int thread, int slice) {
  for (int index = 1; index < passes_a_step() * steps_due_; ++index) pass(thread, index, slice - index * reach_, slice + index * reach_);
}

/// After step `level` of a sweep: displacements, and those of a driven edge at t_{n+1}.
void Stepper::drift(int level, int begin, int end) {
  kernels_.drift(data_of(level), begin, end);
  const int first = begin * kLanes, last = end * kLanes;
  if (drive_) {
    const double value = drive_->displacement(static_cast<double>(step_number_ + level + 1) * data_.dt);
    const auto from = std::lower_bound(driven_places_.begin(), driven_places_.end(), first),
               to = std::lower_bound(from, driven_places_.end(), last);
    for (auto place = from; place != to; ++place) motion_[driven_component(*place)] = value;
    if (from != to) pull(level, *from / kLanes, *(to - 1) / kLanes + 1);
  }
  if (steps_due_ > 1) taps_.keep(motion_.data(), level, first, last);
}

/// With the strains that step `level` of a sweep has written.
void Stepper::pull(int level, int begin, int end) {
  if (kernels_.pull) kernels_.pull(data_of(level), begin, end);
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
