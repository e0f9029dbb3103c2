#pragma once
// An order of elimination for many discs in the plane, by where they are.

#include <vector>

#include "dem/core/packing.h"

namespace ddem {

/// Discs from the first to be eliminated to the last: both halves of the packing, each in an order made alike, then the discs of one
/// half that have neighbours in the other (George, SIAM J. Numer. Anal. 10 (1973) 345). Factors of n discs then have O(n log n) entries
/// and take O(n^1.5) operations, whatever the packing; minimum degree, which comes to as much at 1e5 discs, is not bounded.
/// `neighbours` of each disc.
std::vector<int> nested_dissection(const Packing& packing, const std::vector<std::vector<int>>& neighbours);

}  // namespace ddem
