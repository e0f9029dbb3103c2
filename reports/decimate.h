#pragma once
// Long signals drawn with a few points per pixel column, so that a report stays small and peaks survive.

#include "reports/geometry.h"

namespace ddem::reports {

/// Keeps first, lowest, highest and last of each run of consecutive points within one column of
/// `column_width` pixels, in their order: the picture is the same to within a column, and every extremum is
/// kept exactly.
Polyline decimate(const Polyline& line, double column_width);

}  // namespace ddem::reports
