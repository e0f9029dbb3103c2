#include "dem/simulation/audit.h"

#include <utility>

#include "dem/assembly/bond_stiffness.h"
#include "dem/assembly/particle_volume.h"

namespace ddem {

struct StateAudit::Load {
  std::vector<double> x, y, moment;
};

StateAudit::StateAudit(const Assembly& assembly, const ContactParameters& contact, const DeformationParameters& deformation,
                       std::vector<int> position)
    : assembly_(assembly),
      contact_(contact),
      deformation_(deformation),
      position_(std::move(position)),
      disc_at_(position_.size()),
      normal_stiffness_(normal_stiffnesses(assembly, contact)),
      volume_(particle_volumes(assembly, deformation)) {
  for (std::size_t d = 0; d < position_.size(); ++d) disc_at_[position_[d]] = static_cast<int>(d);
}

StateAudit::Overlaps StateAudit::rigid_overlaps(std::size_t c, const MotionView& u) const {
  const Bonds& b = assembly_.bonds;
  const int i = position_[b.i[c]], j = position_[b.j[c]];
  const double nx = b.nx[c], ny = b.ny[c];
  const double dx = u.ux(j) - u.ux(i), dy = u.uy(j) - u.uy(i);
  Overlaps w{nx * dx + ny * dy, 0.0};
  if (contact_.has_rotation()) {
    w.tangential = nx * dy - ny * dx - (b.arm_i[c] * u.theta(i, radius(b.i[c])) + b.arm_j[c] * u.theta(j, radius(b.j[c])));
  }
  return w;
}

/// G eps of a bond.
StateAudit::Overlaps StateAudit::correction(std::size_t c, const StrainView& e) const {
  if (!deformation_.active()) return {0.0, 0.0};
  const Bonds& b = assembly_.bonds;
  const double nx = b.nx[c], ny = b.ny[c];
  Overlaps g{0.0, 0.0};
  for (const auto& [disc, arm] : {std::pair(b.i[c], b.arm_i[c]), std::pair(b.j[c], b.arm_j[c])}) {
    const int p = position_[disc];
    const double r = radius(disc), xx = e.xx(p, r), yy = e.yy(p, r), xy = e.xy(p, r);
    g.normal += arm * (nx * nx * xx + ny * ny * yy + 2.0 * nx * ny * xy);
    if (contact_.has_rotation() && deformation_.correction == Correction::full) {
      g.tangential += arm * (nx * ny * (yy - xx) + (nx * nx - ny * ny) * xy);
    }
  }
  return g;
}

StateAudit::Overlaps StateAudit::corrected_overlaps(std::size_t c, const MotionView& u, const StrainView& strain) const {
  const Overlaps w = rigid_overlaps(c, u), g = correction(c, strain);
  return {w.normal - g.normal, w.tangential - g.tangential};
}

StateAudit::Overlaps StateAudit::forces(std::size_t c, const Overlaps& w) const {
  const double k_n = normal_stiffness_[c];
  return {k_n * w.normal, contact_.stiffness_ratio * k_n * w.tangential};
}

double StateAudit::strain_energy(const StrainView& e) const {
  const Compliance d = disc_compliance(deformation_);
  const double det = d.direct * d.direct - d.coupling * d.coupling;
  double sum = 0.0;
  for (std::size_t disc = 0; disc < assembly_.size(); ++disc) {
    const int p = position_[disc];
    const double r = radius(static_cast<int>(disc)), xx = e.xx(p, r), yy = e.yy(p, r), xy = e.xy(p, r);
    const double quadratic = (d.direct * (xx * xx + yy * yy) - 2.0 * d.coupling * xx * yy) / det + 2.0 * xy * xy / d.shear;
    sum += 0.5 * volume_[disc] * quadratic;
  }
  return sum;
}

void StateAudit::add_force(std::size_t c, const Overlaps& f, Load& load) const {
  const Bonds& b = assembly_.bonds;
  const double fx = f.normal * b.nx[c] - f.tangential * b.ny[c], fy = f.normal * b.ny[c] + f.tangential * b.nx[c];
  load.x[b.i[c]] += fx, load.y[b.i[c]] += fy;
  load.x[b.j[c]] -= fx, load.y[b.j[c]] -= fy;
  load.moment[b.i[c]] += b.arm_i[c] * f.tangential;
  load.moment[b.j[c]] += b.arm_j[c] * f.tangential;
}

/// Of the velocities as they are, or half a step earlier: v_n = v_{n+1/2} - dt a_n / 2.
double StateAudit::kinetic_energy(const VelocityView& v, const Load* load) const {
  double sum = 0.0;
  for (std::size_t disc = 0; disc < assembly_.size(); ++disc) {
    const int p = position_[disc];
    const auto at = [&](double velocity, double kick, double force) { return velocity - 0.5 * kick * force; };
    const double vx = load == nullptr ? v.vx[p] : at(v.vx[p], v.kick_x[p], load->x[disc]);
    const double vy = load == nullptr ? v.vy[p] : at(v.vy[p], v.kick_y[p], load->y[disc]);
    sum += 0.5 * assembly_.mass[disc] * (vx * vx + vy * vy);
    if (contact_.has_rotation()) {
      const double r = radius(static_cast<int>(disc));
      const double omega = (load == nullptr ? v.omega[p] : at(v.omega[p], v.kick_theta[p], kRotationalKick * load->moment[disc] / r)) / r;
      sum += 0.5 * assembly_.inertia[disc] * omega * omega;
    }
  }
  return sum;
}

Energies StateAudit::energies(const State& state) const {
  const auto& [now, next, v, strain, closed] = state;
  const bool lagged = deformation_.scheme == Scheme::lagged;
  Energies e;
  double between = 0.0;  // the potential part of the invariant
  const std::size_t n = assembly_.size();
  Load load{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t c = 0; c < assembly_.bonds.size(); ++c) {
    const Overlaps w = corrected_overlaps(c, now, strain), f = forces(c, w);
    const Overlaps later = lagged ? corrected_overlaps(c, next, strain) : rigid_overlaps(c, next);
    e.contact += 0.5 * (f.normal * w.normal + f.tangential * w.tangential);
    between += 0.5 * (f.normal * later.normal + f.tangential * later.tangential);
    add_force(c, f, load);
  }
  for (const NewContact& c : closed) {
    const double later = c.rigid_gap_at(next.values) - (lagged ? c.approach(strain.values) : 0.0);
    e.contact += 0.5 * c.force() * c.gap;
    between += 0.5 * c.force() * later;
    const double fx = c.force() * c.nx, fy = c.force() * c.ny;
    load.x[disc_at_[c.i]] += fx, load.y[disc_at_[c.i]] += fy;
    load.x[disc_at_[c.j]] -= fx, load.y[disc_at_[c.j]] -= fy;
  }
  if (deformation_.active()) e.particle = strain_energy(strain);
  e.kinetic = kinetic_energy(v, &load);
  e.invariant = kinetic_energy(v, nullptr) + between + (lagged ? e.particle : 0.0);
  return e;
}

TensorField StateAudit::stress(const MotionView& now, const StrainView& strain, const std::vector<NewContact>& closed) const {
  const std::size_t n = assembly_.size();
  TensorField s{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  const bool normal_only = deformation_.active() && deformation_.correction == Correction::normal_only_stress;
  const Bonds& b = assembly_.bonds;
  for (std::size_t c = 0; c < b.size(); ++c) {
    Overlaps f = forces(c, corrected_overlaps(c, now, strain));
    if (normal_only) f.tangential = 0.0;
    const double nx = b.nx[c], ny = b.ny[c];
    const double fx = f.normal * nx - f.tangential * ny, fy = f.normal * ny + f.tangential * nx;
    // Seen from j, normal and force both turn round: the product does not.
    for (const auto& [disc, arm] : {std::pair(b.i[c], b.arm_i[c]), std::pair(b.j[c], b.arm_j[c])}) {
      const double w = arm / volume_[disc];
      s.xx[disc] += w * nx * fx;
      s.yy[disc] += w * ny * fy;
      s.xy[disc] += 0.5 * w * (nx * fy + ny * fx);
    }
  }
  for (const NewContact& c : closed) {
    for (const int place : {c.i, c.j}) {
      const int disc = disc_at_[place];
      const double w = c.stretch * radius(disc) / volume_[disc] * c.force();
      s.xx[disc] += w * c.nx * c.nx;
      s.yy[disc] += w * c.ny * c.ny;
      s.xy[disc] += w * c.nx * c.ny;
    }
  }
  return s;
}

}  // namespace ddem
