#include "dem/statics/bond_system.h"

#include <cmath>

#include "dem/assembly/particle_volume.h"
#include "dem/statics/strain_modes.h"

namespace ddem {
namespace {

/// One row of a bond: the unknowns of both discs. `unit` of the strains: s of each place, three.
void write_row(double* row, const BondSystem& s, const std::array<int, 2>& place, const BondRows::Row& overlap,
               const BondRows::Row& strain, const std::vector<double>& unit) {
  for (const int disc : {0, 1}) {
    double* const own = row + disc * s.unknowns_per_disc();
    for (int k = 0; k < s.displacements; ++k) own[k] = overlap[disc][k];
    if (s.strains == 0) continue;
    const std::array<double, 3> modes = in_strain_modes(strain[disc]);
    for (int k = 0; k < 3; ++k) own[s.displacements + k] = -modes[k] * unit[3 * static_cast<std::size_t>(place[disc]) + k];
  }
}

/// D, and the strains' units.
std::vector<double> set_strains(BondSystem& s, const Assembly& a, double length_scale, const DeformationParameters& deformation, double scale) {
  std::vector<double> unit(3 * a.size());
  s.strain_stiffness.resize(3 * a.size());
  const std::array<double, 3> compliances = mode_compliances(deformation);
  const std::vector<double> volume = particle_volumes(a, deformation);
  for (std::size_t p = 0; p < a.size(); ++p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = 3 * static_cast<std::size_t>(s.place[p]) + k;
      const double d = compliances[k] * length_scale * length_scale * scale / volume[p];
      s.strain_stiffness[at] = 1.0 / (1.0 + d);
      unit[at] = std::sqrt(d / (1.0 + d));
    }
  }
  return unit;
}

void leave_out_held(double* row, const BondSystem& s, int first, int second) {
  const int n = s.unknowns_per_disc();
  for (int k = 0; k < n; ++k) {
    if (s.held[static_cast<std::size_t>(first) * n + k]) row[k] = 0.0;
    if (s.held[static_cast<std::size_t>(second) * n + k]) row[n + k] = 0.0;
  }
}

void hold(BondSystem& s, const HeldDofs& held) {
  s.held.assign(static_cast<std::size_t>(s.size()), 0);
  const std::vector<std::uint8_t>* const dofs[] = {&held.x, &held.y, &held.theta};
  for (int k = 0; k < s.displacements; ++k) {
    for (std::size_t p = 0; p < dofs[k]->size(); ++p) s.held[s.at(static_cast<int>(p)) + k] = (*dofs[k])[p];
  }
}

}  // namespace

BondSystem bond_system(const Assembly& a, const OperatorFrame& op, const DeformationParameters& deformation, const HeldDofs& held,
                       const EliminationTree& tree, double scale) {
  BondSystem s;
  s.displacements = op.dofs_per_disc;
  s.strains = op.deformable ? 3 : 0;
  s.rows_per_bond = op.rows_per_bond;
  s.place = tree.place;
  s.stiffness = op.stiffness / scale;
  hold(s, held);
  std::vector<double> unit;
  if (op.deformable) unit = set_strains(s, a, op.length_scale, deformation, scale);
  const std::size_t width = 2 * static_cast<std::size_t>(s.unknowns_per_disc()), rows = a.bonds.size() * s.rows_per_bond;
  s.right.resize(rows * width);
  if (!op.symmetric) s.left.resize(rows * width);
  for (std::size_t c = 0; c < a.bonds.size(); ++c) {
    const int first = s.place[a.bonds.i[c]], second = s.place[a.bonds.j[c]];
    s.first.push_back(first);
    s.second.push_back(second);
    const BondRows b = bond_rows(a.bonds, c, op.length_scale, deformation);
    for (int r = 0; r < s.rows_per_bond; ++r) {
      double* const right = s.right.data() + (c * s.rows_per_bond + r) * width;
      write_row(right, s, {first, second}, b.overlap[r], b.strain[r], unit);
      leave_out_held(right, s, first, second);
      if (op.symmetric) continue;
      double* const left = s.left.data() + (c * s.rows_per_bond + r) * width;
      write_row(left, s, {first, second}, b.overlap[r], b.stress[r], unit);
      leave_out_held(left, s, first, second);
    }
  }
  return s;
}

Eigen::VectorXd BondSystem::overlaps(const Eigen::VectorXd& x) const {
  Eigen::VectorXd w(stiffness.size());
  const int n = unknowns_per_disc();
  const double* row = right.data();
  Eigen::Index r = 0;
  for (std::size_t c = 0; c < first.size(); ++c) {
    const double* const u = x.data() + static_cast<Eigen::Index>(n) * first[c];
    const double* const v = x.data() + static_cast<Eigen::Index>(n) * second[c];
    for (int k = 0; k < rows_per_bond; ++k, ++r, row += 2 * n) {
      double sum = 0.0;
      for (int m = 0; m < n; ++m) sum += row[m] * u[m] + row[n + m] * v[m];
      w[r] = sum;
    }
  }
  return w;
}

Eigen::VectorXd BondSystem::loads(const Eigen::VectorXd& forces) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  const int n = unknowns_per_disc();
  const double* row = symmetric() ? right.data() : left.data();
  Eigen::Index r = 0;
  for (std::size_t c = 0; c < first.size(); ++c) {
    double* const u = y.data() + static_cast<Eigen::Index>(n) * first[c];
    double* const v = y.data() + static_cast<Eigen::Index>(n) * second[c];
    for (int k = 0; k < rows_per_bond; ++k, ++r, row += 2 * n) {
      for (int m = 0; m < n; ++m) u[m] += row[m] * forces[r];
      for (int m = 0; m < n; ++m) v[m] += row[n + m] * forces[r];
    }
  }
  return y;
}

Eigen::VectorXd BondSystem::balance(const Eigen::VectorXd& forces, const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = loads(forces);
  const std::size_t n = static_cast<std::size_t>(unknowns_per_disc());
  for (std::size_t p = 0; strains > 0 && p < place.size(); ++p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = static_cast<Eigen::Index>(n * p + k) + displacements;
      y[at] += strain_stiffness[3 * p + k] * x[at];
    }
  }
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    if (held[k]) y[k] = x[k];
  }
  return y;
}

}  // namespace ddem
