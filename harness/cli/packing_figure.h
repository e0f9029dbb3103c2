#pragma once
// What a packing looks like.

#include "dem/core/packing.h"
#include "reports/figure.h"

namespace ddem::harness {

/// The discs, their radii from the smallest to the largest, and how far they are from each other.
reports::Figure packing_figure(const Packing& packing);

}  // namespace ddem::harness
