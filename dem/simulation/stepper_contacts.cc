// What new contacts add to a step: a push, and to the strains what their forces make of them. The kernels know of bonds
// only; both are added on one thread after their sweeps, in a fixed order, so that a run in which nothing closes has the
// bits of one that does not watch.

#include <algorithm>
#include <cmath>

#include "dem/simulation/stepper.h"
#include "dem/spectra/spectra.h"
#include "dem/spectra/strain_spectrum.h"

namespace ddem {
namespace {

/// The energy of closed contacts and strains is convex and made of few parabolas: the set settles in a handful of trials.
constexpr int kMostDecisions = 50;

bool same_pairs(const std::vector<NewContact>& a, const std::vector<NewContact>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const NewContact& x, const NewContact& y) { return x.i == y.i && x.j == y.j; });
}

/// As the kernels note it: twice this bounds the square of the norm, in which eps_xy counts twice.
double square_of_strain(const double* strain, int p) {
  const double* e = strain + static_cast<std::ptrdiff_t>(kQuad) * p;
  return e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
}

}  // namespace

void Stepper::look_for_contacts() {
  if (gradients_) {
    double most = 0.0;
    for (std::size_t p = 0; p < padded_; ++p) most = std::max(most, square_of_strain(strain_.data(), static_cast<int>(p)));
    largest_strain_ = std::sqrt(2.0 * most);
  }
  watch_->look(motion_.data(), deformable_ ? strain_.data() : nullptr, largest_strain_);
}

/// Implicit strains are sought with the contacts of the step before, where they are now.
void Stepper::recall_contacts() {
  decisions_ = 0;
  for (NewContact& c : assumed_) c.rigid_gap = c.rigid_gap_at(motion_.data());
}

/// Whether the contacts that the strains were sought with are those that are closed under them; else the next trial is with
/// these.
bool Stepper::contacts_agree() {
  const std::vector<NewContact>& closed = watch_->closed();
  if (same_pairs(closed, assumed_)) return true;
  if (gradients_ || ++decisions_ > kMostDecisions) {
    assumed_ = closed;
    undecided_ = true;
    return true;
  }
  assumed_ = closed;
  if (!contacts_in_polynomial_) {
    // The coupling reaches further with contacts than without.
    contacts_in_polynomial_ = true;
    StrainSpectrum s = strain_spectrum(assembly_, contact_, deformation_);
    s.radius = std::max(s.radius, fixed_point_radius(watch_->all_closed(), contact_, deformation_));
    relaxations_ = strain_relaxations(s, deformation_.tolerance);
    strain_stages_ = static_cast<int>(relaxations_.size());
  }
  return false;
}

/// r eps = D r^2 / V_p : sum s n (x) F of the contact alone, on both discs.
void Stepper::add_strain(const NewContact& c, double force, double weight, AlignedVector<double>& to) const {
  const double g = weight * c.stretch * force;
  const double sxx = g * c.nx * c.nx, syy = g * c.ny * c.ny, sxy = g * c.nx * c.ny;
  for (const int p : {c.i, c.j}) {
    double* e = to.data() + static_cast<std::ptrdiff_t>(kQuad) * p;
    e[0] += data_.compliance_direct * sxx + data_.compliance_coupling * syy;
    e[1] += data_.compliance_coupling * sxx + data_.compliance_direct * syy;
    e[2] += data_.compliance_shear * sxy;
  }
}

/// To what the stage at hand has written, and the bound of it.
void Stepper::add_contact_strains() {
  const std::vector<NewContact>& pushing = implicit_ ? assumed_ : watch_->closed();
  for (const NewContact& c : pushing) {
    if (stage_ == Stage::source) {
      add_strain(c, c.stiffness * c.rigid_gap, 1.0, source_);
    } else if (stage_ == Stage::iterate) {
      add_strain(c, -c.stiffness * c.approach(data_.strain), data_.of_coupling, strain_next_);
    } else {
      add_strain(c, c.force(), data_.new_strain, strain_next_);
    }
  }
  if (kernels_.press) {
    StepData written = data_;
    if (stage_ == Stage::source) written.strain_next = source_.data(), written.press_next = press_.data();
    for (const NewContact& c : pushing) {
      for (const int p : {c.i, c.j}) kernels_.press(written, p / kLanes, p / kLanes + 1);
    }
  }
  if (stage_ == Stage::source) return;
  double most = take_largest(most_strained_);
  for (const NewContact& c : pushing) {
    for (const int p : {c.i, c.j}) {
      most = std::max(most, square_of_strain(strain_next_.data(), p));
    }
  }
  largest_strain_ = std::sqrt(2.0 * most);
}

/// A line of the cache for each thread.
void Stepper::size_notes() {
  for (auto* array : {&fastest_, &most_strained_}) array->assign(static_cast<std::size_t>(threads()) * kLanes, 0.0);
  data_.fastest = fastest_.data(), data_.most_strained = most_strained_.data();
}

/// What the threads have noted since the last time; not a number where one of it is none.
double Stepper::take_largest(AlignedVector<double>& noted) const {
  double most = 0.0;
  for (double& one : noted) most = one <= most || std::isnan(most) ? most : one, one = 0.0;
  return most;
}

/// The longest way of a driven edge in one of the next steps.
double Stepper::furthest_driven(int steps) const {
  double most = 0.0;
  if (!drive_) return most;
  for (int k = 0; k < steps; ++k) {
    const double now = static_cast<double>(step_number_ + k) * data_.dt;
    most = std::max(most, std::abs(drive_->displacement(now + data_.dt) - drive_->displacement(now)));
  }
  return most;
}

/// The kick of the closed contacts on velocities that start from zero.
void Stepper::push_from_rest(double* vx, double* vy) const {
  for (const NewContact& c : watch_->closed()) {
    const double fx = c.force() * c.nx, fy = c.force() * c.ny;
    vx[c.i] += data_.kick_x[c.i] * fx, vy[c.i] += data_.kick_y[c.i] * fy;
    vx[c.j] -= data_.kick_x[c.j] * fx, vy[c.j] -= data_.kick_y[c.j] * fy;
  }
}

/// After the motion of the bonds: the push of the contacts, and how far the fastest disc has come.
void Stepper::finish_contacts() {
  in_use_ = watch_->closed();
  if (deformable_ && !implicit_) add_contact_strains();
  double fastest = take_largest(fastest_);
  const auto push = [&](int p, double fx, double fy) {
    double* u = motion_.data() + static_cast<std::ptrdiff_t>(kQuad) * p;
    vx_[p] += data_.kick_x[p] * fx, vy_[p] += data_.kick_y[p] * fy;
    u[0] += data_.dt * (data_.kick_x[p] * fx), u[1] += data_.dt * (data_.kick_y[p] * fy);
    fastest = std::max(fastest, vx_[p] * vx_[p] + vy_[p] * vy_[p]);
  };
  for (const NewContact& c : in_use_) {
    const double fx = c.force() * c.nx, fy = c.force() * c.ny;
    push(c.i, fx, fy);
    push(c.j, -fx, -fy);
    for (const int p : {c.i, c.j}) pull(0, p / kLanes, p / kLanes + 1);
  }
  watch_->moved(std::max(data_.dt * std::sqrt(fastest), furthest_driven(1)));
  if (in_use_.empty()) return;
  if (!count_) count_ = NewContactCount{step_number_, 0, 0.0};
  count_->most = std::max(count_->most, in_use_.size());
}

}  // namespace ddem
