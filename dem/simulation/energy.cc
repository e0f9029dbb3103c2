#include "dem/simulation/energy.h"

#include <utility>

namespace ddem {

EnergyAudit::EnergyAudit(const Assembly& assembly, const ContactParameters& contact,
                         const DeformationParameters& deformation, std::vector<int> position)
    : assembly_(assembly), contact_(contact), deformation_(deformation), position_(std::move(position)) {}

EnergyAudit::Overlaps EnergyAudit::rigid_overlaps(std::size_t c, const MotionView& u) const {
  const Bonds& b = assembly_.bonds;
  const int i = position_[b.i[c]], j = position_[b.j[c]];
  const double nx = b.nx[c], ny = b.ny[c];
  const double dx = u.ux[j] - u.ux[i], dy = u.uy[j] - u.uy[i];
  Overlaps w{nx * dx + ny * dy, 0.0};
  if (contact_.has_rotation()) {
    w.tangential = nx * dy - ny * dx - (b.arm_i[c] * u.theta[i] + b.arm_j[c] * u.theta[j]);
  }
  return w;
}

/// G eps of a bond.
EnergyAudit::Overlaps EnergyAudit::correction(std::size_t c, const StrainView& e) const {
  const Bonds& b = assembly_.bonds;
  const int i = position_[b.i[c]], j = position_[b.j[c]];
  const double nx = b.nx[c], ny = b.ny[c];
  const auto n_eps_n = [&](int p) { return nx * nx * e.exx[p] + ny * ny * e.eyy[p] + 2.0 * nx * ny * e.exy[p]; };
  const auto t_eps_n = [&](int p) { return nx * ny * (e.eyy[p] - e.exx[p]) + (nx * nx - ny * ny) * e.exy[p]; };
  Overlaps g{b.arm_i[c] * n_eps_n(i) + b.arm_j[c] * n_eps_n(j), 0.0};
  if (contact_.has_rotation() && deformation_.correction == Correction::full) {
    g.tangential = b.arm_i[c] * t_eps_n(i) + b.arm_j[c] * t_eps_n(j);
  }
  return g;
}

double EnergyAudit::strain_energy(const StrainView& e) const {
  const Compliance d = disc_compliance(deformation_);
  const double det = d.direct * d.direct - d.coupling * d.coupling;
  double sum = 0.0;
  for (std::size_t disc = 0; disc < assembly_.size(); ++disc) {
    const int p = position_[disc];
    const double quadratic = (d.direct * (e.exx[p] * e.exx[p] + e.eyy[p] * e.eyy[p]) - 2.0 * d.coupling * e.exx[p] * e.eyy[p]) / det +
                             2.0 * e.exy[p] * e.exy[p] / d.shear;
    sum += 0.5 * assembly_.volume[disc] * quadratic;
  }
  return sum;
}

double EnergyAudit::energy(const MotionView& now, const MotionView& next, const VelocityView& v,
                           const StrainView& strain) const {
  double sum = 0.0;
  for (std::size_t disc = 0; disc < assembly_.size(); ++disc) {
    const int p = position_[disc];
    sum += 0.5 * assembly_.mass[disc] * (v.vx[p] * v.vx[p] + v.vy[p] * v.vy[p]);
    if (contact_.has_rotation()) sum += 0.5 * assembly_.inertia[disc] * v.omega[p] * v.omega[p];
  }
  const bool lagged = deformation_.scheme == Scheme::lagged;
  for (std::size_t c = 0; c < assembly_.bonds.size(); ++c) {
    Overlaps w = rigid_overlaps(c, now), e = rigid_overlaps(c, next);
    if (deformation_.active()) {
      const Overlaps g = correction(c, strain);
      w.normal -= g.normal;
      w.tangential -= g.tangential;
      if (lagged) {
        e.normal -= g.normal;
        e.tangential -= g.tangential;
      }
    }
    sum += 0.5 * (contact_.normal_stiffness * w.normal * e.normal + contact_.shear_stiffness() * w.tangential * e.tangential);
  }
  return lagged ? sum + strain_energy(strain) : sum;
}

}  // namespace ddem
