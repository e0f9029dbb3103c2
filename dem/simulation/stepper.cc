#include "dem/simulation/stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dem/assembly/bond_stiffness.h"
#include "dem/assembly/particle_volume.h"
#include "dem/simulation/front.h"

namespace ddem {
namespace {

StrainCoupling coupling(const DeformationParameters& d) {
  if (!d.active()) return StrainCoupling::none;
  switch (d.correction) {
    case Correction::normal: return StrainCoupling::normal;
    case Correction::full: return StrainCoupling::full;
    case Correction::normal_only_stress: return StrainCoupling::normal_only_stress;
  }
  return StrainCoupling::none;
}

/// Of the receivers.
std::vector<int> tapped(const SimulationInput& input, const std::vector<int>& position) {
  std::vector<int> places;
  for (const Receiver& r : input.receivers) {
    for (const int d : r.discs) places.push_back(position[d]);
  }
  return places;
}

bool held(const std::vector<std::uint8_t>& mask, std::size_t disc) { return !mask.empty() && mask[disc]; }

}  // namespace

Stepper::Stepper(const Assembly& a, const SimulationInput& input, InstructionSet isa)
    : position_(locality_order(a.packing, a.bonds)),
      discs_(a.size()),
      rotation_(input.contact.has_rotation()),
      deformable_(input.deformation.active()),
      drive_(input.drive),
      implicit_(input.deformation.scheme == Scheme::implicit),
      assembly_(a),
      contact_(input.contact),
      deformation_(input.deformation),
      taps_(tapped(input, position_)) {
  const bool uniform = input.contact.uniform();
  bonds_ = slice_bonds(a.bonds, position_, uniform ? std::vector<double>{} : normal_stiffnesses(a, input.contact),
                       input.contact.kinematics == Kinematics::nonlinear);
  pulls_ = worth_pulling(input);
  padded_ = static_cast<std::size_t>(bonds_.slices) * kLanes;
  range_begin_.resize(static_cast<std::size_t>(std::min(input.threads, std::max(1, bonds_.slices))) + 1);
  share(bonds_.slices);
  reach_ = bonds_.reach();
  size_arrays(input);
  set_parameters(a, input);
  if (deformable_) prepare_strains(a, input);
  const bool nonlinear = input.contact.kinematics == Kinematics::nonlinear;
  if (input.new_contacts != ContactWatch::off) {
    watch_.emplace(a, input, position_);
    size_notes();
  }
  kernels_ = step_kernels({rotation_, nonlinear, coupling(input.deformation), implicit_, !uniform,
                           bonds_.stretch.empty(), pulls_, watch_.has_value()},
                          isa);
  move_ = implicit_ && !gradients_ ? kernels_.respond : kernels_.step;
  load(input.initial);
  if (input.follow_front) find_fronts();
  if (pulls_) bonds_.neighbour = AlignedVector<std::int32_t>();  // of {} its memory would stay
  bind();
  pull(0, 0, bonds_.slices);
  if (rotation_ && nonlinear) turn_bonds();
  start_leapfrog();
  plan_sweeps(input);
  if (watch_) size_kept();
  begin_step();
}

void Stepper::size_arrays(const SimulationInput& input) {
  for (auto* array : {&vx_, &vy_, &kick_x_, &kick_y_}) array->assign(padded_, 0.0);
  if (rotation_) {
    for (auto* array : {&omega_, &kick_theta_}) array->assign(padded_, 0.0);
  }
  motion_.assign(kQuad * padded_, 0.0);
  if (deformable_) {
    for (auto* array : {&strain_, &strain_next_}) array->assign(kQuad * padded_, 0.0);
  }
  if (implicit_) source_.assign(kQuad * padded_, 0.0);
  if (implicit_ && input.deformation.solver == StrainSolver::polynomial) {
    for (auto* array : {&rigid_fx_, &rigid_fy_, &rigid_moment_}) array->assign(padded_, 0.0);
  }
  if (pulls_) size_pulls();
  if (rotation_ && input.contact.kinematics == Kinematics::nonlinear) {
    for (auto* array : {&previous_dx_, &previous_dy_, &previous_rotation_, &slip_}) {
      array->assign(bonds_.neighbour.size(), 0.0);
    }
  }
}

void Stepper::set_parameters(const Assembly& a, const SimulationInput& input) {
  const double dt = input.time_step;
  for (std::size_t d = 0; d < discs_; ++d) {
    const int p = position_[d];
    kick_x_[p] = held(input.held.x, d) ? 0.0 : dt / a.mass[d];
    kick_y_[p] = held(input.held.y, d) ? 0.0 : dt / a.mass[d];
    if (rotation_) kick_theta_[p] = held(input.held.theta, d) ? 0.0 : dt / a.mass[d];
  }
  if (drive_) {
    auto& kick = drive_->direction == Direction::x ? kick_x_ : kick_y_;
    for (const int d : drive_->discs) {
      kick[position_[d]] = 0.0;
      driven_places_.push_back(position_[d]);
    }
    std::sort(driven_places_.begin(), driven_places_.end());
  }
  for (auto* kick : {&kick_y_, &kick_theta_}) {
    if (*kick == kick_x_) *kick = AlignedVector<double>();
  }
  data_.dt = dt;
  data_.normal_stiffness = input.contact.normal_stiffness;
  data_.shear_stiffness = input.contact.shear_stiffness();
  data_.stiffness_ratio = input.contact.stiffness_ratio;
}

void Stepper::prepare_strains(const Assembly& a, const SimulationInput& input) {
  const DeformationParameters& deformation = input.deformation;
  const double volume = volume_over_square_radius(a, deformation);
  Compliance c = disc_compliance(deformation);
  for (double* component : {&c.direct, &c.coupling, &c.shear}) *component /= volume;
  data_.compliance_direct = c.direct;
  data_.compliance_coupling = c.coupling;
  data_.compliance_shear = c.shear;
  data_.keep_strain = 1.0 - deformation.relaxation;
  data_.new_strain = deformation.relaxation;
  if (!implicit_) {
    strain_stages_ = deformation.evaluations - 1;
  } else if (deformation.solver == StrainSolver::conjugate_gradients) {
    gradients_.emplace(padded_, c, deformation.tolerance);
  } else {
    relaxations_ = input.relaxations.empty() ? strain_relaxations(a, input.contact, deformation) : input.relaxations;
    strain_stages_ = static_cast<int>(relaxations_.size());
  }
}

/// The strains first, then the motion. Lagged: further evaluations; implicit: source and iterations, or conjugate
/// gradients.
void Stepper::begin_step(bool may_be_free) {
  free_ = may_be_free && finds_free_steps();
  if (watch_ && implicit_ && !free_) recall_contacts();
  begin_strains();
}

void Stepper::begin_strains() {
  stages_done_ = 0;
  in_one_sweep_ = (!watch_ || free_) && strains_fit_a_sweep();
  if (gradients_) {
    begin_stage(Stage::residual);
  } else if (strain_stages_ == 0 || in_one_sweep_) {
    begin_stage(Stage::motion);
  } else {
    begin_stage(implicit_ ? Stage::source : Stage::evaluate);
  }
}

/// For an iteration, from 1 on: eps <- eps + w (f - eps - T eps). The first two relaxations from zero are one sweep of f.
StepData Stepper::relaxed(StepData d, int iteration) const {
  const bool first = iteration == 1;
  const double w = relaxations_[iteration], before = relaxations_[0];
  if (first) d.strain = source_.data();
  d.of_strain = first ? 0.0 : 1.0 - w;
  d.of_source = first ? before + w * (1.0 - before) : w;
  d.of_coupling = first ? w * before : w;
  return d;
}

SliceFunction Stepper::iteration(int iteration) const {
  if (iteration == 1) return kernels_.first_iterate;
  return iteration + 1 == strain_stages_ ? kernels_.last_iterate : kernels_.iterate;
}

void Stepper::begin_stage(Stage stage) {
  stage_ = stage;
  if (watch_ && !free_ && (stage == Stage::evaluate || stage == Stage::motion)) {
    look_for_contacts();
    if (implicit_ && !contacts_agree()) return begin_strains();
  }
  if (stage == Stage::iterate) data_ = relaxed(data_, stages_done_);
  switch (stage) {
    case Stage::evaluate: due_ = kernels_.evaluate; break;
    case Stage::source: due_ = kernels_.source; break;
    case Stage::iterate: due_ = iteration(stages_done_); break;
    case Stage::residual: due_ = kernels_.residual; break;
    case Stage::apply: due_ = kernels_.apply; break;
    case Stage::advance: due_ = kernels_.advance; break;
    case Stage::turn: due_ = kernels_.turn; break;
    case Stage::motion:
    case Stage::seams: break;
  }
  follow_front(stage == Stage::motion ? sweeps_a_step() : 1);
}

void Stepper::find_fronts() {
  std::vector<char> moving(padded_, 0);
  for (std::size_t p = 0; p < padded_; ++p) {
    const double* u = motion_.data() + kQuad * p;
    moving[p] = u[0] != 0.0 || u[1] != 0.0 || u[2] != 0.0 || vx_[p] != 0.0 || vy_[p] != 0.0 ||
                (rotation_ && omega_[p] != 0.0);
  }
  if (drive_) {
    for (const int d : drive_->discs) moving[position_[d]] = 1;
  }
  fronts_ = motion_fronts(bonds_, moving);
}

/// The front of so many sweeps from here. A new contact passes motion on where no bond does.
int Stepper::front_after(int sweeps) const {
  if (fronts_.empty() || (watch_ && !watch_->closed().empty())) return bonds_.slices;
  return fronts_[std::min(sweep_ + static_cast<std::size_t>(sweeps), fronts_.size()) - 1];
}

/// Before so many sweeps, or passes of one.
void Stepper::follow_front(int sweeps) {
  if (sweeps == 0 || (range_begin_.back() == bonds_.slices && sweep_ > 0)) return;
  share(front_after(sweeps));
  sweep_ += static_cast<std::size_t>(sweeps);
}

void Stepper::share_among(int threads) {
  const int front = range_begin_.back();
  range_begin_.resize(static_cast<std::size_t>(std::min(threads, std::max(1, bonds_.slices))) + 1);
  share(front);
  if (automatic_steps_) steps_at_once_ = worthwhile_steps();
  if (watch_) size_notes(), size_kept();
  if (one_sweep_pays_ || watch_) begin_step();  // other shares may leave room for the seams of a sweep, or none
}

void Stepper::take_steps(int count) {
  steps_due_ = count;
  if (count == 1) return;
  follow_front((count - 1) * sweeps_a_step());
  taps_.begin(count);
}

void Stepper::share(int front) {
  const auto threads = static_cast<long>(range_begin_.size()) - 1;
  for (long k = 0; k <= threads; ++k) range_begin_[k] = static_cast<int>(front * k / threads);
}

void Stepper::finish_strain_stage() {
  ++stages_done_;
  if (watch_ && !gradients_) add_contact_strains();
  if (!gradients_) {
    if (stage_ != Stage::source) swap_strains();
    begin_stage(stages_done_ == strain_stages_ ? Stage::motion : implicit_ ? Stage::iterate : Stage::evaluate);
    return;
  }
  if (stage_ == Stage::advance) swap_strains();
  begin_stage(gradients_->next(stage_, data_));
}

bool Stepper::finish_stage() {
  if (stage_ == Stage::motion && threads() > 1) {
    stage_ = Stage::seams;  // of the same shares
    return false;
  }
  if (stage_ != Stage::motion && stage_ != Stage::seams) {
    finish_strain_stage();
    return false;
  }
  if (free_ && !was_free()) {
    take_back();
    return false;
  }
  if (watch_ && !free_) finish_contacts();
  step_number_ += steps_taken_ = steps_due_;
  // The motion of a lagged step has written the strains to come.
  if (!implicit_ && steps_taken_ % 2 == 1) swap_strains();
  begin_step();
  return true;
}

void Stepper::swap_strains() {
  std::swap(strain_, strain_next_);
  std::swap(press_, press_next_);
  data_.strain = strain_.data(), data_.strain_next = strain_next_.data();
  data_.press = press_.data(), data_.press_next = press_next_.data();
}

void Stepper::bind() {
  StepData& d = data_;
  d.row_begin = bonds_.row_begin.data(), d.neighbour = bonds_.neighbour.data();
  d.nx = bonds_.nx.data(), d.ny = bonds_.ny.data(), d.stretch = bonds_.stretch.data(), d.length = bonds_.length.data();
  d.bond_stiffness = bonds_.stiffness.data();
  if (gradients_) gradients_->bind(d);
  d.motion = motion_.data();
  d.vx = vx_.data(), d.vy = vy_.data(), d.omega = omega_.data();
  d.kick_x = kick_x_.data(), d.kick_y = kick_y_.empty() ? d.kick_x : kick_y_.data();
  d.kick_theta = kick_theta_.empty() ? d.kick_x : kick_theta_.data();
  d.strain = strain_.data(), d.strain_next = strain_next_.data(), d.source = source_.data();
  d.pull = pull_.data(), d.press = press_.data(), d.press_next = press_next_.data(), d.other_end = other_end_.data();
  d.dyad_xx = dyad_xx_.data(), d.dyad_yy = dyad_yy_.data(), d.dyad_xy = dyad_xy_.data();
  d.fastest = fastest_.data(), d.most_strained = most_strained_.data();
  d.rigid_fx = rigid_fx_.data(), d.rigid_fy = rigid_fy_.data(), d.rigid_moment = rigid_moment_.data();
  d.previous_dx = previous_dx_.data(), d.previous_dy = previous_dy_.data();
  d.previous_rotation = previous_rotation_.data(), d.slip = slip_.data();
}

}  // namespace ddem
