#include "dem/lammps/bond_sweeps.h"

#include <cstddef>

#include "dem/lammps/bond_law.h"

namespace ddem::lammps::DDEM_ISA {
namespace {

/// What a sweep does: policies that cost nothing where they are off.
template <Pairs kPairs, Kinematics kKinematics, bool kCorrect, bool kSum, Correction kCorrection, bool kForce>
struct Sweep {
  static Overlap overlap(const RowsView& rows, const Discs& discs, int b, int i, const double* disc_i, const double* disc_j) {
    const BondGeometry& g = rows.bond[b];
    if constexpr (kKinematics == Kinematics::linear) {
      return linear_overlap(g, disc_i, disc_j);
    } else if constexpr (kPairs == Pairs::contacts) {
      return nonlinear_overlap(g, disc_i, disc_j, placed(g, disc_i, disc_j), 0.0);
    } else {
      const auto row = [&](int d) { return discs.previous + 3 * static_cast<std::size_t>(d); };
      const Placement now = placed(g, disc_i, disc_j);
      double& kept = rows.slip[b];
      const double *was_i = row(i), *was_j = row(g.j);
      const auto grown = [&](int c) { return (disc_j[c] - disc_i[c]) - (was_j[c] - was_i[c]); };
      const double slip = kept + slip_of_step(placed(g, was_i, was_j), now, grown(kUx), grown(kUy));
      if constexpr (kForce) kept = slip;
      return nonlinear_overlap(g, disc_i, disc_j, now, slip);
    }
  }

  /// Third law: the first disc's part is summed in registers, the other's is added at once.
  static void run(const RowsView& rows, const Discs& discs, const Loads& loads) {
    const auto columns = static_cast<std::size_t>(discs.columns);
    const int writable = discs.writable;
    double *const row = discs.row, *const force = loads.force, *const torque = loads.torque;
    const BondGeometry* const bonds = rows.bond;
    const int* const first = rows.first;
    const double *const k_n = rows.k_n, *const k_t = rows.k_t;
    const std::size_t stride = static_cast<std::size_t>(rows.stride);
    for (int i = 0, end = rows.discs; i < end; ++i) {
      double* disc_i = row + static_cast<std::size_t>(i) * columns;
      // Its motion and strains, which no store of the loop changes, in registers.
      constexpr int kOwn = kCorrect ? kStress : kMotionColumns;
      double own[kOwn];
      for (int c = 0; c < kOwn; ++c) own[c] = disc_i[c];
      double fx = 0.0, fy = 0.0, moment = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
      for (int b = first[i], last = first[i + 1]; b < last; ++b) {
        const auto j = static_cast<std::size_t>(bonds[b].j);
        double* disc_j = row + j * columns;
        Overlap o = overlap(rows, discs, b, i, own, disc_j);
        if constexpr (kCorrect) correct<kCorrection>(o, own, disc_j);
        if constexpr (kPairs == Pairs::contacts) {
          o.u_n += rows.start_gap[b], o.u_t = 0.0;
          if (!(o.u_n < 0.0)) continue;
        }
        const BondForce f = force_of(o, k_n[static_cast<std::size_t>(b) * stride], k_t[static_cast<std::size_t>(b) * stride]);
        const bool both = static_cast<int>(j) < writable;
        if constexpr (kForce) {
          fx += f.x, fy += f.y, moment += o.arm_i * f.shear;
          if (both) {
            force[3 * j] -= f.x, force[3 * j + 1] -= f.y;
            torque[3 * j + 2] += o.arm_j * f.shear;
          }
        }
        if constexpr (kSum) {
          const Dyad s = dyad_of<kCorrection>(o, f);
          xx += o.arm_i * s.xx, yy += o.arm_i * s.yy, xy += o.arm_i * s.xy;
          if (both) disc_j[kStress] += o.arm_j * s.xx, disc_j[kStress + 1] += o.arm_j * s.yy, disc_j[kStress + 2] += o.arm_j * s.xy;
        }
      }
      if constexpr (kForce) {
        const std::size_t k = 3 * static_cast<std::size_t>(i);
        force[k] += fx, force[k + 1] += fy, torque[k + 2] += moment;
      }
      if constexpr (kSum) disc_i[kStress] += xx, disc_i[kStress + 1] += yy, disc_i[kStress + 2] += xy;
    }
  }
};

/// From the values of a run to the types of a loop.
template <Pairs kPairs, class Visit>
void with_kinematics(Kinematics kinematics, Visit&& visit) {
  if (kinematics == Kinematics::linear) visit.template operator()<kPairs, Kinematics::linear>();
  else visit.template operator()<kPairs, Kinematics::nonlinear>();
}

template <class Visit>
void with_pairs(const LoopLaw& law, Visit&& visit) {
  if (law.pairs == Pairs::bonds) with_kinematics<Pairs::bonds>(law.kinematics, visit);
  else with_kinematics<Pairs::contacts>(law.kinematics, visit);
}

template <class Visit>
void with_correction(Correction correction, Visit&& visit) {
  switch (correction) {
    case Correction::normal: visit.template operator()<Correction::normal>(); break;
    case Correction::full: visit.template operator()<Correction::full>(); break;
    case Correction::normal_only_stress: visit.template operator()<Correction::normal_only_stress>(); break;
  }
}

}  // namespace

void add_forces(const LoopLaw& law, const RowsView& rows, const Discs& discs, const Loads& loads) {
  with_pairs(law, [&]<Pairs p, Kinematics k>() {
    if (!law.strained) return Sweep<p, k, false, false, Correction::normal, true>::run(rows, discs, loads);
    with_correction(law.correction, [&]<Correction c>() { Sweep<p, k, true, true, c, true>::run(rows, discs, loads); });
  });
}

void add_stresses(const LoopLaw& law, bool from_rest, const RowsView& rows, const Discs& discs) {
  with_pairs(law, [&]<Pairs p, Kinematics k>() {
    with_correction(law.correction, [&]<Correction c>() {
      if (from_rest) Sweep<p, k, false, true, c, false>::run(rows, discs, {});
      else Sweep<p, k, true, true, c, false>::run(rows, discs, {});
    });
  });
}

}  // namespace ddem::lammps::DDEM_ISA
