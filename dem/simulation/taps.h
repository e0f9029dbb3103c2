#pragma once
// Discs that are read after every step: of sweeps that take several steps, while the sweep passes them.

#include <vector>

#include "dem/kernel/aligned.h"
#include "dem/kernel/step_data.h"

namespace ddem {

class Taps {
 public:
  /// Places in the solver's order, in any order, also repeated.
  explicit Taps(std::vector<int> places);

  /// Where values() keeps the disc at a place that was given.
  int slot_of(int place) const;
  /// Before a sweep of so many steps.
  void begin(int steps);
  /// Keeps what `motion` (kQuad doubles a disc) holds after step `level` of the sweep at the places [begin, end). Several
  /// threads may do this with disjoint ranges.
  void keep(const double* motion, int level, int begin, int end);
  /// After step `level` of the last sweep: kQuad doubles a slot.
  const double* values(int level) const { return values_.data() + begin_of(level); }

 private:
  std::size_t begin_of(int level) const { return static_cast<std::size_t>(level) * places_.size() * kQuad; }

  std::vector<int> places_;
  AlignedVector<double> values_;  // level by level
};

}  // namespace ddem
