#pragma once
// Discs that the bonded network does not hold, and whether the network is one piece.
//
// The rule: a disc with fewer than two bonds carries no load at rest, and neither does one that is left with
// fewer than two once such discs are taken away (peeled until nothing changes). These rattlers leave the
// mechanical network together with their bonds: they keep their place, but they do not move, unless a new
// contact pushes them; what counts them and what does not is told at network_discs(). This rule counts bonds
// and nothing else: a disc on two collinear bonds is floppy as well when k_t = 0, and is not found here.
// A free chain peels away from its ends to nothing.

#include <cstddef>
#include <span>
#include <vector>

#include "dem/core/bonds.h"

namespace ddem {

/// Discs (ascending) that the rule above takes out. Throws std::invalid_argument on a bond to a disc that
/// does not exist.
std::vector<int> find_rattlers(std::size_t discs, const Bonds& bonds);

/// Pieces of the network: each a list of discs (ascending), pieces ordered by their first disc; discs of
/// `left_out` (rattlers) belong to none. An assembly in one piece gives one list. Throws
/// std::invalid_argument on an index outside [0, discs).
std::vector<std::vector<int>> connected_components(std::size_t discs, const Bonds& bonds,
                                                   std::span<const int> left_out = {});

}  // namespace ddem
