#include "dem/simulation/stepper.h"

#include <cmath>
#include <utility>

#include "dem/spectra/spectra.h"

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

bool held(const std::vector<std::uint8_t>& mask, std::size_t disc) { return !mask.empty() && mask[disc]; }

}  // namespace

Stepper::Stepper(const Assembly& a, const SimulationInput& input, InstructionSet isa)
    : position_(locality_order(a.packing)),
      discs_(a.size()),
      rotation_(input.contact.has_rotation()),
      deformable_(input.deformation.active()),
      drive_(input.drive),
      implicit_(input.deformation.scheme == Scheme::implicit) {
  bonds_ = slice_bonds(a.bonds, position_);
  padded_ = static_cast<std::size_t>(bonds_.slices) * kLanes;
  for (auto* array : {&ux_, &uy_, &ux_next_, &uy_next_, &vx_, &vy_, &kick_x_, &kick_y_}) array->assign(padded_, 0.0);
  if (rotation_) {
    for (auto* array : {&theta_, &theta_next_, &omega_, &kick_theta_}) array->assign(padded_, 0.0);
  }
  if (deformable_) {
    for (auto* array : {&exx_, &eyy_, &exy_, &exx_next_, &eyy_next_, &exy_next_, &inverse_volume_}) {
      array->assign(padded_, 0.0);
    }
  }
  if (implicit_) {
    for (auto* array : {&source_xx_, &source_yy_, &source_xy_, &change_xx_, &change_yy_, &change_xy_}) {
      array->assign(padded_, 0.0);
    }
    // Lanczos finds the radius to 1e-5 or better; beyond the interval the iteration would grow.
    const double radius = fixed_point_radius(a, input.contact, input.deformation);
    chebyshev_ = chebyshev_weights(radius * (1.0 + 1e-3), input.deformation.tolerance);
  }
  stages_ = implicit_ ? static_cast<int>(chebyshev_.size()) + 1 : deformable_ ? input.deformation.evaluations : 1;
  const bool nonlinear = input.contact.kinematics == Kinematics::nonlinear;
  if (nonlinear && rotation_) {
    for (auto* array : {&previous_dx_, &previous_dy_, &previous_rotation_, &slip_}) {
      array->assign(bonds_.neighbour.size(), 0.0);
    }
  }
  const double dt = input.time_step;
  for (std::size_t d = 0; d < discs_; ++d) {
    const int p = position_[d];
    kick_x_[p] = held(input.held.x, d) ? 0.0 : dt / a.mass[d];
    kick_y_[p] = held(input.held.y, d) ? 0.0 : dt / a.mass[d];
    if (rotation_) kick_theta_[p] = held(input.held.theta, d) ? 0.0 : dt / a.inertia[d];
    if (deformable_) inverse_volume_[p] = 1.0 / a.volume[d];
  }
  if (drive_) {
    auto& kick = drive_->direction == Direction::x ? kick_x_ : kick_y_;
    for (const int d : drive_->discs) kick[position_[d]] = 0.0;
  }
  data_.dt = dt;
  data_.normal_stiffness = input.contact.normal_stiffness;
  data_.shear_stiffness = input.contact.shear_stiffness();
  if (deformable_) {
    const Compliance c = disc_compliance(input.deformation);
    data_.compliance_direct = c.direct;
    data_.compliance_coupling = c.coupling;
    data_.compliance_shear = c.shear;
    data_.keep_strain = 1.0 - input.deformation.relaxation;
    data_.new_strain = input.deformation.relaxation;
  }
  kernels_ = step_kernels({rotation_, nonlinear, coupling(input.deformation), implicit_}, isa);
  load(input.initial);
  start_leapfrog();
  begin_stage(0);
}

/// Implicit: source, iterations, motion. Lagged: further evaluations of the strains, motion.
void Stepper::begin_stage(int stage) {
  stage_ = stage;
  if (stage == stages_ - 1) {
    due_ = kernels_.step;
  } else if (implicit_) {
    due_ = stage == 0 ? kernels_.source : kernels_.iterate;
    data_.first_weight = chebyshev_[stage].first;
    data_.change_weight = chebyshev_[stage].change;
    data_.residual_weight = chebyshev_[stage].residual;
  } else {
    due_ = kernels_.evaluate;
  }
}

void Stepper::load(const InitialState& s) {
  const auto copy = [&](const std::vector<double>& from, AlignedVector<double>& to) {
    if (to.empty()) return;
    for (std::size_t d = 0; d < from.size(); ++d) to[position_[d]] = from[d];
  };
  copy(s.ux, ux_), copy(s.uy, uy_), copy(s.theta, theta_);
  copy(s.vx, vx_), copy(s.vy, vy_), copy(s.omega, omega_);
  if (drive_) impose(0.0, ux_, uy_);
  bind();
}

/// The step kernel takes v_{n-1/2} to v_{n+1/2}. From v_0 it needs v_{-1/2} = v_0 - dt a_0 / 2; a_0 comes from one step
/// of the kernel itself from rest, whose results are then forgotten.
void Stepper::start_leapfrog() {
  AlignedVector<double> vx(padded_, 0.0), vy(padded_, 0.0), omega(omega_.size(), 0.0);
  if (implicit_) {
    for (int stage = 0; stage < stages_ - 1; ++stage) {
      begin_stage(stage);
      advance(0, bonds_.slices);
      swap_strains();
    }
  }
  StepData d = data_;
  d.vx = vx.data(), d.vy = vy.data(), d.omega = omega.data();
  kernels_.step(d, 0, bonds_.slices);
  for (std::size_t p = 0; p < padded_; ++p) {
    vx_[p] -= 0.5 * vx[p];
    vy_[p] -= 0.5 * vy[p];
    if (rotation_) omega_[p] -= 0.5 * omega[p];
  }
}

void Stepper::impose(double time, AlignedVector<double>& ux, AlignedVector<double>& uy) const {
  AlignedVector<double>& u = drive_->direction == Direction::x ? ux : uy;
  const double value = drive_->displacement(time);
  for (const int d : drive_->discs) u[position_[d]] = value;
}

bool Stepper::finish_stage() {
  const bool last = stage_ == stages_ - 1;
  if (last) {
    ++step_number_;
    if (drive_) impose(static_cast<double>(step_number_) * data_.dt, ux_next_, uy_next_);
    std::swap(ux_, ux_next_);
    std::swap(uy_, uy_next_);
    std::swap(theta_, theta_next_);
  }
  // The motion of an implicit step leaves the strains as they are; every other stage has written new ones.
  if (!(last && implicit_)) swap_strains();
  bind();
  begin_stage(last ? 0 : stage_ + 1);
  return last;
}

void Stepper::swap_strains() {
  std::swap(exx_, exx_next_);
  std::swap(eyy_, eyy_next_);
  std::swap(exy_, exy_next_);
  bind();
}

StrainView Stepper::strains_in_use() const {
  if (implicit_) return {exx_.data(), eyy_.data(), exy_.data()};
  return {exx_next_.data(), eyy_next_.data(), exy_next_.data()};
}

void Stepper::bind() {
  StepData& d = data_;
  d.row_begin = bonds_.row_begin.data(), d.neighbour = bonds_.neighbour.data();
  d.nx = bonds_.nx.data(), d.ny = bonds_.ny.data(), d.length = bonds_.length.data();
  d.arm_own = bonds_.arm_own.data(), d.arm_other = bonds_.arm_other.data();
  d.ux = ux_.data(), d.uy = uy_.data(), d.theta = theta_.data();
  d.ux_next = ux_next_.data(), d.uy_next = uy_next_.data(), d.theta_next = theta_next_.data();
  d.vx = vx_.data(), d.vy = vy_.data(), d.omega = omega_.data();
  d.kick_x = kick_x_.data(), d.kick_y = kick_y_.data(), d.kick_theta = kick_theta_.data();
  d.exx = exx_.data(), d.eyy = eyy_.data(), d.exy = exy_.data();
  d.exx_next = exx_next_.data(), d.eyy_next = eyy_next_.data(), d.exy_next = exy_next_.data();
  d.inverse_volume = inverse_volume_.data();
  d.source_xx = source_xx_.data(), d.source_yy = source_yy_.data(), d.source_xy = source_xy_.data();
  d.change_xx = change_xx_.data(), d.change_yy = change_yy_.data(), d.change_xy = change_xy_.data();
  d.previous_dx = previous_dx_.data(), d.previous_dy = previous_dy_.data();
  d.previous_rotation = previous_rotation_.data(), d.slip = slip_.data();
}

int Stepper::diverged_disc(double bound) const {
  for (std::size_t d = 0; d < discs_; ++d) {
    const int p = position_[d];
    if (!(std::abs(ux_[p]) <= bound && std::abs(uy_[p]) <= bound)) return static_cast<int>(d);
  }
  return -1;
}

InitialState Stepper::state() const {
  InitialState s;
  const auto copy = [&](const AlignedVector<double>& from, std::vector<double>& to) {
    to.assign(discs_, 0.0);
    if (from.empty()) return;
    for (std::size_t d = 0; d < discs_; ++d) to[d] = from[position_[d]];
  };
  copy(ux_, s.ux), copy(uy_, s.uy), copy(theta_, s.theta);
  copy(vx_, s.vx), copy(vy_, s.vy), copy(omega_, s.omega);
  return s;
}

}  // namespace ddem
