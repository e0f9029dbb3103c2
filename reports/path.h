#pragma once
// SVG path data, rounded to a tenth of a pixel and as short as that allows.

#include <string>

#include "reports/geometry.h"

namespace ddem::reports {

/// "M1 2l3 4 5 6": absolute start, then relative steps, so that long signals stay small; rounding does not
/// add up. Repeated points, and those within a tenth of a pixel of the line without them, are left out. Ends with "z" if `closed`.
std::string path_data(const Polyline& line, bool closed = false);

}  // namespace ddem::reports
