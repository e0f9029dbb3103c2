#pragma once
// Where nothing can have moved yet: a force reaches one bond further with every sweep of a kernel over the discs. Beyond
// that all displacements, velocities and strains are exactly zero, and a sweep would only write zeros again.

#include <vector>

#include "dem/kernel/sliced_bonds.h"

namespace ddem {

/// Sweep n (n = 0, 1, ...) changes discs of the slices [0, front) only: front is element n, the last one for all
/// sweeps after. `moving[p]`: not at rest at the start, or driven. In the solver's order a strip's slices follow its
/// length, and loads act on its left.
std::vector<int> motion_fronts(const SlicedBonds& bonds, const std::vector<char>& moving);

}  // namespace ddem
