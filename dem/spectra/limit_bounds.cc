#include "dem/spectra/limit_bounds.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/assembly/bond_stiffness.h"
#include "dem/assembly/particle_volume.h"
#include "dem/statics/operators.h"

namespace ddem {

double fixed_point_bound(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation) {
  const std::vector<double> k_n = normal_stiffnesses(a, contact), volume = particle_volumes(a, deformation);
  std::vector<Eigen::Matrix3d> squares(a.size(), Eigen::Matrix3d::Zero());  // sum of k g g^T
  for (std::size_t c = 0; c < a.bonds.size(); ++c) {
    const BondRows rows = bond_rows(a.bonds, c, 1.0, deformation);
    for (const int side : {0, 1}) {
      Eigen::Matrix3d& of_disc = squares[static_cast<std::size_t>(side == 0 ? a.bonds.i[c] : a.bonds.j[c])];
      for (const int row : {0, 1}) {
        const Eigen::Map<const Eigen::Vector3d> g(rows.strain[static_cast<std::size_t>(row)][static_cast<std::size_t>(side)].data());
        of_disc += k_n[c] * (row == 0 ? 1.0 : contact.stiffness_ratio) * (g * g.transpose());
      }
    }
  }
  // D is the inverse of C_p; the work conjugate of eps_xy is 2 s_xy.
  const Compliance d = disc_compliance(deformation);
  Eigen::Matrix3d compliance;
  compliance << d.direct, d.coupling, 0.0, d.coupling, d.direct, 0.0, 0.0, 0.0, 0.5 * d.shear;
  const Eigen::Matrix3d lower = compliance.llt().matrixL();
  double most = 0.0;
  for (std::size_t p = 0; p < a.size(); ++p) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of_disc(lower.transpose() * squares[p] * lower, Eigen::EigenvaluesOnly);
    most = std::max(most, of_disc.eigenvalues()[2] / volume[p]);
  }
  return 2.0 * most;
}

double flip_limit_bound(const Assembly& a, const ContactParameters& contact, DeformationParameters d, double rigid_critical_step) {
  if (d.evaluations % 2 == 0 || (d.correction == Correction::normal && d.evaluations != 1)) return 0.0;
  const double reach = 2.0 / d.relaxation - 1.0, radius = fixed_point_bound(a, contact, d);
  if (!(radius < reach)) return 0.0;
  double stiffer = reach / (reach - radius);
  if (d.correction == Correction::normal) {
    d.correction = Correction::full;
    stiffer = 1.0 + std::sqrt(radius * fixed_point_bound(a, contact, d)) / (reach - radius);
  }
  return rigid_critical_step / std::sqrt(stiffer);
}

}  // namespace ddem
