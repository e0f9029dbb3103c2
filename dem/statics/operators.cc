#include "dem/statics/operators.h"

#include <vector>

#include "dem/assembly/bond_stiffness.h"
#include "dem/assembly/particle_volume.h"

namespace ddem {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Mean radius of the network: what a scale decides, where there is no stiffness, is the same without its rattlers.
double length_scale_of(const Assembly& a) {
  const std::vector<int> discs = network_discs(a);
  if (discs.empty()) return mean_radius(a.packing);
  double sum = 0.0;
  for (const int d : discs) sum += a.packing.radius[d];
  return sum / static_cast<double>(discs.size());
}

SparseMatrix sparse(Eigen::Index rows, Eigen::Index cols, const Triplets& t) {
  SparseMatrix m(rows, cols);
  m.setFromTriplets(t.begin(), t.end());
  return m;
}

/// What a uniform strain of one disc adds to the overlaps of a bond: a n.eps.n and a t.eps.n.
struct StrainRows {
  std::array<double, 3> normal, tangential;
};

StrainRows strain_rows(double nx, double ny, double arm) {
  return {{arm * nx * nx, arm * ny * ny, arm * 2.0 * nx * ny}, {-arm * nx * ny, arm * nx * ny, arm * (nx * nx - ny * ny)}};
}

bool corrects_slip(const DeformationParameters& d) { return d.correction == Correction::full; }
bool takes_shear_forces(const DeformationParameters& d) { return d.correction != Correction::normal_only_stress; }

void add_deformation(Operators& op, const Assembly& a, const DeformationParameters& deformation) {
  const Bonds& b = a.bonds;
  const Eigen::Index rows = op.overlap.rows(), strains = 3 * static_cast<Eigen::Index>(a.size());
  const bool tangential = op.rows_per_bond == 2;
  const bool correct_slip = tangential && corrects_slip(deformation);
  const bool stress_of_shear = tangential && takes_shear_forces(deformation);
  Triplets g, s, vc;
  for (int c = 0; c < static_cast<int>(b.size()); ++c) {
    const BondRows bond = bond_rows(b, static_cast<std::size_t>(c), op.length_scale, deformation);
    const int row = op.rows_per_bond * c;
    for (const int side : {0, 1}) {
      const int disc = 3 * (side == 0 ? b.i[c] : b.j[c]);
      for (int k = 0; k < 3; ++k) {
        g.emplace_back(row, disc + k, bond.strain[0][side][k]);
        s.emplace_back(disc + k, row, bond.stress[0][side][k]);
        if (correct_slip) g.emplace_back(row + 1, disc + k, bond.strain[1][side][k]);
        if (stress_of_shear) s.emplace_back(disc + k, row + 1, bond.stress[1][side][k]);
      }
    }
  }
  const Compliance d = disc_compliance(deformation);
  const std::vector<double> volume = particle_volumes(a, deformation);
  const double det = d.direct * d.direct - d.coupling * d.coupling;
  for (int p = 0; p < static_cast<int>(a.size()); ++p) {
    // Work conjugate of (eps_xx, eps_yy, eps_xy) is (s_xx, s_yy, 2 s_xy); strains carry the length scale.
    const double v = volume[p] / (op.length_scale * op.length_scale);
    vc.insert(vc.end(), {{3 * p, 3 * p, v * d.direct / det},
                         {3 * p, 3 * p + 1, -v * d.coupling / det},
                         {3 * p + 1, 3 * p, -v * d.coupling / det},
                         {3 * p + 1, 3 * p + 1, v * d.direct / det},
                         {3 * p + 2, 3 * p + 2, v * 2.0 / d.shear}});
  }
  op.strain_overlap = sparse(rows, strains, g);
  op.stress = sparse(strains, rows, s);
  op.strain_stiffness = sparse(strains, strains, vc);
}

}  // namespace

SparseMatrix Operators::stiffness_matrix() const {
  return SparseMatrix(overlap.transpose()) * stiffness.asDiagonal() * overlap;
}

/// u_n = n.(u_j - u_i), u_t = t.(u_j - u_i) - a_i theta_i - a_j theta_j, t = (-n_y, n_x).
BondRows bond_rows(const Bonds& b, std::size_t c, double length_scale, const DeformationParameters& deformation) {
  const double nx = b.nx[c], ny = b.ny[c], arm_i = b.arm_i[c] / length_scale, arm_j = b.arm_j[c] / length_scale;
  BondRows r{};
  r.overlap = {{{{{-nx, -ny, 0.0}, {nx, ny, 0.0}}}, {{{ny, -nx, -arm_i}, {-ny, nx, -arm_j}}}}};
  const StrainRows of[] = {strain_rows(nx, ny, arm_i), strain_rows(nx, ny, arm_j)};
  for (const int side : {0, 1}) {
    r.strain[0][side] = r.stress[0][side] = of[side].normal;
    if (corrects_slip(deformation)) r.strain[1][side] = of[side].tangential;
    if (takes_shear_forces(deformation)) r.stress[1][side] = of[side].tangential;
  }
  return r;
}

OperatorFrame operator_frame(const Assembly& a, const ContactParameters& contact, const DeformationParameters& deformation) {
  OperatorFrame op;
  op.dofs_per_disc = contact.has_rotation() ? 3 : 2;
  op.rows_per_bond = contact.has_rotation() ? 2 : 1;
  op.length_scale = length_scale_of(a);
  op.stiffness.resize(op.rows_per_bond * static_cast<Eigen::Index>(a.bonds.size()));
  const std::vector<double> k_n = normal_stiffnesses(a, contact);
  for (Eigen::Index r = 0; r < op.stiffness.size(); ++r) {
    op.stiffness[r] = k_n[r / op.rows_per_bond] * (r % op.rows_per_bond == 0 ? 1.0 : contact.stiffness_ratio);
  }
  op.deformable = deformation.active();
  if (op.deformable && op.rows_per_bond == 2) op.symmetric = corrects_slip(deformation) == takes_shear_forces(deformation);
  return op;
}

Operators make_operators(const Assembly& a, const ContactParameters& contact,
                         const DeformationParameters& deformation) {
  Operators op{operator_frame(a, contact, deformation), {}, {}, {}, {}, {}};
  const int bonds = static_cast<int>(a.bonds.size());
  Triplets t;
  for (int c = 0; c < bonds; ++c) {
    const BondRows bond = bond_rows(a.bonds, static_cast<std::size_t>(c), op.length_scale, deformation);
    for (int r = 0; r < op.rows_per_bond; ++r) {
      for (int k = 0; k < (r == 0 ? 2 : 3); ++k) {  // a rotation has no part in a normal overlap
        t.emplace_back(op.rows_per_bond * c + r, op.dofs_per_disc * a.bonds.i[c] + k, bond.overlap[r][0][k]);
        t.emplace_back(op.rows_per_bond * c + r, op.dofs_per_disc * a.bonds.j[c] + k, bond.overlap[r][1][k]);
      }
    }
  }
  op.overlap = sparse(op.rows_per_bond * bonds, op.dofs_per_disc * static_cast<Eigen::Index>(a.size()), t);
  op.inverse_mass.resize(op.overlap.cols());
  for (int p = 0; p < static_cast<int>(a.size()); ++p) {
    op.inverse_mass.segment(op.dofs_per_disc * p, 2).setConstant(1.0 / a.mass[p]);
    if (contact.has_rotation()) {
      op.inverse_mass[3 * p + 2] = op.length_scale * op.length_scale / a.inertia[p];
    }
  }
  if (op.deformable) add_deformation(op, a, deformation);
  return op;
}

Eigen::VectorXd affine_overlaps(const Assembly& a, const OperatorFrame& op, const MacroStrain& e) {
  Eigen::VectorXd w(op.stiffness.size());
  for (int c = 0; c < static_cast<int>(a.bonds.size()); ++c) {
    const double nx = a.bonds.nx[c], ny = a.bonds.ny[c], length = a.bonds.length[c];
    const double ux = length * (e.xx * nx + 0.5 * e.xy * ny);
    const double uy = length * (0.5 * e.xy * nx + e.yy * ny);
    w[op.rows_per_bond * c] = nx * ux + ny * uy;
    if (op.rows_per_bond == 2) w[2 * c + 1] = -ny * ux + nx * uy;
  }
  return w;
}

Eigen::VectorXd rigid_overlaps(const Assembly& a, const OperatorFrame& op, const Eigen::VectorXd& q) {
  Eigen::VectorXd w(op.stiffness.size());
  for (std::size_t c = 0; c < a.bonds.size(); ++c) {
    const BondRows bond = bond_rows(a.bonds, c, op.length_scale, {});
    const double* const u = q.data() + static_cast<Eigen::Index>(op.dofs_per_disc) * a.bonds.i[c];
    const double* const v = q.data() + static_cast<Eigen::Index>(op.dofs_per_disc) * a.bonds.j[c];
    for (int r = 0; r < op.rows_per_bond; ++r) {
      const int entries = r == 0 ? 2 : 3;  // a rotation has no part in a normal overlap
      double sum = 0.0;
      for (int k = 0; k < entries; ++k) sum += bond.overlap[r][0][k] * u[k];
      for (int k = 0; k < entries; ++k) sum += bond.overlap[r][1][k] * v[k];
      w[static_cast<Eigen::Index>(c) * op.rows_per_bond + r] = sum;
    }
  }
  return w;
}

}  // namespace ddem
