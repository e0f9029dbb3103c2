#pragma once
// Finding neighbours and choosing which of them are bonded.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "dem/core/bonds.h"
#include "dem/core/packing.h"

namespace ddem {

/// Two discs and the free distance between their surfaces (negative where they overlap), m.
struct ClosePair {
  int i = 0, j = 0;           // i < j
  double dx = 0.0, dy = 0.0;  // centre of j's nearest image minus centre of i
  double gap = 0.0;
};

/// All pairs with gap <= max_gap, nearest images in periodic directions, ordered by (i, j).
/// A periodic direction must be longer than twice the largest pair distance (two largest radii and the gap);
/// throws std::invalid_argument otherwise, since a pair could then touch through two images, and on a packing
/// with arrays of different size, a centre that is not finite or a radius that is not positive.
std::vector<ClosePair> close_pairs(const Packing& packing, double max_gap);

/// Bonds between the pairs of `pairs`, in their order. Throws std::invalid_argument on coincident centres.
Bonds bonds_of(const Packing& packing, std::span<const ClosePair> pairs);

/// Bonds of all pairs with gap <= bond_gap (m).
Bonds bonds_within_gap(const Packing& packing, double bond_gap);

/// The gap (m) at which the mean number of bonds of a disc, 2 bonds/discs, is nearest to `coordination`,
/// half-way between the last gap that is bonded and the first that is not, so that rounding cannot change the
/// choice. The achieved coordination is within 1/discs of it. Throws std::invalid_argument when no gap up to
/// two mean radii (and to half a period between centres) gives it: a lattice has whole shells of equal gaps.
///
/// With marks (`counted`, one per disc; none: all discs) the mean is over the discs with a mark other than 0, and bonds
/// with other discs count as well: for packings whose outermost discs have neighbours on one side only.
double gap_for_coordination(const Packing& packing, double coordination, std::span<const char> counted = {});

/// Bonds between given pairs of discs (nearest images), ordered by (i, j) with i < j whatever their order in
/// `pairs`: the same network has the same bits. Throws std::invalid_argument on an index out of range, on a
/// disc bonded to itself, on a pair given twice, or when two images of j are equally near i.
Bonds bonds_between(const Packing& packing, std::span<const std::pair<int, int>> pairs);

/// Mean number of bonds of a disc, 2 bonds/discs. Throws std::invalid_argument without discs.
double coordination(const Bonds& bonds, std::size_t discs);

/// The same over the discs with a mark. Throws std::invalid_argument without any.
double coordination(const Bonds& bonds, std::span<const char> counted);

}  // namespace ddem
