#pragma once
// What is wrong with a packing that somebody gave us, all of it at once.

#include <string>
#include <vector>

#include "dem/core/packing.h"

namespace ddem {

/// Discs may overlap by this fraction of the smaller radius.
inline constexpr double kLargestRelativeOverlap = 0.05;

/// Problems of a packing in plain words, empty when there are none: arrays of different size, fewer than two
/// discs, a position or period that is not a number, a radius that is not positive, a period so short that
/// discs could touch through two images, discs that overlap by more than 5 % of the smaller radius (both
/// discs and the overlap are named). Of each kind the first ten are listed, and then the listing ends with
/// "... and more". Never throws on bad data; discs are numbered from 0.
std::vector<std::string> packing_problems(const Packing& packing);

}  // namespace ddem
