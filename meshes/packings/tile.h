#pragma once
// Larger samples out of a periodic one, for sizes that would take long to jam.

#include "dem/core/packing.h"

namespace ddem::packings {

/// nx x ny copies of `packing` side by side; periods, length and width grow with them. Disc i of copy (a, b),
/// a along x, has the number (a ny + b) n + i. Throws std::invalid_argument on counts below 1, on a direction
/// to be repeated that is not periodic, and on more than 1e8 discs.
Packing tile(const Packing& packing, int nx, int ny);

}  // namespace ddem::packings
