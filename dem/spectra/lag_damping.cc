#include "dem/spectra/lag_damping.h"

#include "dem/spectra/scheme_stiffness.h"

namespace ddem {

double lag_share(const Assembly& a, const StaticSolver& solver, const ContactParameters& contact, const DeformationParameters& deformation, double radius,
                 const MacroStrain& strain, const InnerSection& section) {
  const Operators op = make_operators(a, contact, deformation);
  const SchemeStiffness lag = SchemeStiffness::lag(op, deformation, radius);
  const StaticState state = solver.solve(strain);
  const Eigen::VectorXd overlaps = op.overlap * state.fluctuation + affine_overlaps(a, op, strain);
  const Eigen::VectorXd rigid_forces = op.stiffness.cwiseProduct(overlaps);
  const Eigen::VectorXd lacking = op.strain_overlap * lag.strains(op.stress * rigid_forces);
  double damping = 0.0, stiffness = 0.0;
  for (std::size_t c = 0; c < a.bonds.size(); ++c) {
    const double x = a.packing.x[a.bonds.i[c]];
    if (x < section.from || x > section.to) continue;
    const auto row = static_cast<Eigen::Index>(c) * op.rows_per_bond;
    damping += rigid_forces.segment(row, op.rows_per_bond).dot(lacking.segment(row, op.rows_per_bond));
    stiffness += overlaps.segment(row, op.rows_per_bond).dot(state.bond_forces.segment(row, op.rows_per_bond));
  }
  return damping / stiffness;
}

}  // namespace ddem
