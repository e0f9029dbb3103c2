#pragma once
// Since when what is broken is broken.

#include <string>
#include <vector>

#include "harness/nightly/history.h"

namespace ddem::harness::nightly {

/// Of every case that fails in the last night, since when it does: a sentence each for the five of the longest, and how many more there are.
/// Nights that have not got it, or did not run it, do not count.
std::vector<std::string> broken_since(const std::vector<Night>& nights);

}  // namespace ddem::harness::nightly
