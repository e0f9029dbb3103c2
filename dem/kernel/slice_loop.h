// The loop over the bonds of slices, what it sums, what a watched sweep notes, and sums of triples. Include only from
// step_kernel.h.

#include "dem/kernel/bond_laws.h"

namespace ddem::DDEM_ISA {
namespace {

struct Sums {
  Pack fx{}, fy{}, moment{}, sxx{}, syy{}, sxy{};
};

/// The one loop over bonds. For each slice of eight discs, the first of which is p: own = disc_data(p), then
/// row_of_bonds(k, own, sums) for each of its rows, k the row's first half-bond, then disc(p, own, sums).
template <class Own, class Row, class Disc>
DDEM_INLINE void for_slices(const StepData& d, int begin, int end, Own own_data, Row row_of_bonds, Disc disc) {
  for (int slice = begin; slice < end; ++slice) {
    const int p = slice * kWidth;
    const auto own = own_data(p);
    Sums sum;
    for (int row = d.row_begin[slice]; row < d.row_begin[slice + 1]; ++row) row_of_bonds(row * kWidth, own, sum);
    disc(p, own, sum);
  }
}

/// What the two ends of a row's bonds have written.
DDEM_INLINE Pack both_ends(const StepData& d, const double* share, int k) {
  return load(share + k) + gather_each(share, d.other_end + k);  // the same bits from either end
}

/// The largest of a sweep, for whoever watches what may close: compiled in where kWatched.
template <bool kWatched>
struct Watch {
  Pack speed{}, strain{};
  DDEM_INLINE void note_velocity(Pack vx, Pack vy) {
    if constexpr (kWatched) speed = larger(add_square(vx, vy * vy), speed);
  }
  DDEM_INLINE void note_strain(const Triple& e) {
    if constexpr (kWatched) strain = larger(add_square(e.a, add_square(e.b, e.c * e.c)), strain);
  }
  void tell(double* most, Pack noted) const {
    if constexpr (kWatched) {
      double all = *most;
      for (int l = 0; l < kWidth; ++l) all = noted[l] <= all || all != all ? all : noted[l];  // what is no number stays
      *most = all;
    }
  }
  void tell_speed(const StepData& d) const { tell(d.fastest, speed); }
  void tell_strain(const StepData& d) const { tell(d.most_strained, strain); }
};

DDEM_INLINE Triple combine(double wx, const Triple& x, double wy, const Triple& y) {
  return {wx * x.a + wy * y.a, wx * x.b + wy * y.b, wx * x.c + wy * y.c};
}
DDEM_INLINE Triple difference(const Triple& x, const Triple& y) { return {x.a - y.a, x.b - y.b, x.c - y.c}; }
/// x + w y.
DDEM_INLINE Triple along(const Triple& x, double w, const Triple& y) { return {x.a + w * y.a, x.b + w * y.b, x.c + w * y.c}; }

}  // namespace
}  // namespace ddem::DDEM_ISA
