#pragma once
// Discs that are read after every step: of sweeps that take several steps, while the sweep passes them.

#include <vector>

#include "dem/kernel/aligned.h"

namespace ddem {

class Taps {
 public:
  /// Places in the solver's order, in any order, also repeated.
  explicit Taps(std::vector<int> places);

  /// Where values() keeps the disc at a place that was given.
  int slot_of(int place) const;
  /// Before a sweep of so many steps.
  void begin(int steps);
  /// Keeps what `motion` (kQuad doubles a disc) holds after step `level` of the sweep, of the places below `end` that were not
  /// kept before.
  void keep(const double* motion, int level, int end);
  /// After step `level` of the last sweep: kQuad doubles a slot.
  const double* values(int level) const;

 private:
  std::vector<int> places_;
  std::vector<std::size_t> kept_;  // by level
  AlignedVector<double> values_;   // level by level
};

}  // namespace ddem
