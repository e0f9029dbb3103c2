#pragma once
// Packings looser or denser than jammed ones.

#include <stdexcept>

#include "dem/core/packing.h"

namespace ddem::packings {

class PorosityOutOfReach : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// 1 - sum pi r^2 / (length width): overlaps count twice.
double porosity_of(const Packing& packing);

/// The centres stay, all radii are scaled: above the porosity at which discs jam a gap is left between them, below it they overlap.
/// Throws PorosityOutOfReach, which says what can be met, where a gap would be more than half of a mean diameter or an overlap more than
/// a twentieth; `walled` ones only get looser, since no disc may reach beyond a wall.
Packing with_porosity(Packing packing, double porosity, bool walled);

}  // namespace ddem::packings
