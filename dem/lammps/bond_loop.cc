#include "dem/lammps/bond_loop.h"

#include <algorithm>

namespace ddem::lammps {
namespace {

RowsView view(BondRows& rows) {
  return {rows.discs(), rows.first.data(), rows.bond.data(), rows.k_n.data(), rows.k_t.data(), rows.stride, rows.slip.data(), rows.start_gap.data()};
}

#ifdef DDEM_X86_KERNELS
bool has_avx2() { return __builtin_cpu_supports("avx2"); }
const AddForces kForces = has_avx2() ? avx2::add_forces : baseline::add_forces;
const AddStresses kStresses = has_avx2() ? avx2::add_stresses : baseline::add_stresses;
#else
const AddForces kForces = baseline::add_forces;
const AddStresses kStresses = baseline::add_stresses;
#endif

}  // namespace

void add_forces(const LoopLaw& law, BondRows& rows, const Discs& discs, const Loads& loads) { kForces(law, view(rows), discs, loads); }

void add_stresses(const LoopLaw& law, bool from_rest, BondRows& rows, const Discs& discs) { kStresses(law, from_rest, view(rows), discs); }

Overlap overlap_of(const LoopLaw& law, const BondRows& rows, const Discs& discs, int i, int b) {
  const auto k = static_cast<std::size_t>(b);
  const BondGeometry& g = rows.bond[k];
  const double* disc_i = discs.row + static_cast<std::size_t>(i) * discs.columns;
  const double* disc_j = discs.row + static_cast<std::size_t>(g.j) * discs.columns;
  const bool bonds = law.pairs == Pairs::bonds;
  Overlap o = law.kinematics == Kinematics::linear ? linear_overlap(g, disc_i, disc_j)
                                                   : nonlinear_overlap(g, disc_i, disc_j, placed(g, disc_i, disc_j), bonds ? rows.slip[k] : 0.0);
  if (law.strained && law.correction == Correction::full) correct<Correction::full>(o, disc_i, disc_j);
  else if (law.strained) correct<Correction::normal>(o, disc_i, disc_j);  // of normal-only-stress, too
  if (!bonds) o.u_n += rows.start_gap[k], o.u_t = 0.0;
  return o;
}

BondState state_of(const LoopLaw& law, const BondRows& rows, const Discs& discs, int i, int b) {
  const std::size_t stiffness = static_cast<std::size_t>(b) * static_cast<std::size_t>(rows.stride);
  const double k_n = rows.k_n[stiffness], k_t = rows.k_t[stiffness];
  Overlap o = overlap_of(law, rows, discs, i, b);
  if (law.pairs == Pairs::contacts) o.u_n = std::min(o.u_n, 0.0);
  return {o, force_of(o, k_n, k_t), 0.5 * (k_n * o.u_n * o.u_n + k_t * o.u_t * o.u_t)};
}

}  // namespace ddem::lammps
