#pragma once
// Long signals drawn with a few points per pixel column, so that a report stays small and peaks survive.

#include <cstddef>
#include <vector>

#include "reports/geometry.h"

namespace ddem::reports {

/// Keeps first, lowest, highest and last of each run of consecutive points within one column of
/// `column_width` pixels, in their order: the picture is the same to within a column, and every extremum is
/// kept exactly.
Polyline decimate(const Polyline& line, double column_width);

/// Which elements of a long signal to keep, about `max_rows` of them: all of a short one; of a long one the finite ones that
/// decimate() keeps.
std::vector<std::size_t> kept_rows(const std::vector<double>& y, std::size_t max_rows);

}  // namespace ddem::reports
