#pragma once
// How far discs are from each other, against discs strewn at random.

#include <vector>

#include "dem/core/packing.h"

namespace ddem::packings {

/// Bins of equal width of the distance of two centres over the sum of their radii: 1 is a contact.
struct PairCorrelation {
  double width = 0.0;          ///< of a bin; the first begins at 0
  std::vector<double> g;       ///< pairs in a bin over those of points without order; towards 1 far away
};

/// g of a packing of different discs (e.g. Donev, Torquato and Stillinger, Phys. Rev. E 71, 011105, 2005), up to `largest` sums of
/// radii or as far as half the shorter period allows. In a direction that is not periodic, only discs that far from the edges are seen
/// from. Without bins where no disc is. Throws std::invalid_argument where `largest` or `bins` is not positive.
PairCorrelation pair_correlation(const Packing& packing, double largest, int bins);

}  // namespace ddem::packings
